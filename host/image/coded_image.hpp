// Pictures as the 8-bit codes that their files hold: for textures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/core/error.hpp"

namespace eyeray::engine::image {

struct CodedImage {
  int width = 0;
  int height = 0;
  std::vector<std::array<uint8_t, 4>> pixels;  // red, green, blue, alpha; the top row first
};

inline constexpr int most_coded_side = 16384;                // pixels; hence at most 2^28 of them
inline constexpr size_t most_coded_bytes = size_t{1} << 30;  // of a file

// The error that a scene's images have too many pixels.
class TooManyPixels : public Error {
  using Error::Error;
};

// The number of pixels that the images of one scene may have together. They are counted where they are
// decoded or copied.
struct PixelBudget {
  int64_t left = int64_t{1} << 28;  // 1 GiB
  // TooManyPixels (file_io) where fewer are left.
  void take(int width, int height, const std::string& name);
};

// Decodes a PNG, a JPEG, a BMP or a TGA, distinguished by their first bytes. Grey becomes equal red, green
// and blue, of 16 bits the upper 8 are kept, and pictures without alpha get 255; a JPEG is turned by its EXIF
// orientation. `warnings` gets a sentence for each field of the header that changes the meaning of the codes
// and is not honoured. Error (file_io) with "cannot read NAME: why" for all else, a file that ends early
// included. The header is believed only as far as a file of that length can go, so that memory is bounded by
// the file's size; and no more is decoded than is taken from the budget.
CodedImage decode_coded_image(std::span<const std::byte> bytes, const std::string& name, PixelBudget& budget,
                              std::vector<std::string>& warnings);

}  // namespace eyeray::engine::image
