// Pictures as 8-bit codes, as their files hold them, for textures.
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
inline constexpr size_t most_coded_bytes = size_t{1} << 30;  // most coded bytes of a file

// The error that a scene's images have too many pixels.
class TooManyPixels : public Error {
  using Error::Error;
};

// The number of pixels that the images of one scene may still take. Each image is counted when it is decoded
// or copied.
struct PixelBudget {
  int64_t left = int64_t{1} << 28;  // 1 GiB
  // Takes width · height pixels from the budget. TooManyPixels (file_io) if fewer are left.
  void take(int width, int height, const std::string& name);
};

// Decodes a PNG, a JPEG, a WebP, a TIFF, a BMP or a TGA, distinguished by their first bytes. Grey becomes
// equal red, green and blue. From 16 bits the upper 8 are kept. Pictures without alpha get 255. A JPEG is
// rotated by its EXIF orientation, and a TIFF by its own. `warnings` gets a sentence for each ignored field
// of the header that changes the meaning of the codes. Error (file_io) with "cannot read NAME: why" for
// anything else, such as a file that ends early. A header that states more pixels than a file of that length
// can hold is an error, so that memory is bounded by the file's size. The pixels are taken from the budget
// before they are decoded.
CodedImage decode_coded_image(std::span<const std::byte> bytes, const std::string& name, PixelBudget& budget,
                              std::vector<std::string>& warnings);

}  // namespace eyeray::engine::image
