#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

#include "host/formula/formula.hpp"
#include "host/reading/formula_reader.hpp"
#include "host/records/packer.hpp"
#include "host/shapes/cube.hpp"
#include "host/shapes/formula_surface.hpp"
#include "host/shapes/keys.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/object_shape.hpp"
#include "host/shapes/ready_formulas.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(All points p between `min` and `max` where a function f(p) is negative. f is user-defined GLSL.
[formulas.md](formulas.md) describes the GLSL, and [implicit-surfaces.md](implicit-surfaces.md) describes how
rays find the surface.

```toml
[[implicit]]
code = """
float f(vec3 p) {
  float bumps = sin(12.0 * p.x) * sin(12.0 * p.y) * sin(12.0 * p.z);
  return length(p) - radius + 0.02 * bumps;
}
"""
parameters = { radius = 0.9 }
min = [-1, -1, -1]
max = [1, 1, 1]
lipschitz = 1.42
material = "wall"
```

The text of the function is in `code`, or in a separate file, `file = "bumps.glsl"`, or it is a `ready` one.
The entries of `parameters` are constants of the function, by name. A number becomes a `float`, a list of two
to four numbers a `vec2` … `vec4`.

`lipschitz` is a bound on the slope of f anywhere in the box: |f(p) − f(q)| ≤ `lipschitz` · |p − q|. Rays step
by |f| / `lipschitz`, so that no ray steps over the surface. If the bound is too small, there are holes; if it
is too large, rendering is slow. A function that is a distance has the bound 1. eyeray samples f when it reads
the scene, and warns with the point if a sample disproves the bound.

