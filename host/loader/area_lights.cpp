#include "host/loader/area_lights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "host/lights/registry.hpp"
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
[[[parallelogram]]](#parallelogram) for a rectangle, of [[[disk]]](#disk), [[[sphere]]](#sphere) and [[[triangle]]](#triangle). A `batch` makes many lights.

A shape or mesh whose [[[material]]](#material) has `emission` is an area light as well; it may also reflect light, and its radiance may be a texture.
)";
}

bool is_area_light(const toml::table& light) {
  const toml::node* type = light.get("type");
  return type && type->is_string() && type->as_string()->get() == lights::area_type;
}

const AreaShape* area_shape(const toml::table& light, DiagnosticLog& log) {
  const std::string_view name = light["shape"].value_or(std::string_view());
  const auto found = std::ranges::find(area_shapes(), name, &AreaShape::name);
  if (found != area_shapes().end()) return &*found;
  // Read the table to report the wrong shape. Other keys are allowed, since the shape determines them.
  reading::read_table({.title = "[[light]] of type area",
                       .table = &light,
                       .keys = {keys_of_every_area_light()},
                       .open = true},
                      log);
  return nullptr;
}

}  // namespace eyeray::engine::loader
