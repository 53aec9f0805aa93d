// The pixels of a PNG, row by row, by libpng.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace eyeray::engine::image {

// Decodes to `pixels`, the top row first: red, green, blue and alpha, 8 bits each; of 16 bits the upper 8 are
// kept. There are as many pixels as the header states. Returns the fault, or "". Takes the memory of a few
// rows.
std::string read_png_rows(std::span<const std::byte> bytes, std::span<std::array<uint8_t, 4>> pixels);

}  // namespace eyeray::engine::image
