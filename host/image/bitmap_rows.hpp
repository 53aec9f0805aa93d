// Pictures in TGA and BMP files, for coded_image.cpp. We decode them ourselves, since stb_image reads missing
// bytes as zeros.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace eyeray::engine::image {

// The size that the header states, not yet checked.
struct BitmapSize {
  int64_t width;
  int64_t height;
};

// The most pixels that a byte of a file can stand for. TGA: a run of 128 pixels in two bytes. BMP: 8 pixels
// in a byte.
inline constexpr int64_t most_tga_pixels_a_byte = 64;
inline constexpr int64_t most_bmp_pixels_a_byte = 8;

// Truevision's TGA 1 and 2 (TGA File Format Specification, Version 2.0, 1991). It has no magic number: true
// if the header can be that of a TGA.
bool is_tga(std::string_view bytes);
BitmapSize tga_size(std::string_view bytes);
// Windows' and OS/2's BMP (Microsoft: Bitmap Storage).
bool is_bmp(std::string_view bytes);
BitmapSize bmp_size(std::string_view bytes);

// Decode to `pixels`, the top row first: red, green, blue and alpha, 8 bits each, 255 where the file has no
// alpha. The number of pixels must be that of the size. Return the fault, for instance "it ends early", or
// "". `warnings` gets a clause, such as "its colours are …", for each ignored field that changes the meaning
// of the numbers.
std::string read_tga(std::string_view bytes, std::span<std::array<uint8_t, 4>> pixels,
                     std::vector<std::string>& warnings);
std::string read_bmp(std::string_view bytes, std::span<std::array<uint8_t, 4>> pixels,
                     std::vector<std::string>& warnings);

// A little-endian number of `size` bytes; 0 beyond the end.
uint32_t number_at(std::string_view bytes, uint64_t at, uint64_t size);

}  // namespace eyeray::engine::image
