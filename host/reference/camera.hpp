// Camera rays through points of the picture, by the formulas of docs/conventions.md.
#pragma once

#include "host/scene/scene.hpp"

namespace eyeray::engine::reference {

class CameraRays {
 public:
  CameraRays(const Camera& camera, const ImageSettings& image);

  // The ray from a point of the lens through a point of the picture; its direction is unit. `position`: the
  // point of the picture, in pixels from its top left corner. `lens`: the point of the lens, to the right and
  // up of its middle.
  Ray ray(const Vec2& position, const Vec2& lens = Vec2(0.0)) const;
  // True if the camera sees anything there; else ray() has no ray.
  bool sees(const Vec2& position, const Vec2& lens = Vec2(0.0)) const;
  // A point on the lens. u: two random numbers in [0, 1).
  Vec2 lens_point(const Vec2& u) const;

 private:
  // The offset of `position` from the picture's middle, to the right and up, in half widths of the picture.
  Vec2 from_middle(const Vec2& position) const;

  CameraAxes axes_;
  std::shared_ptr<const Projection> projection_;
  Aperture aperture_;
  Vec2 size_;
};

}  // namespace eyeray::engine::reference
