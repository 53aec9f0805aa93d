// From a point in the picture to a ray, by the formulas of docs/conventions.md.
#pragma once

#include "host/scene/scene.hpp"

namespace eyeray::engine::reference {

class CameraRays {
 public:
  CameraRays(const Camera& camera, const ImageSettings& image);

  // The ray through `place`, in pixels from the picture's top left corner, and from `lens`, to the right and
  // up of the lens' middle; its direction is unit.
  Ray ray(const Vec2& place, const Vec2& lens = Vec2(0.0)) const;
  // True if anything is seen there; else there is no ray.
  bool sees(const Vec2& place, const Vec2& lens = Vec2(0.0)) const;
  // A point on the lens. u: two random numbers in [0, 1).
  Vec2 lens_point(const Vec2& u) const;

 private:
  // To the right and up, in half widths.
  Vec2 from_middle(const Vec2& place) const;

  CameraAxes axes_;
  std::shared_ptr<const Projection> projection_;
  Aperture aperture_;
  Vec2 size_;
};

}  // namespace eyeray::engine::reference
