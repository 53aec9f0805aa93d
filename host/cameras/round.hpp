// Cameras whose columns surround the eye at equal angles: the width of the picture spans `fov`.
#pragma once

#include <fmt/format.h>

#include "host/cameras/make.hpp"

namespace eyeray::engine::cameras {

// Form: the camera's values, whose one number is `fov_degrees`.
template <class Form>
class RoundProjection : public Projection {
 public:
  explicit RoundProjection(const Form& values) : values_(values) {}

  Vec3 scale(const Vec2& size) const override { return {half(), half() * (size.y / size.x), 1}; }

  std::shared_ptr<const Projection> widened(double factor, const Vec2&) const override {
    return make_projection(Form{values_.fov_degrees * factor});
  }

  std::vector<CameraFact> facts(const Vec2&) const override {
    return {{"fov",
             fmt::format("{:.6g}° around", values_.fov_degrees),
             {{"horizontal_fov_degrees", values_.fov_degrees}}}};
  }

  CameraForm form() const override { return values_; }

 protected:
  // The angle that half the width spans, in radians.
  double half() const { return glm::radians(values_.fov_degrees) / 2; }

 private:
  Form values_;
};

}  // namespace eyeray::engine::cameras
