#include "host/formula/formula.hpp"

#include <array>

#include "host/cameras/make.hpp"
#include "host/cameras/registry.hpp"
#include "host/reading/formula_reader.hpp"
#include "host/records/records.hpp"

namespace eyeray::engine::cameras {

extern const CameraType formula_type;

namespace {

constexpr std::string_view manual =
    R"(A user-defined camera. A function returns the direction of the ray that passes through a point of the picture.
[formulas.md](formulas.md) describes the GLSL that it may use.

```toml
[camera]
type = "formula"
eye = [0, 1, 6]
target = [0, 0, 0]
parameters = { distance = 2.4 }
code = """
vec3 direction(vec2 place, vec2 lens) { return vec3(place, distance); }
"""
```

`place` is measured from the middle of the picture, to the right and up. The left and right borders are at x =
−1 and 1, and the upper border is at y = height / width. Directions are given in the camera's own axes: x to
the right, y up, z along the viewing direction. They may have any length but 0. A pixel is black if its
direction has length 0 or is not a number. The function `vec3 origin(vec2 place, vec2 lens)` is optional. It
returns the start of the ray in the same axes, relative to the eye. `lens` is a point of the disk of radius 1,
a different one for each sample. For first hits and the AOVs made from them, `lens` is the centre of the disk.
)";

constexpr Key keys[] = {
    {.name = "code",
     .type = KeyType::formula,
     .doc = "The function `vec3 direction(vec2 place, vec2 lens)` and the functions that it calls.",
     .optional = true},
    reading::formula_file_key,
    reading::parameters_key,
};

// Limits of the direction's squared length and of the origin, beyond which float32 cannot compute.
constexpr double least_squared = 1e-30, most_squared = 1e30, farthest = 1e12;

class FormulaProjection final : public Projection {
 public:
  FormulaProjection(std::shared_ptr<const formula::Formula> formula, double wider)
      : formula_(std::move(formula)), wider_(wider) {}

  uint32_t kind() const override { return shader::CAMERA_formula; }

  Vec3 scale(const Vec2& size) const override { return {wider_, wider_ * (size.y / size.x), 1}; }

  Ray ray(const CameraAxes& camera, const Vec2& position, const Vec2& lens, const Vec2&) const override {
    const auto in_world = [&](const Vec3& v) { return v.x * camera.u + v.y * camera.v + v.z * camera.w; };
    const Own own = ask(position, lens);
    if (!own.usable()) return {camera.eye, camera.w};
    return {camera.eye + in_world(own.origin), glm::normalize(in_world(own.direction))};
  }

  bool sees(const Vec2& position, const Vec2& lens, const Vec2&) const override {
    return ask(position, lens).usable();
  }

  Aperture aperture() const override { return {.radius = 1}; }
  std::shared_ptr<const formula::Formula> function() const override { return formula_; }

  std::shared_ptr<const Projection> widened(double factor, const Vec2&) const override {
    return std::make_shared<FormulaProjection>(formula_, wider_ * factor);
  }

  std::vector<CameraFact> facts(const Vec2&) const override { return {{"function", formula_->title(), {}}}; }

 private:
  // The formula's ray, in the camera's axes.
  struct Own {
    Vec3 direction, origin;

    bool usable() const {
      const double squared = glm::dot(direction, direction);
      const Vec3 far = glm::abs(origin);
      return squared > least_squared && squared < most_squared && far.x <= farthest && far.y <= farthest &&
             far.z <= farthest;
    }
  };
  Own ask(const Vec2& position, const Vec2& lens) const {
    const std::array<double, 4> at{wider_ * position.x, wider_ * position.y, lens.x, lens.y};
    const auto direction = formula_->direction(at), origin = formula_->origin(at);
    return {{direction[0], direction[1], direction[2]}, {origin[0], origin[1], origin[2]}};
  }

  std::shared_ptr<const formula::Formula> formula_;
  double wider_;
};

std::shared_ptr<const Projection> parse(TableReader& table) {
  constexpr std::string_view owner = "[camera]";
  if (!has_one_source(table, {"code", "file"}, owner)) return nullptr;
  if (table.failed()) return nullptr;
  auto formula = read_formula(table, owner, formula::FormulaKind::camera);
  return formula ? make_projection(std::move(formula)) : nullptr;
}

}  // namespace

extern const CameraType formula_type{.name = "formula", .manual = manual, .keys = keys, .parse = parse};

std::shared_ptr<const Projection> make_projection(std::shared_ptr<const formula::Formula> formula) {
  return std::make_shared<FormulaProjection>(std::move(formula), 1);
}

}  // namespace eyeray::engine::cameras
