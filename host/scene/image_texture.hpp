// The picture of an image texture, and how its texels are looked up.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace eyeray::engine {

enum class Filter { bilinear, nearest };
enum class Wrap { repeat, mirror, clamp };

struct ImageTexture {
  std::string name;  // for messages
  int width = 0;
  int height = 0;
  std::vector<std::array<uint8_t, 4>> texels;  // the top row first, as the file has them
  bool srgb = true;                            // the texels are sRGB codes; false: linear, code / 255
  Filter filter = Filter::bilinear;            // on linear values
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
};

}  // namespace eyeray::engine
