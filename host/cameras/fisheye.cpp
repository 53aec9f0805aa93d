#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/cameras/make.hpp"
#include "host/cameras/registry.hpp"
#include "host/records/records.hpp"

namespace eyeray::engine::cameras {

extern const CameraType fisheye_type;

namespace {

constexpr std::string_view manual =
    R"(A circle that shows all directions within half of `fov`, up to every direction there is. The distance of a
point from the circle's centre is proportional to its angle from the viewing direction (equidistant). The
picture is black outside the circle.

```toml
[camera]
type = "fisheye"
eye = [0, 1, 0]
target = [0, 2, 0]
up = [0, 0, -1]
fov = 180
```
)";

constexpr Key keys[] = {
    {.name = "fov",
     .type = KeyType::number,
     .doc = "Full angle of view across the circle, in degrees.",
     .fallback = "180",
     .min = 0,
     .max = 360,
     .above_min = true},
    {.name = "fov_axis",
     .type = KeyType::choice,
     .doc = "The side of the picture that equals the circle's diameter.",
     .fallback = "\"shorter\"",
     .choices = fov_axis_names},
};

class Fisheye final : public Projection {
 public:
  // `wider`: the factor by which the angle in view exceeds that of `values`, within the same circle.
  explicit Fisheye(const FisheyeCamera& values, double wider = 1) : values_(values), wider_(wider) {}

  uint32_t kind() const override { return shader::CAMERA_fisheye; }

  Vec3 scale(const Vec2& size) const override {
    const double across = wider_ * rim() * size.x / diameter(size);
    return {across, across * (size.y / size.x), rim()};
  }

  Ray ray(const CameraAxes& camera, const Vec2& position, const Vec2&, const Vec2& size) const override {
    const double angle = this->angle(position, size), turn = std::atan2(position.y, position.x);
    const Vec3 radial = std::cos(turn) * camera.u + std::sin(turn) * camera.v;
    return {camera.eye, glm::normalize(std::sin(angle) * radial + std::cos(angle) * camera.w)};
  }

  bool sees(const Vec2& position, const Vec2&, const Vec2& size) const override {
    return angle(position, size) <= rim();
  }

  std::shared_ptr<const Projection> widened(double factor, const Vec2&) const override {
    return std::make_shared<Fisheye>(values_, wider_ * factor);
  }

  std::vector<CameraFact> facts(const Vec2& size) const override {
    return {{"circle",
             fmt::format("{:.6g}° in {:.6g} pixels", values_.fov_degrees, diameter(size)),
             {{"circle_fov_degrees", values_.fov_degrees}, {"circle_pixels", diameter(size)}}}};
  }

  CameraForm form() const override { return values_; }

 private:
  double rim() const { return values_.fov_degrees * std::numbers::pi / 360; }

  // The length in pixels that the field of view spans.
  double diameter(const Vec2& size) const {
    const double lengths[] = {size.x, size.y, std::min(size.x, size.y), std::hypot(size.x, size.y)};
    return lengths[size_t(values_.fov_axis)];
  }

  // The angle between the ray at `position` and the camera's axis.
  double angle(const Vec2& position, const Vec2& size) const {
    return wider_ * glm::length(position) * (size.x / 2) *
           (glm::radians(values_.fov_degrees) / diameter(size));
  }

  FisheyeCamera values_;
  double wider_;
};

std::shared_ptr<const Projection> parse(TableReader& table) {
  const FisheyeCamera values{table.number("fov"), static_cast<FovAxis>(table.choice("fov_axis"))};
  if (table.failed()) return nullptr;
  return make_projection(values);
}

}  // namespace

extern const CameraType fisheye_type{.name = "fisheye", .manual = manual, .keys = keys, .parse = parse};

std::shared_ptr<const Projection> make_projection(const FisheyeCamera& values) {
  return std::make_shared<Fisheye>(values);
}

}  // namespace eyeray::engine::cameras
