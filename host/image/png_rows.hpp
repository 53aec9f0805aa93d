// The pixels of a PNG, row by row, by libpng.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace eyeray::engine::image {

// Decodes to `pixels`, the top row first: red, green, blue and alpha, 8 bits each; from 16 bits the upper 8
// are kept. The number of pixels must be that of the header. Returns the fault, or "". Allocates memory for a
// few rows only.
std::string read_png_rows(std::span<const std::byte> bytes, std::span<std::array<uint8_t, 4>> pixels);

}  // namespace eyeray::engine::image