**Without `lipschitz`** eyeray itself bounds the values of f along each piece of a ray. It uses interval
arithmetic that it derives from your text. It steps over a piece only if f is certainly not zero there.
Normals are the exact derivatives of f. For polynomials and other smooth functions that takes fewer steps
(Barth's sextic: 7), and no bound is needed:

```toml
[[implicit]]
code = """
float f(vec3 p) {
  vec3 q = p * p;
  return dot(q, q - 5.0) + 11.8;
}
"""
min = [-2.4, -2.4, -2.4]
max = [2.4, 2.4, 2.4]
material = "wall"
```

Such a derivation is impossible, and an error at the line, in two cases. The first is a loop whose number of
iterations depends on p, or is above 1000. The second is an index or a whole number that is computed from p.
Loops with a fixed number of iterations are fine, also if they break off early.

Declare `lipschitz` where f is a distance, is undefined, or jumps. Nothing bounds 1/x around 0 or an angle
where it jumps, so the pieces become small there.

Closed: where the inside reaches the box, the box's faces are its caps. With `open = true` they are left out.
`transform` may be any invertible affine map. It moves the surface, its box and the coordinates that f
receives.

| `ready` | its parameters and their defaults |
| --- | --- |
| `metaballs` | `ball1` … `ball4` = [x, y, z, reach]: four balls that blend into each other. The weight of a ball is (1 − r²/reach²)³ at the distance r from [x, y, z], and 0 beyond `reach`. The surface is where the weights add up to `level` = 0.3 |
| `gyroid` | the points where the sum sin x cos y + sin y cos z + sin z cos x, at 2π/`period` times the point, is within `thickness` = 0.25 of `level` = 0; `period` = 1. Around the gyroid itself that is a wall with a width of 0.18 to 0.23 · `thickness` · `period` |
| `rounded-box` | `center` = [0, 0, 0], `half_size` = [0.8, 0.6, 0.7] with edges of `radius` = 0.2 |
| `smooth-union` | `sphere` = [0, 0.35, 0, 0.5] (centre and radius) and a box about `box_center` = [0, -0.4, 0] of `box_half_size` = [0.8, 0.25, 0.6], blended over `blend` = 0.4 |
| `mandelbulb` | of power 8 about the y axis: the points that are at most 1 from the origin after `rounds` = 2 iterations (at most 8). It lies within 1.25. It has no `lipschitz` and is found by intervals. 3 rounds take five times as long as 2, and a few rays in a thousand reach the iteration limit. The detail that they add is finer than float32 resolves, as `verify` finds |
| `height-field` | hills below y = `base` = 0 ± `height` = 0.5; the largest are `period` = 1 apart; `seed` = 1 |

**uv.** On a cap, the uv of that [box](#box) face. Elsewhere, the uv of the box face to which the normal would
point if the box were stretched to a cube. The texture is projected straight onto that face.

**Numeric trap.** All values are computed in the coordinates of the box. Rounding is 10⁻⁷ of its size, so
choose the box no larger than necessary, and near the origin of f. With `lipschitz` the smallest step of a ray
is 10⁻⁵ of half the box, so a ray may pass through walls thinner than that. With `lipschitz`, normals come
from `vec3 gradient(vec3 p)`, if the text has that function. Otherwise they are fourth-order differences over
1/256 of half the box. Much shorter waves, and edges, look smoother than they are.

A ray that has not ended after 4096 steps (without `lipschitz`, 4096 pieces) has reached the iteration limit,
and its pixel is reported. Without `lipschitz`, only this last limit applies. A change of sign is then
overlooked only where f is zero up to rounding ([numerics](numerics.md#implicit-surfaces-by-affine-bounds)).
Where f touches zero without a change of sign, there is no surface.

**Source.** Hart: Sphere Tracing: A Geometric Method for the Antialiased Ray Tracing of Implicit Surfaces, The Visual Computer 12, 1996. Comba, Stolfi: Affine Arithmetic and its Applications to Computer Graphics, SIBGRAPI 1993. Bálint, Valasek: Accelerating Sphere Tracing, Eurographics Short Papers 2018.
)";

constexpr Key keys[] = {
    {.name = "code",
     .type = KeyType::formula,
     .doc = "The function `float f(vec3 p)` and the functions that it calls.",
     .optional = true},
    reading::formula_file_key,
    {.name = "ready",
     .type = KeyType::choice,
     .doc = "Name of a function that comes with eyeray.",
     .choices = ready_names,
     .optional = true},
    reading::parameters_key,
    box_min_key,
    box_max_key,
    {.name = "lipschitz",
     .type = KeyType::number,
     .doc = "Bound on the slope of f. Most `ready` functions have one. Without it f is bounded by intervals.",
     .min = 0,
     .above_min = true,
     .optional = true},
    box_open_key,
};

// The surface in the space where its box is the cube.
class Implicit final : public ObjectShape {
 public:
  Implicit(const Mat4& to_world, FormulaUse use, bool open)
      : ObjectShape(shader::KIND_implicit, to_world, {}, typical_steps), use_(std::move(use)), open_(open) {}

  bool is_closed() const override { return !open_; }
  const FormulaUse* formula_use() const override { return &use_; }

  void pack(records::Packer& packer) const override {
    const Vec3 center = (use_.box.max + use_.box.min) * 0.5, extent = (use_.box.max - use_.box.min) * 0.5;
    pack_with(packer, {float(center.x), float(center.y), float(center.z),
                       float(packer.add_formula(use_.formula, use_.lipschitz == 0)), float(extent.x),
                       float(extent.y), float(extent.z), float(use_.lipschitz), open_ ? 1.0f : 0.0f});
  }

 private:
  static constexpr double itself = 6;  // Intersection::u, beside the cube's faces
  static constexpr int most_crossed = 1000;
  static constexpr size_t typical_steps = 96;  // typical steps of a ray in the shaders

  // Crossings with the surface, and with the cube's faces where they are within it; v is 1 if the ray enters.
  // Each search starts where f surely has the sign past the last crossing, so that entries and exits
  // alternate. If the search gives up, as after too many crossings, the sign changes there once more, and
  // then stays.
  Crossings crossings(const Ray& ray) const override {
    Crossings all;
    const auto span = cube::span(ray);
    if (!span) return all;
    const FormulaSurface surface(use_);
    bool inside = surface.value(ray.o + ray.d * span->in.t) < 0, iteration_limit = false;
    if (inside) all.add({span->in.t, double(span->in.face), 1});
    double from = span->in.t;
    int count = 0;
    while (const auto change =
               iteration_limit ? std::nullopt : surface.first_change(ray, from, span->out.t)) {
      inside = !inside;
      iteration_limit = change->iteration_limit || ++count > most_crossed;
      all.add({change->s, itself, inside ? 1.0 : 0.0, 0, iteration_limit});
      from = change->beyond;
    }
    if (inside) all.add({span->out.t, double(span->out.face), 0, 0, iteration_limit});
    return all;
  }
  bool enters(const Ray&, const Intersection& crossing) const override { return crossing.v != 0; }

  std::optional<Intersection> first(const Ray& ray, double from) const override {
    const auto span = cube::span(ray);
    if (!span || span->out.t <= from) return std::nullopt;
    const FormulaSurface surface(use_);
    const bool enters = span->in.t > from;
    const double start = enters ? span->in.t : from;
    const bool inside = surface.value(ray.o + ray.d * start) < 0;
    if (enters && inside && !open_) return Intersection{span->in.t, double(span->in.face), 0};
    if (const auto root = surface.first_change(ray, start, span->out.t))
      return Intersection{root->s, itself, 0, root->iteration_limit};
    const bool ends_inside = surface.value(ray.o + ray.d * span->out.t) < 0;
    if (ends_inside && inside && !open_) return Intersection{span->out.t, double(span->out.face), 0};
    return std::nullopt;
  }

  Point point(const Vec3& near, const Intersection& hit) const override {
    if (hit.u != itself) {
      const int face = int(hit.u);
      const Vec3 p = cube::onto(face, near);
      const auto [along_u, along_v] = cube::along_uv(face, cube::normal(face));
      return {p, cube::normal(face), cube::uv(face, p), along_u, along_v};
    }
    const FormulaSurface surface(use_);
    Vec3 gradient = surface.gradient(near);
    if (!(glm::dot(gradient, gradient) > 0 && std::isfinite(glm::dot(gradient, gradient))))
      gradient = {0, 1, 0};
    const Vec3 facing = glm::abs(gradient);
    const int axis = facing.x >= facing.y && facing.x >= facing.z ? 0 : facing.y >= facing.z ? 1 : 2;
    const int face = 2 * axis + (gradient[axis] < 0 ? 0 : 1);
    const auto [along_u, along_v] = cube::along_uv(face, gradient);
    return {near, gradient, cube::uv(face, near), along_u, along_v};
  }

  Bounds extent() const override { return {Vec3(-1), Vec3(1)}; }

  FormulaUse use_;
  bool open_;
};

// The formula from the key that the table has, with its parameters; null after an error. A ready formula sets
// `lipschitz`, if it has such a constant and the table has not.
std::shared_ptr<const formula::Formula> formula_of(TableReader& table, double& lipschitz) {
  constexpr std::string_view owner = "[[implicit]]";
  if (!has_one_source(table, {"code", "file", "ready"}, owner)) return nullptr;
  if (!table.has("ready")) return read_formula(table, owner, formula::FormulaKind::surface);

  // Lay the given keys over the defaults.
  const ReadyFormula& ready = ready_formulas()[size_t(table.choice("ready"))];
  std::vector<formula::FormulaParameter> all = ready.parameters;
  for (formula::FormulaParameter& given : formula_parameters(table)) {
    const auto known = std::ranges::find(all, given.name, &formula::FormulaParameter::name);
    if (known == all.end()) {
      std::vector<std::string_view> names;
      for (const formula::FormulaParameter& parameter : all) names.push_back(parameter.name);
      const std::string nearest = nearest_name(given.name, names);
      table.error("parameters",
                  fmt::format("\"{}\" has no parameter `{}`{}", ready.name, given.name,
                              nearest.empty() ? fmt::format("; its parameters are {}", fmt::join(names, ", "))
                                              : fmt::format("; did you mean `{}`?", nearest)));
      return nullptr;
    }
    if (known->values.size() != given.values.size()) {
      table.error("parameters",
                  fmt::format("`{}` must have {} number{}, not {}", given.name, known->values.size(),
                              known->values.size() == 1 ? "" : "s", given.values.size()));
      return nullptr;
    }
    known->values = given.values;
  }
  if (lipschitz == 0 && ready.lipschitz) lipschitz = ready.lipschitz(all);
  if (ready.lipschitz && !(std::isfinite(lipschitz) && lipschitz > 0)) {
    table.error("parameters", fmt::format("with these parameters \"{}\" has no surface", ready.name));
    return nullptr;
  }
  return std::make_shared<const formula::Formula>(
      formula::FormulaText{std::string(ready.text), {std::string(ready.name), 0, 0}}, std::move(all),
      formula_title(table, owner));
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 min = table.vec3("min");
  const Vec3 max = table.vec3("max");
  const bool declared = table.has("lipschitz");
  double lipschitz = declared ? table.number("lipschitz") : 0;
  const auto formula = table.failed() ? nullptr : formula_of(table, lipschitz);
  if (table.failed()) return nullptr;
  if (!(min.x < max.x && min.y < max.y && min.z < max.z)) {
    table.error("max", "the box has no volume: max must be above min in each coordinate");
    return nullptr;
  }
  if (out_of_range(table, transform * cube::placed(min, max))) return nullptr;
  if (lipschitz == 0 && formula->uncalled_other())
    table.warning(
        *formula->uncalled_other(),
        "`gradient` has no effect without `lipschitz`: the normals are the exact derivatives of `f`");
  return make_implicit({formula, {min, max}, lipschitz, declared}, table.boolean("open"), transform);
}

}  // namespace

extern const ShapeType implicit_type{.name = "implicit", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_implicit(FormulaUse use, bool open, const Mat4& transform) {
  const Mat4 to_world = transform * cube::placed(use.box.min, use.box.max);
  return std::make_unique<Implicit>(to_world, std::move(use), open);
}

}  // namespace eyeray::engine::shapes
