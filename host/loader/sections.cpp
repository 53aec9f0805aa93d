#include "host/loader/sections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/cameras/registry.hpp"
#include "host/core/diagnostic.hpp"
#include "host/lights/registry.hpp"
#include "host/loader/animation.hpp"
#include "host/loader/environments.hpp"
#include "host/loader/medium.hpp"
#include "host/loader/settings.hpp"
#include "host/materials/registry.hpp"
#include "host/reading/foreign_words.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::loader {

using reading::Key, reading::KeyType;

namespace {

template <typename Type>
std::vector<std::string_view> names_of(std::span<const Type* const> types) {
  std::vector<std::string_view> names;
  for (const Type* type : types) names.push_back(type->name);
  return names;
}

std::span<const Key> camera_keys() {
  static const std::vector<std::string_view> names = names_of(cameras::types());
  static const Key keys[] = {
      {.name = "type",
       .type = KeyType::choice,
       .doc = "Its kind; see below.",
       .fallback = "\"perspective\"",
       .choices = names},
      {.name = "eye", .type = KeyType::vec3, .doc = "Where the camera stands.", .fallback = "[0, 0, 5]"},
      {.name = "target",
       .type = KeyType::vec3,
       .doc = "The point it looks at, not the eye.",
       .fallback = "[0, 0, 0]"},
      {.name = "up",
       .type = KeyType::vec3,
       .doc = "What is up in the picture; not parallel to the way it looks.",
       .fallback = "[0, 1, 0]"},
  };
  return keys;
}

std::span<const Key> light_keys() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all = names_of(lights::types());
    all.push_back(lights::area_type);
    return all;
  }();
  static const Key keys[] = {
      {.name = "type", .type = KeyType::choice, .doc = "Its kind; see below.", .choices = names},
      {.name = "name",
       .type = KeyType::string,
       .doc = "What `-D` and [[track]] call it; several may share a name.",
       .optional = true},
      {.name = "intensity",
       .type = KeyType::color,
       .doc = "The light that arrives, at distance 1 from a point light; the radiance of an area light.",
       .fallback = "1"},
  };
  return keys;
}

constexpr std::string_view emission_sides[] = {"both", "front"};
constexpr std::string_view alpha_modes[] = {"mask", "blend"};

std::span<const Key> material_keys() {
  static const std::vector<std::string_view> names = names_of(materials::types());
  static const Key keys[] = {
      {.name = "name",
       .type = KeyType::string,
       .doc = "The name by which shapes refer to it, unique in the scene."},
      {.name = "type", .type = KeyType::choice, .doc = "Its kind; see below.", .choices = names},
      {.name = "alpha",
       .type = KeyType::texture,
       .doc =
           "How much of the surface there is. Of a color the first component counts, of an image its alpha. "
           "Only on shapes that a ray hits once.",
       .max = 1,
       .optional = true},
      {.name = "alpha_mode",
       .type = KeyType::choice,
       .doc =
           "\"mask\": where `alpha` is below `alpha_cutoff`, there is no surface. \"blend\": a ray hits the "
           "surface with a probability of `alpha`, so that on average it lets the rest through.",
       .fallback = "\"mask\"",
       .choices = alpha_modes},
      {.name = "alpha_cutoff",
       .type = KeyType::number,
       .doc = "The least `alpha` that is not cut out.",
       .fallback = "0.5",
       .min = 0,
       .max = 1,
       .above_min = true},
      {.name = "emission_side",
       .type = KeyType::choice,
       .doc = "Where light of its own goes: to both sides of its surfaces, or only to where their normals "
              "point.",
       .fallback = "\"both\"",
       .choices = emission_sides},
      {.name = "normal",
       .type = KeyType::texture,
       .doc =
           "A normal map, as glTF has them: which way the surface seems to face, in tangent space, red along "
           "u, green along v, [0.5, 0.5, 1] straight out. Codes of an image count as they are.",
       .max = 1,
       .optional = true},
      {.name = "normal_scale",
       .type = KeyType::number,
       .doc = "How strongly the normal map bends; below 0 the other way.",
       .fallback = "1",
       .min = -1000,
       .max = 1000},
      {.name = "bump",
       .type = KeyType::texture,
       .doc = "Heights by which the surface seems to rise, 0 where it is black. Of a color the luminance "
              "counts, "
              "codes of an image as they are.",
       .max = 1,
       .optional = true},
      {.name = "bump_height",
       .type = KeyType::number,
       .doc = "That of white, in the world; below 0 the surface sinks.",
       .fallback = "0.1"},
      {.name = "bump_width",
       .type = KeyType::number,
       .doc = "How far to each side heights are compared, and so half the width of a step's slope: in uv, or "
              "for "
              "patterns in space in the world. When absent a texel of an image, 0.03 units of a pattern, or "
              "0.01 "
              "of uv.",
       .min = 0,
       .above_min = true,
       .optional = true},
  };
  return keys;
}

