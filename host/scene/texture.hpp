// A colour that may vary over a surface.
#pragma once

#include <optional>

#include "core/vec.hpp"

namespace eyeray {

// A checkerboard in uv: the check that holds (u, v) is `even` where floor(u / size.x) + floor(v / size.y) is
// even.
struct Checker {
  Vec3 even;
  Vec3 odd;
  Vec2 size;
};

// Linear RGB, constant or checkered.
struct Texture {
  Vec3 value{0.0};
  std::optional<Checker> checker;

  Vec3 at(const Vec2& uv) const;
};

}  // namespace eyeray
