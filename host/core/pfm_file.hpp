// Portable float maps (Paul Debevec's PFM): "PF" or "Pf", width, height, a scale whose sign is the byte
// order, then raw float32 with the BOTTOM row first.
#pragma once

#include <string>
#include <string_view>

#include "core/image.hpp"

namespace eyeray {

// The bytes of a 1- or 3-channel image, little-endian.
std::string encode_pfm(const Image& image);

// Strict: exact header, both byte orders, no byte too few or too many. Error (file_io), with `name` in it,
// otherwise.
Image decode_pfm(std::string_view bytes, const std::string& name);

}  // namespace eyeray
