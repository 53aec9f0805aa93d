#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "host/formula/formula.hpp"
#include "host/reading/formula_reader.hpp"
#include "host/scene/affine.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/object_shape.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(Balls and rods that melt into each other, as POV-Ray's blob. Each has a strength at its centre or axis, which falls
to 0 at its radius: strength · (1 − d²/radius²)² at the distance d. The blob is where the strengths add up to more
than `threshold`. A negative strength makes a dent. Closed; the normal points outward.

```toml
[[blob]]
spheres = [[-0.6, 1, 0, 1, 1], [0.6, 1, 0, 1, 1], [0, 1.4, 0.7, 0.6, -0.8]]
cylinders = [[-1.4, 0.8, 0, 1.4, 0.8, 0, 0.5, 1]]
threshold = 0.4
material = "wall"
```

The ends of rods are round. A blob whose sum exceeds the threshold nowhere shows nothing, and a warning points at it. `transform` may be any invertible affine map. A blob has at most 32 parts.

**uv, numeric trap.** As for an [implicit](#implicit) surface with a `lipschitz` constant, which a blob is. The bound
of the slope adds up that of parts that touch one another, so rays find a blob of parts side by side sooner than one of
parts in each other.

**Source.** POV-Ray 3.7, reference, section 3.4.5.1.1 (Blob). Wyvill, McPheeters, Wyvill: Data structure for soft objects, The Visual Computer 2, 1986.
)";

constexpr std::string_view sphere_columns[] = {"x", "y", "z", "radius", "strength"};
constexpr std::string_view cylinder_columns[] = {"x", "y", "z", "to_x", "to_y", "to_z", "radius", "strength"};

constexpr Key keys[] = {
    {.name = "spheres",
     .type = KeyType::rows,
     .doc = "Balls: centre, the radius at which they end, and strength.",
     .fallback = "[]",
     .min = -max_coordinate,
     .max = max_coordinate,
     .choices = sphere_columns},
    {.name = "cylinders",
     .type = KeyType::rows,
     .doc = "Rods: both ends of the axis, the radius at which they end, and strength.",
     .fallback = "[]",
     .min = -max_coordinate,
     .max = max_coordinate,
     .choices = cylinder_columns},
    {.name = "threshold",
     .type = KeyType::number,
     .doc = "The sum of strengths at the surface.",
     .fallback = "0.5",
     .min = 1e-3,
     .max = 1e3},
};
constexpr size_t most_parts = 32;

// A ball is a rod whose ends are one point.
struct Part {
  Vec3 from, to;
  double radius, strength;
  // The greatest slope of s(1 − d²/r²)², which it has at d = r/√3.
  double slope() const { return 8 / (3 * std::sqrt(3.0)) * std::fabs(strength) / radius; }
  double distance(const Vec3& p) const {
    const Vec3 axis = to - from, v = p - from;
    const double squared = glm::dot(axis, axis);
    const double along = squared > 0 ? std::clamp(glm::dot(v, axis) / squared, 0.0, 1.0) : 0.0;
    return glm::length(v - axis * along);
  }
  double strength_at(double distance) const {
    const double share = std::max(1 - distance * distance / (radius * radius), 0.0);
    return strength * share * share;
  }
  Bounds bounds() const { return {glm::min(from, to) - Vec3(radius), glm::max(from, to) + Vec3(radius)}; }
};

// A bound of the slope of the sum: at any point all parts that count touch one another.
double slope_of(const std::vector<Part>& parts) {
  double most = 0;
  for (const Part& part : parts) {
    const Bounds box = part.bounds();
    double sum = 0;
    for (const Part& other : parts) {
      const Bounds there = other.bounds();
      if (glm::all(glm::lessThanEqual(glm::max(box.min, there.min), glm::min(box.max, there.max))))
        sum += other.slope();
    }
    most = std::max(most, sum);
  }
  return most;
}

// True if the sum is above `threshold` nowhere within `half` of the origin. Cells whose bound of the sum is
// above it are halved. False if more than `most_cells` do not decide it.
bool is_empty(const std::vector<Part>& parts, const Vec3& half, double threshold) {
  constexpr int most_cells = 20'000;
  struct Cell {
    Vec3 center, half;
  };
  std::vector<Cell> cells{{Vec3(0.0), half}};
  for (int tried = 0; !cells.empty(); ++tried) {
    if (tried == most_cells) return false;
    Cell cell = cells.back();
    cells.pop_back();
    const double reach = glm::length(cell.half);
    double sum = 0, most = 0;
    for (const Part& part : parts) {
      const double away = part.distance(cell.center);
      sum += part.strength_at(away);
      most += part.strength_at(part.strength > 0 ? std::max(away - reach, 0.0) : away + reach);
    }
    if (sum > threshold) return false;
    if (most <= threshold) continue;
    const Vec3& h = cell.half;
    const int axis = h.x >= h.y && h.x >= h.z ? 0 : h.y >= h.z ? 1 : 2;
    const double step = cell.half[axis] /= 2;
    for (const double side : {-step, step}) {
      cells.push_back(cell);
      cells.back().center[axis] += side;
    }
  }
  return true;
}

