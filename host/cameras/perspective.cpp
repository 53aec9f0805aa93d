#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/cameras/make.hpp"
#include "host/cameras/registry.hpp"
#include "host/records/records.hpp"

namespace eyeray::engine::cameras {

extern const CameraType perspective_type;

namespace {

constexpr std::string_view manual =
    R"(All rays start at the eye: an object at twice the distance appears half as large.

```toml
[camera]
eye = [0, 1, 6]
target = [0, 0, 0]
fov = 35
```

With an `aperture`, rays start on a lens around the eye. Points at the distance `focus`, measured along the
viewing direction, are sharp. A point in front of that distance or behind it appears as a disk, or as a
polygon with one corner for each of the aperture's `blades`. An aperture needs many samples per pixel. A
larger aperture needs more:

```toml
[image]
samples = 64

[camera]
eye = [0, 1, 6]
target = [0, 0, 0]
aperture = 0.1
focus = 5
blades = 6
```

A photographic lens of focal length f at f/N has an `aperture` of f / 2N, in world units. First hits, and the
AOVs made from them, are traced through the centre of the lens.
)";

constexpr Key keys[] = {
    {.name = "fov",
     .type = KeyType::number,
     .doc = "Full angle of view along `fov_axis`, in degrees.",
     .fallback = "45",
     .min = 0,
     .max = 180,
     .above_min = true,
     .below_max = true},
    {.name = "fov_axis",
     .type = KeyType::choice,
     .doc = "The side of the picture that `fov` spans.",
     .fallback = "\"horizontal\"",
     .choices = fov_axis_names},
    {.name = "aperture",
     .type = KeyType::number,
     .doc = "Radius of the lens, in world units. At 0 all rays start at the eye and everything is sharp.",
     .fallback = "0",
     .min = 0},
    {.name = "focus",
     .type = KeyType::number,
     .doc = "Distance at which points are sharp, along the viewing direction. The default is the distance of "
            "`target`.",
     .min = 0,
     .above_min = true,
     .optional = true},
    {.name = "blades",
     .type = KeyType::integer,
     .doc = "Number of corners of the lens, which lie on the circle of radius `aperture`. The default lens "
            "is a disk.",
     .min = 3,
     .max = 64,
     .optional = true},
    {.name = "blade_rotation",
     .type = KeyType::number,
     .doc = "Rotation of the corners, in degrees: at 0 one corner is at the right, at 90 one is at the top.",
     .fallback = "0"},
};

double degrees_from_tangent(double half) {
  return std::atan(half) * 360 / std::numbers::pi;
}

class Perspective final : public Projection {
 public:
  explicit Perspective(const PerspectiveCamera& values) : values_(values) {}

  uint32_t kind() const override { return shader::CAMERA_perspective; }

  // `forward` ends on an image plane whose X reaches from −1 to 1.
  Vec3 scale(const Vec2& size) const override { return {1, size.y / size.x, 1 / half_width(size)}; }

  Ray ray(const CameraAxes& camera, const Vec2& position, const Vec2& lens, const Vec2& size) const override {
    const double distance = 1.0 / horizontal_tangent(size);
    const Vec3 way = position.x * camera.u + position.y * camera.v + distance * camera.w;
    if (values_.aperture.radius == 0) return {camera.eye, glm::normalize(way)};
    const Vec3 start = lens.x * camera.u + lens.y * camera.v;
    return {camera.eye + start, glm::normalize(values_.aperture.focus / distance * way - start)};
  }

  Aperture aperture() const override { return values_.aperture; }

  std::shared_ptr<const Projection> widened(double factor, const Vec2& size) const override {
    const double degrees = std::atan2(factor, scale(size).z) * 360 / std::numbers::pi;
    return make_projection(PerspectiveCamera{degrees, FovAxis::horizontal, values_.aperture});
  }

  std::vector<CameraFact> facts(const Vec2& size) const override {
    const double distance = scale(size).z;
    const double across = degrees_from_tangent(half_width(size));
    const double down = degrees_from_tangent(half_width(size) * (size.y / size.x));
    std::vector<CameraFact> all{
        {"D",
         fmt::format("{:.6g}, the image plane's distance in half widths", distance),
         {{"distance", distance}}},
        {"fov",
         fmt::format("{:.6g}° horizontal, {:.6g}° vertical", across, down),
         {{"horizontal_fov_degrees", across}, {"vertical_fov_degrees", down}}},
    };
    if (const Aperture& lens = values_.aperture; lens.radius > 0)
      all.push_back({"lens",
                     fmt::format("radius {:.6g}, {}in focus at {:.6g}", lens.radius,
                                 lens.blades ? fmt::format("{} blades, ", lens.blades) : "", lens.focus),
                     {{"aperture", lens.radius}, {"focus", lens.focus}}});
    return all;
  }

  CameraForm form() const override { return values_; }

 private:
  // tan(α/2) scales like the length along which α is measured; bring it to the width.
  double half_width(const Vec2& size) const {
    const double lengths[] = {size.x, size.y, std::min(size.x, size.y), std::hypot(size.x, size.y)};
    const double measured = lengths[size_t(values_.fov_axis)];
    return std::tan(values_.fov_degrees * std::numbers::pi / 360) * size.x / measured;
  }

  // tan(α/2) for the horizontal field of view α. The reference uses it.
  double horizontal_tangent(const Vec2& size) const {
    const double tangent = std::tan(values_.fov_degrees * std::numbers::pi / 360.0);
    switch (values_.fov_axis) {
      case FovAxis::horizontal:
        return tangent;
      case FovAxis::vertical:
        return tangent * size.x / size.y;
      case FovAxis::shorter:
        return size.x <= size.y ? tangent : tangent * size.x / size.y;
      case FovAxis::diagonal:
        return tangent * size.x / std::sqrt(size.x * size.x + size.y * size.y);
    }
    return tangent;
  }

  PerspectiveCamera values_;
};

std::shared_ptr<const Projection> parse(TableReader& table) {
  const Aperture aperture{
      .radius = table.number("aperture"),
      .focus =
          table.has("focus") ? table.number("focus") : glm::length(table.vec3("target") - table.vec3("eye")),
      .blades = table.has("blades") ? int(table.integer("blades")) : 0,
      .blade_rotation = glm::radians(table.number("blade_rotation")),
  };
  const PerspectiveCamera values{table.number("fov"), static_cast<FovAxis>(table.choice("fov_axis")),
                                 aperture};
  if (table.failed()) return nullptr;
  for (const char* key : {"focus", "blades", "blade_rotation"})
    if (aperture.radius == 0 && table.has(key)) {
      table.warning(key, fmt::format("`{}` has no effect without an `aperture`: everything is sharp", key));
      break;
    }
  return make_projection(values);
}

}  // namespace

extern const CameraType perspective_type{
    .name = "perspective", .manual = manual, .keys = keys, .parse = parse};

std::shared_ptr<const Projection> make_projection(const PerspectiveCamera& values) {
  return std::make_shared<Perspective>(values);
}

}  // namespace eyeray::engine::cameras
