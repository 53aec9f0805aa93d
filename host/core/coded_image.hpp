// Pictures as the 8-bit codes that their files hold: what textures are made of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace eyeray {

struct CodedImage {
  int width = 0;
  int height = 0;
  std::vector<std::array<uint8_t, 4>> pixels;  // red, green, blue, alpha; the top row first
};

inline constexpr int most_coded_side = 16384;                // pixels; hence at most 2^28 of them
inline constexpr size_t most_coded_bytes = size_t{1} << 30;  // of a file

// Decodes a PNG or a JPEG, told apart by their first bytes. Grey becomes equal red, green and blue, of 16
// bits the upper 8 are kept, and what has no alpha gets 255; colour profiles and gamma chunks are not looked
// at. Error (file_io) that says "cannot read NAME: why" for all else, a file that ends early included. The
// header is believed only as far as a file of that length can go, so that memory is bounded by the file's
// size.
CodedImage decode_coded_image(std::span<const std::byte> bytes, const std::string& name);

}  // namespace eyeray
