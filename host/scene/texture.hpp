// A colour that may vary over a surface.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/core/vec.hpp"

namespace eyeray {

// A checkerboard in uv: the check that holds (u, v) is `even` where floor(u / size.x) + floor(v / size.y) is
// even.
struct Checker {
  Vec3 even;
  Vec3 odd;
  Vec2 size;
};

enum class Filter { bilinear, nearest };
enum class Wrap { repeat, mirror, clamp };

// A picture in uv: (0, 0) is its lower left corner, (1, 1) its upper right.
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

// Linear RGB: constant, checkered, or an image times `value`.
struct Texture {
  Vec3 value{0.0};
  std::optional<Checker> checker;
  std::shared_ptr<const ImageTexture> image = {};
  Vec2 image_size{1.0};  // of the picture, in uv

  Vec3 at(const Vec2& uv) const;  // an image's alpha is not looked at
  // As an alpha: the first component of a constant or a check; an image's alpha times that of `value`.
  double alpha_at(const Vec2& uv) const;
};

}  // namespace eyeray
