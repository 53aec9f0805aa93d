#include "host/loader/area_lights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/lights/registry.hpp"
#include "host/lights/strength.hpp"
#include "host/reading/table.hpp"

namespace eyeray::engine::loader {
namespace {

using reading::Key, reading::KeyType;

constexpr std::string_view shape_names[] = {"rectangle", "disk", "sphere", "triangle"};
constexpr std::string_view sections_of_shapes[] = {"parallelogram", "disk", "sphere", "triangle"};

constexpr Key own_keys[] = {
    {.name = "shape",
     .type = KeyType::choice,
     .doc = "The shape that emits the light. The table also has the keys of that shape.",
     .choices = shape_names},
    {.name = "emission_side",
     .type = KeyType::choice,
     .doc = "Emit light only on the side that the normal points to, or on both.",
     .fallback = "\"front\"",
     .choices = emission_sides},
    {.name = "nits",
     .type = KeyType::number,
     .doc = "Luminance, in candela per square metre: a screen has 300.",
     .min = 0,
     .optional = true},
    {.name = "lumens",
     .type = KeyType::number,
     .doc = "Luminous flux of the whole light, in lumens: a bulb of 60 W has 800.",
     .min = 0,
     .optional = true},
    {.name = "transform",
     .type = KeyType::transform,
     .doc = "Steps that move the light, applied in the order written.",
     .fallback = "[]"},
};

std::span<const Key> keys_of_every_area_light() {
  static const std::vector<Key> keys = [] {
    const std::span<const Key> of_lights = find_section("light")->keys;
    std::vector<Key> all(of_lights.begin(), of_lights.end());
    all.insert(all.end(), std::begin(own_keys), std::end(own_keys));
    return all;
  }();
  return keys;
}

// The area of a plane outline.
double polygon_area(const std::vector<Vec3>& outline) {
  Vec3 sum(0.0);
  for (size_t i = 1; i + 1 < outline.size(); ++i)
    sum += glm::cross(outline[i] - outline[0], outline[i + 1] - outline[0]);
  return glm::length(sum) / 2;
}

// 0 for an ellipsoid.
double area_of(const Shape& shape) {
  const ShapeForm form = shape.form();
  if (const auto* sphere = std::get_if<SphereForm>(&form)) return 4 * M_PI * sphere->radius * sphere->radius;
  const auto across = [](const Mat4& map, int a, int b) {
    return glm::length(glm::cross(Vec3(map[a]), Vec3(map[b])));
  };
  if (const auto* disk = std::get_if<DiskForm>(&form))
    return M_PI * across(disk->to_world, 0, 2) * (1 - disk->inner * disk->inner);
  if (const auto* triangle = std::get_if<TriangleForm>(&form))
    return polygon_area({triangle->vertices.begin(), triangle->vertices.end()});
  if (const auto* polygon = std::get_if<PolygonForm>(&form)) return polygon_area(polygon->outlines.front());
  return 0;
}

}  // namespace

std::span<const AreaShape> area_shapes() {
  static const std::vector<AreaShape> all = [] {
    std::vector<AreaShape> shapes;
    for (size_t i = 0; i < std::size(shape_names); ++i) {
      shapes.push_back({shape_names[i],
                        {Section::Kind::shape, "light", fmt::format("[[light]] of shape {}", shape_names[i]),
                         "", keys_of_every_area_light(), find_section(sections_of_shapes[i])->shape}});
    }
    return shapes;
  }();
  return all;
}

std::span<const Key> area_keys() {
  return own_keys;
}

std::string_view area_manual() {
  return R"(A surface that emits light. It is a shape of the scene: rays hit it, it hides the shapes behind it, and it reflects nothing. `path` and `sppm` sample it
as a light; the other integrators show it and cast no light from it.

```toml
[[light]]
type = "area"
shape = "rectangle"
origin = [-1, 4, -1]
edge_u = [2, 0, 0]
edge_v = [0, 0, 2]
intensity = 8
```

`intensity` is the radiance: each point of the surface emits as much in each direction. The light has the keys of its shape too: those of
[[[parallelogram]]](#parallelogram) for a rectangle, of [[[disk]]](#disk), [[[sphere]]](#sphere) and [[[triangle]]](#triangle). A `batch` or a `repeat` makes many lights.

A shape or mesh whose [[[material]]](#material) has `emission` is an area light as well; it may also reflect light, and its radiance may be a texture.
)";
}

Vec3 radiance_of(const Shape& shape, reading::TableReader& light) {
  const bool one_side = light.choice("emission_side") == 1 || shape.is_closed();
  const double lumens = M_PI * area_of(shape) * (one_side ? 1 : 2);
  return lights::read_intensity(light, 1, {{"nits", 1}, {"lumens", lumens}});
}

bool is_area_light(const toml::table& light) {
  const toml::node* type = light.get("type");
  return type && type->is_string() && type->as_string()->get() == lights::area_type;
}

const AreaShape* area_shape(const toml::table& light, const reading::ValueSources& sources,
                            DiagnosticLog& log) {
  const std::string_view name = light["shape"].value_or(std::string_view());
  const auto found = std::ranges::find(area_shapes(), name, &AreaShape::name);
  if (found != area_shapes().end()) return &*found;
  // Read the table to report the wrong shape. Other keys are allowed, since the shape determines them.
  reading::read_table({.title = "[[light]] of type area",
                       .table = &light,
                       .keys = {keys_of_every_area_light()},
                       .open = true,
                       .sources = sources},
                      log);
  return nullptr;
}

}  // namespace eyeray::engine::loader