constexpr std::string_view functions = R"glsl(
vec3 off_part(vec3 p, int i) {
  vec3 axis = to[i].xyz - from[i].xyz;
  vec3 v = p - from[i].xyz;
  return v - axis * clamp(dot(v, axis) / max(dot(axis, axis), 1.0e-20), 0.0, 1.0);
}
float f(vec3 p) {
  float sum = threshold;
  for (int i = 0; i < count; i++) {
    vec3 v = off_part(p, i);
    float share = max(1.0 - dot(v, v) / (from[i].w * from[i].w), 0.0);
    sum -= to[i].w * share * share;
  }
  return sum;
}
vec3 gradient(vec3 p) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < count; i++) {
    vec3 v = off_part(p, i);
    float square = from[i].w * from[i].w;
    sum += v * (4.0 * to[i].w * max(1.0 - dot(v, v) / square, 0.0) / square);
  }
  return sum;
}
)glsl";

// "const vec4 NAME[2] = vec4[2](vec4(…), …);", a line of GLSL.
std::string array_text(std::string_view name, const std::vector<Vec4>& elements) {
  std::vector<std::string> values;
  for (const Vec4& v : elements)
    values.push_back(fmt::format("vec4({:#.9g}, {:#.9g}, {:#.9g}, {:#.9g})", v.x, v.y, v.z, v.w));
  return fmt::format("const vec4 {0}[{1}] = vec4[{1}]({2});\n", name, elements.size(),
                     fmt::join(values, ", "));
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  std::vector<Part> parts;
  const auto add = [&](std::string_view key, const std::vector<double>& row, size_t index, const Vec3& to,
                       size_t radius) {
    if (!(row[radius] >= min_radius && std::fabs(row[radius + 1]) <= 1e3))
      table.error(key,
                  fmt::format("a radius must be from {} up, and a strength from -1000 to 1000", min_radius),
                  {index});
    parts.push_back({{row[0], row[1], row[2]}, to, row[radius], row[radius + 1]});
  };
  const auto spheres = table.rows("spheres"), cylinders = table.rows("cylinders");
  for (size_t i = 0; i < spheres.size(); ++i)
    add("spheres", spheres[i], i, {spheres[i][0], spheres[i][1], spheres[i][2]}, 3);
  for (size_t i = 0; i < cylinders.size(); ++i)
    add("cylinders", cylinders[i], i, {cylinders[i][3], cylinders[i][4], cylinders[i][5]}, 6);
  if (table.failed()) return nullptr;
  if (parts.size() > most_parts) {
    table.error("spheres", fmt::format("a blob has at most {} parts, not {}", most_parts, parts.size()));
    return nullptr;
  }
  const double threshold = table.number("threshold");
  double strengths = 0;
  Bounds around{Vec3(HUGE_VAL), Vec3(-HUGE_VAL)};
  for (const Part& part : parts) {
    if (part.strength <= 0) continue;
    strengths += part.strength;
    around = {glm::min(around.min, part.bounds().min), glm::max(around.max, part.bounds().max)};
  }
  if (strengths <= threshold) {
    table.error("threshold",
                fmt::format("the blob is empty: all strengths add up to {}, not above the threshold {}",
                            strengths, threshold));
    return nullptr;
  }

  // The formula is in a space in which the blob is about 2 wide.
  const Vec3 center = (around.min + around.max) * 0.5, half = (around.max - around.min) * 0.5;
  const double scale = std::max({half.x, half.y, half.z});
  std::vector<Vec4> from, to;
  for (Part& part : parts) {
    part = {(part.from - center) / scale, (part.to - center) / scale, part.radius / scale, part.strength};
    from.emplace_back(part.from, part.radius);
    to.emplace_back(part.to, part.strength);
  }
  if (is_empty(parts, half / scale, threshold))
    table.warning(
        "threshold",
        fmt::format(
            "the blob is empty: at no point do its strengths add up to more than the threshold {}; lower "
            "`threshold`, or move its parts closer together",
            threshold));
  const Mat4 to_world = glm::scale(glm::translate(transform, center), Vec3(scale));
  const Vec3 room = half / scale * 1.001;  // the surface must not touch the box's faces
  if (out_of_range(table, glm::scale(to_world, room))) return nullptr;
  const std::string title = reading::formula_title(table, "[[blob]]");
  auto formula = std::make_shared<const formula::Formula>(
      formula::FormulaText{array_text("from", from) + array_text("to", to) +
                               fmt::format("const float threshold = {:#.9g};\nconst int count = {};\n",
                                           threshold, parts.size()) +
                               std::string(functions),
                           {title, 0, 0}},
      std::vector<formula::FormulaParameter>{}, title);
  return make_implicit({std::move(formula), {-room, room}, slope_of(parts)}, false, to_world);
}

}  // namespace

extern const ShapeType blob_type{.name = "blob", .manual = manual, .keys = keys, .parse = parse};

}  // namespace eyeray::engine::shapes
