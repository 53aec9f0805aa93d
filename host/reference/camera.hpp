// From a place in the picture to a ray, by the formulas of docs/conventions.md.
#pragma once

#include "host/scene/scene.hpp"

namespace eyeray::reference {

class CameraRays {
 public:
  CameraRays(const Camera& camera, const ImageSettings& image);

  // The ray through `place`, in pixels from the picture's top left corner; its direction is unit.
  Ray ray(const Vec2& place) const;

 private:
  CameraAxes axes_;
  std::shared_ptr<const Projection> projection_;
  Vec2 size_;
};

}  // namespace eyeray::reference
