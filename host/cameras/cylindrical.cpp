#include <cmath>

#include "host/cameras/registry.hpp"
#include "host/cameras/round.hpp"
#include "host/records/records.hpp"

namespace eyeray::engine::cameras {

extern const CameraType cylindrical_type;

namespace {

constexpr std::string_view manual =
    R"(The picture lies on a cylinder around the eye. Upright lines stay straight, and the whole horizon may be in
view.

```toml
[image]
width = 960
height = 240

[camera]
type = "cylindrical"
eye = [0, 1, 0]
target = [0, 1, -1]
fov = 360
```
)";

constexpr Key keys[] = {
    {.name = "fov",
     .type = KeyType::number,
     .doc = "Angle of view across the picture's width, in degrees.",
     .fallback = "180",
     .min = 0,
     .max = 360,
     .above_min = true},
};

class Cylindrical final : public RoundProjection<CylindricalCamera> {
 public:
  using RoundProjection::RoundProjection;

  uint32_t kind() const override { return shader::CAMERA_cylindrical; }

  Ray ray(const CameraAxes& camera, const Vec2& position, const Vec2&, const Vec2&) const override {
    const Vec2 on_cylinder = half() * position;
    return {camera.eye, glm::normalize(std::sin(on_cylinder.x) * camera.u + on_cylinder.y * camera.v +
                                       std::cos(on_cylinder.x) * camera.w)};
  }
};

std::shared_ptr<const Projection> parse(TableReader& table) {
  const CylindricalCamera values{table.number("fov")};
  if (table.failed()) return nullptr;
  return make_projection(values);
}

}  // namespace

extern const CameraType cylindrical_type{
    .name = "cylindrical", .manual = manual, .keys = keys, .parse = parse};

std::shared_ptr<const Projection> make_projection(const CylindricalCamera& values) {
  return std::make_shared<Cylindrical>(values);
}

}  // namespace eyeray::engine::cameras
