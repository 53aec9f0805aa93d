#include <cmath>

#include "host/cameras/registry.hpp"
#include "host/cameras/round.hpp"
#include "host/records/records.hpp"

namespace eyeray::engine::cameras {

extern const CameraType panorama_type;

namespace {

constexpr std::string_view manual =
    R"(The sphere around the eye, with longitude across and latitude up (equirectangular), as in environment maps. A
picture twice as wide as high shows the whole sphere. A higher picture continues beyond the poles.

```toml
[image]
width = 1024
height = 512

[camera]
type = "panorama"
eye = [0, 1, 0]
target = [0, 1, -1]
```
)";

constexpr Key keys[] = {
    {.name = "fov",
     .type = KeyType::number,
     .doc = "Angle of view across the picture's width, in degrees. The height has the same angle per pixel.",
     .fallback = "360",
     .min = 0,
     .max = 360,
     .above_min = true},
};

class Panorama final : public RoundProjection<PanoramaCamera> {
 public:
  using RoundProjection::RoundProjection;

  uint32_t kind() const override { return shader::CAMERA_panorama; }

  Ray ray(const CameraAxes& camera, const Vec2& position, const Vec2&, const Vec2&) const override {
    const double longitude = half() * position.x, latitude = half() * position.y;
    const Vec3 level = std::sin(longitude) * camera.u + std::cos(longitude) * camera.w;
    return {camera.eye, glm::normalize(std::cos(latitude) * level + std::sin(latitude) * camera.v)};
  }
};

std::shared_ptr<const Projection> parse(TableReader& table) {
  const PanoramaCamera values{table.number("fov")};
  if (table.failed()) return nullptr;
  return make_projection(values);
}

}  // namespace

extern const CameraType panorama_type{.name = "panorama", .manual = manual, .keys = keys, .parse = parse};

std::shared_ptr<const Projection> make_projection(const PanoramaCamera& values) {
  return std::make_shared<Panorama>(values);
}

}  // namespace eyeray::engine::cameras
