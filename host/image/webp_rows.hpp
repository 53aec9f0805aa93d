// The pixels of a WebP, by libwebp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "host/image/bitmap_rows.hpp"

namespace eyeray::engine::image {

bool is_webp(std::string_view bytes);

// The size that the header states; 0 × 0 if it cannot be read.
BitmapSize webp_size(std::string_view bytes);

// Decodes to `pixels`, the top row first: red, green, blue and alpha, 8 bits each. The number of pixels must
// be that of the size. Returns the fault, or "". For a lossless picture, libwebp needs as much memory again.
std::string read_webp(std::string_view bytes, std::span<std::array<uint8_t, 4>> pixels);

}  // namespace eyeray::engine::image
