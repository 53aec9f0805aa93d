// The pixels of a TIFF, by libtiff.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/image/bitmap_rows.hpp"

namespace eyeray::engine::image {

// TIFF (Revision 6.0, 1992) or BigTIFF, in either order of bytes.
bool is_tiff(std::string_view bytes);

// The size of the first page. If it cannot be read, 0 × 0, and `fault` gets the reason.
BitmapSize tiff_size(std::string_view bytes, std::string& fault);

// Decodes the first page to `pixels`, its first row first: red, green, blue and alpha, 8 bits each. The
// number of pixels must be that of the size. `orientation` gets the file's, as EXIF numbers it. Returns the
// fault, or "". `warnings` gets a clause for each ignored part of the file.
std::string read_tiff(std::string_view bytes, std::span<std::array<uint8_t, 4>> pixels, int& orientation,
                      std::vector<std::string>& warnings);

}  // namespace eyeray::engine::image