constexpr Key name_key = {.name = "name",
                          .type = KeyType::string,
                          .doc = "What messages and legends call it; several may share a name.",
                          .optional = true};

constexpr Key shape_keys[] = {
    name_key,
    {.name = "material", .type = KeyType::string, .doc = "The `name` of a [[material]]."},
    {.name = "transform",
     .type = KeyType::transform,
     .doc = "Steps that move the shape, applied in the order written.",
     .fallback = "[]"},
};

constexpr Key keys_of_parts[] = {
    name_key,
    {.name = "material",
     .type = KeyType::string,
     .doc = "The `name` of a [[material]]; in a CSG object, that of the CSG object when absent.",
     .optional = true},
    shape_keys[2],
};

constexpr std::string_view mesh_manual =
    R"(The ending says what the file is: `.obj` (Wavefront), `.ply`, `.gltf` or `.glb` (glTF 2.0). The name is relative to the
scene file, and the file, as all that it names, lies in the scene's folder tree, links followed, or where `--allow-path`
says. A file is read once, and each table or element of a `batch` shows it once more: thousands of
instances take little more memory than one.

```
[[mesh]]
file = "meshes/bunny.obj"
material = "glass"
transform = [{ scale = 10 }, { translate = [0, -0.33, 0] }]
```

What a file has and eyeray leaves out is a warning. Cameras and lights of a glTF file count only where it is rendered
itself, `eyeray render model.glb`. [scene-file.md](scene-file.md#meshes) tells more.)";

constexpr Key mesh_keys[] = {
    name_key,
    {.name = "file", .type = KeyType::string, .doc = "The name of the file, relative to this one."},
    {.name = "material",
     .type = KeyType::string,
     .doc = "The `name` of a [[material]]; the file's own when absent, and where it has none, a light grey.",
     .optional = true},
    {.name = "transform",
     .type = KeyType::transform,
     .doc = "Steps that move the mesh, applied in the order written.",
     .fallback = "[]"},
    {.name = "smooth",
     .type = KeyType::number,
     .doc = "Faces that meet under less than this angle, in degrees, are shaded as one smooth surface, where "
            "the "
            "file has no normals; 0: flat. 40 when absent, and 0 for glTF.",
     .min = 0,
     .max = 180,
     .optional = true},
    {.name = "animation",
     .type = KeyType::string,
     .doc =
         "Which of a glTF file's animations is shown at the moment of [animation]: its name, or its number "
         "from 0, as `\"1\"`. The first when absent; `\"none\"`: the file at rest.",
     .optional = true},
    {.name = "loop",
     .type = KeyType::boolean,
     .doc = "Whether that animation begins again after its last key, and not stays there.",
     .fallback = "false"},
};

constexpr std::string_view group_manual =
    R"(Holds shapes, meshes and other groups, written `[[group.sphere]]`, `[[group.mesh]]`, `[[group.group]]` below it, and moves them as one. Each transform
of a `batch` shows the whole group once more. Materials are the scene's. A `name` of a group goes before those in it: `cart 2/wheel`.

```toml
[[group]]
batch = { transform = [[{ translate = [-2, 0, 0] }], [{ scale = 0.5 }, { translate = [2, 0, 0] }]] }

[[group.cylinder]]
from = [0, 0, 0]
to = [0, 2, 0]
radius = 0.1
material = "wall"

[[group.sphere]]
center = [0, 2, 0]
radius = 0.4
material = "glass"
```

An [[instance]](#instance) shows a group once more, by its `name`. With `pattern = true` it is shown by instances alone, and not where it is written.

A group that is placed many times is instanced; see `groups` of [render](#render). That costs no more memory than one, and changes no
id and no surface. One that holds a plane, which has no end, is copied.

A group may stretch and shear all that it holds: a sphere is an ellipsoid then.)";

constexpr std::string_view instance_manual =
    R"(Shows a [[group]] of the scene by its `name`, as if it were written here: also in another group, also many times by a `batch`.

```toml
[[group]]
name = "tree"
pattern = true

[[group.cone]]
from = [0, 1, 0]
to = [0, 4, 0]
radius = 1
material = "wall"

[[instance]]
group = "tree"
batch = { transform = [[{ translate = [-3, 0, 0] }], [{ scale = 1.5 }, { translate = [3, 0, 0] }]] }
```

A group that holds itself, by whatever way round, is an error.)";

constexpr Key instance_keys[] = {
    name_key,
    {.name = "group", .type = KeyType::string, .doc = "The `name` of a [[group]] that is in no other."},
    {.name = "transform",
     .type = KeyType::transform,
     .doc = "Steps that move it, applied in the order written, after those of the group.",
     .fallback = "[]"},
};

constexpr Key group_keys[] = {
    name_key,
    {.name = "pattern",
     .type = KeyType::boolean,
     .doc = "Whether it stands only where an [[instance]] names it; only of groups that are in no other.",
     .fallback = "false"},
    {.name = "transform",
     .type = KeyType::transform,
     .doc = "Steps that move all of it, applied in the order written, after those of what it holds.",
     .fallback = "[]"},
};

std::vector<Section> make_sections() {
  using enum Section::Kind;
  std::vector<Section> all = {
      {image, "image", "[image]", "The picture.", image_keys()},
      {camera, "camera", "[camera]", "Where from and how the scene is seen.", camera_keys()},
      {render, "render", "[render]", "How the picture is computed.", render_keys()},
      {environment, "environment", "[environment]",
       "Light from all around, in place of the `background` of [render].", environment_keys()},
      {medium, "medium", "[medium]",
       "What is around all, for the integrator `path`: fog, haze, water. The others see none of it.",
       medium_keys(), nullptr, medium_manual()},
      {verify, "verify", "[verify]", "What `eyeray verify` is told of the scene.", verify_keys()},
      {animation, "animation", "[animation]", "Which moment of an animation is shown.", animation_keys()},
      {track, "track", "[[track]]", "A value that moves, by its keyframes.", track_keys(), nullptr,
       track_manual},
      {light, "light", "[[light]]", "A light.", light_keys()},
      {material, "material", "[[material]]", "What surfaces are made of.", material_keys()},
      {mesh, "mesh", "[[mesh]]", "The triangles of a file.", mesh_keys, nullptr, mesh_manual},
  };
  for (const shapes::ShapeType* type : shapes::types()) {
    const std::span<const Key> keys = type->combine ? part_keys() : shape_keys;
    all.push_back({shape, type->name, fmt::format("[[{}]]", type->name), "", keys, type});
  }
  all.push_back({group, "group", "[[group]]", "Shapes, meshes and groups that are moved as one.", group_keys,
                 nullptr, group_manual});
  all.push_back({instance, "instance", "[[instance]]", "A group that is shown by its name.", instance_keys,
                 nullptr, instance_manual});
  return all;
}

}  // namespace

std::span<const Key> part_keys() {
  return keys_of_parts;
}

std::span<const Section> sections() {
  static const std::vector<Section> all = make_sections();
  return all;
}

const Section* find_section(std::string_view name) {
  for (const Section& section : sections()) {
    if (section.name == name) return &section;
  }
  return nullptr;
}

std::span<const std::string_view> placed_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const Section& section : sections())
      if (section.is_placed()) all.push_back(section.name);
    return all;
  }();
  return names;
}

std::string suggest_section(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Section& section : sections()) names.push_back(section.name);
  names.push_back(include_key);
  const std::string nearest = reading::suggest_name(name, names);
  if (nearest.empty()) return fmt::format("a scene has {}", fmt::join(names, ", "));
  const Section* section = find_section(nearest);
  return fmt::format("did you mean {}?", section ? section->title : nearest);
}

}  // namespace eyeray::engine::loader
