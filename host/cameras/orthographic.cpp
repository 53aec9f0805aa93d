#include <fmt/format.h>

#include "host/cameras/make.hpp"
#include "host/cameras/registry.hpp"
#include "host/records/records.hpp"

namespace eyeray::engine::cameras {

extern const CameraType orthographic_type;

namespace {

constexpr std::string_view manual =
    R"(All rays are parallel and start in the plane that contains the eye. Near and far objects have the same size in
the picture.

```toml
[camera]
type = "orthographic"
eye = [4, 3, 5]
size = 2.5
```
)";

constexpr Key keys[] = {
    {.name = "size",
     .type = KeyType::number,
     .doc = "Half the width of the view, in world units.",
     .fallback = "1",
     .min = 0,
     .above_min = true},
};

class Orthographic final : public Projection {
 public:
  explicit Orthographic(const OrthographicCamera& values) : values_(values) {}

  uint32_t kind() const override { return shader::CAMERA_orthographic; }

  Vec3 scale(const Vec2& size) const override { return {values_.size, values_.size * (size.y / size.x), 1}; }

  Ray ray(const CameraAxes& camera, const Vec2& position, const Vec2&, const Vec2&) const override {
    return {camera.eye + values_.size * (position.x * camera.u + position.y * camera.v), camera.w};
  }

  std::shared_ptr<const Projection> widened(double factor, const Vec2&) const override {
    return make_projection(OrthographicCamera{values_.size * factor});
  }

  std::vector<CameraFact> facts(const Vec2& size) const override {
    return {{"sees",
             fmt::format("{:.6g} × {:.6g} units", 2 * values_.size, 2 * values_.size * size.y / size.x),
             {{"size", values_.size}}}};
  }

  CameraForm form() const override { return values_; }

 private:
  OrthographicCamera values_;
};

std::shared_ptr<const Projection> parse(TableReader& table) {
  const OrthographicCamera values{table.number("size")};
  if (table.failed()) return nullptr;
  return make_projection(values);
}

}  // namespace

extern const CameraType orthographic_type{
    .name = "orthographic", .manual = manual, .keys = keys, .parse = parse};

std::shared_ptr<const Projection> make_projection(const OrthographicCamera& values) {
  return std::make_shared<Orthographic>(values);
}

}  // namespace eyeray::engine::cameras
