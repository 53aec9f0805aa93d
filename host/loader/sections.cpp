#include "host/loader/sections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/cameras/registry.hpp"
#include "host/core/diagnostic.hpp"
#include "host/importers/import.hpp"
#include "host/lights/registry.hpp"
#include "host/lights/strength.hpp"
#include "host/loader/animation.hpp"
#include "host/loader/environments.hpp"
#include "host/loader/materials.hpp"
#include "host/loader/medium.hpp"
#include "host/loader/settings.hpp"
#include "host/loader/variables.hpp"
#include "host/reading/foreign_words.hpp"
#include "host/scene/affine.hpp"
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
       .doc = "Kind; see below.",
       .fallback = "\"perspective\"",
       .choices = names},
      {.name = "eye", .type = KeyType::vec3, .doc = "Position of the camera.", .fallback = "[0, 0, 5]"},
      {.name = "target",
       .type = KeyType::vec3,
       .doc = "The point that the camera looks at. It must differ from `eye`.",
       .fallback = "[0, 0, 0]"},
      {.name = "up",
       .type = KeyType::vec3,
       .doc = "Direction that points up in the picture. It must not be parallel to the viewing direction.",
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
  static const std::vector<Key> keys = [] {
    std::vector<Key> all{
        {.name = "type", .type = KeyType::choice, .doc = "Kind; see below.", .choices = names},
        {.name = "name",
         .type = KeyType::string,
         .doc = "Name for `-D` and [[track]]; several lights may share it.",
         .optional = true}};
    all.insert(all.end(), lights::strength_keys().begin(), lights::strength_keys().end());
    return all;
  }();
  return keys;
}

constexpr Key name_key = {.name = "name",
                          .type = KeyType::string,
                          .doc = "Name in messages and legends. Several objects may share a name.",
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
     .doc = "The `name` of a [[material]]. A part of a CSG object without one has the material of the CSG "
            "object.",
     .optional = true},
    shape_keys[2],
};

constexpr std::string_view mesh_manual =
    R"(The ending of the file name selects the format: `.obj` (Wavefront), `.ply`, `.stl`, `.off`, `.3mf`, `.gltf`
or `.glb` (glTF 2.0), and for points `.ply` without faces, `.xyz` or `.pcd`. Points are spheres or disks. The name is relative
to the scene file. The file, and all files that it names, must lie in the scene's folder tree after following links,
or in a folder that `--allow-path` allows. A file is read once. Each table, and each
element of a `batch`, is one more instance of it, so thousands of instances need little more memory than one.

```
[[mesh]]
file = "meshes/bunny.obj"
material = "glass"
transform = [{ scale = 10 }, { translate = [0, -0.33, 0] }]
```

eyeray warns about each feature of the file that it ignores. Cameras and lights of a glTF file are used only
where that file itself is rendered, `eyeray render model.glb`. See [scene-file.md](scene-file.md#meshes) for
details.)";

constexpr Key mesh_keys[] = {
    name_key,
    {.name = "file", .type = KeyType::string, .doc = "Name of the file, relative to this scene file."},
    {.name = "material",
     .type = KeyType::string,
     .doc = "The `name` of a [[material]]. When absent: the file's own, or else a light grey.",
     .optional = true},
    {.name = "transform",
     .type = KeyType::transform,
     .doc = "Steps that move the mesh, applied in the order written.",
     .fallback = "[]"},
    {.name = "smooth",
     .type = KeyType::number,
     .doc = "Faces that meet at less than this angle, in degrees, are shaded as one smooth surface, unless "
            "the file has normals. 0 means flat shading. When absent: 40, and 0 for glTF.",
     .min = 0,
     .max = 180,
     .optional = true},
    {.name = "point_shape",
     .type = KeyType::choice,
     .doc = "Shape of a point: a sphere, or a disk perpendicular to its normal in the file.",
     .fallback = "\"sphere\"",
     .choices = importers::point_shape_names},
    {.name = "point_size",
     .type = KeyType::number,
     .doc = "Diameter of those spheres or disks, in the file's units. When absent, it follows from the "
            "distances between points, so that a dense scan looks closed.",
     .min = 0,
     .max = max_coordinate,
     .above_min = true,
     .optional = true},
    {.name = "line_width",
     .type = KeyType::number,
     .doc = "Diameter of the capsules that show the lines of OBJ and glTF, in the file's units. When absent, "
            "lines are left out.",
     .min = 0,
     .max = max_coordinate,
     .above_min = true,
     .optional = true},
    {.name = "up",
     .type = KeyType::choice,
     .doc = "The axis of the file's coordinates that points up; it becomes +y. Most scans and CAD files have "
            "`\"z\"`. glTF always has `\"y\"`.",
     .fallback = "\"y\"",
     .choices = importers::up_names},
    {.name = "animation",
     .type = KeyType::string,
     .doc = "The animation of a glTF file that is shown at the moment of [animation]: its name, or its "
            "number from 0, such as `\"1\"`. When absent, the first. `\"none\"` shows the file at rest.",
     .optional = true},
    {.name = "gltf_scene",
     .type = KeyType::string,
     .doc = "Scene of a glTF file: its name, or its number from 0. When absent, the file's default.",
     .optional = true},
    {.name = "variant",
     .type = KeyType::string,
     .doc = "The variant of a glTF file's materials (KHR_materials_variants), such as another colour of a "
            "product: its name, or its number from 0. When absent, the file's default.",
     .optional = true},
    {.name = "loop",
     .type = KeyType::boolean,
     .doc = "If true, that animation restarts after its last key; if false, it stays there.",
     .fallback = "false"},
};

constexpr std::string_view group_manual =
    R"(A group holds shapes, meshes and other groups, written `[[group.sphere]]`, `[[group.mesh]]` and
`[[group.group]]` below it. It moves them together. Each transform of a `batch` is one more instance of the
whole group. Materials belong to the scene, not to the group. The `name` of a group precedes the names inside
it: `cart 2/wheel`.

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

An [[instance]](#instance) places a group once more, by its `name`. With `pattern = true` only instances show
the group, and it does not appear where it is written.

A group that is placed many times is instanced; see `groups` of [render](#render). The instances need no more
memory than one group, and ids and surfaces stay the same. A group that holds a plane, which is infinite, is
copied instead.

A group may stretch and shear its contents, except points: a sphere in it becomes an ellipsoid.)";

constexpr std::string_view instance_manual =
    R"(Places a [[group]] of the scene by its `name`, as if the group were written here. An instance may be in
another group, and a `batch` places many.

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

A group that contains itself, directly or through other groups, is an error.)";

constexpr Key instance_keys[] = {
    name_key,
    {.name = "group",
     .type = KeyType::string,
     .doc = "The `name` of a [[group]] that is not inside another group."},
    {.name = "transform",
     .type = KeyType::transform,
     .doc = "Steps that move the instance, applied in the order written, after those of the group.",
     .fallback = "[]"},
};

constexpr Key group_keys[] = {
    name_key,
    {.name = "pattern",
     .type = KeyType::boolean,
     .doc = "If true, the group appears only where an [[instance]] names it. Only for groups that are not "
            "inside another group.",
     .fallback = "false"},
    {.name = "transform",
     .type = KeyType::transform,
     .doc = "Steps that move the whole group, applied in the order written, after those of its contents.",
     .fallback = "[]"},
};

std::vector<Section> make_sections() {
  using enum Section::Kind;
  std::vector<Section> all = {
      {let, "let", "[let]", "Variables for the numbers of the scene.", {}, nullptr, let_manual()},
      {image, "image", "[image]", "The picture.", image_keys()},
      {camera, "camera", "[camera]", "Position and projection of the view.", camera_keys()},
      {render, "render", "[render]", "How the picture is computed.", render_keys()},
      {environment, "environment", "[environment]",
       "Light from all directions. It replaces the `background` of [render].", environment_keys()},
      {medium, "medium", "[medium]",
       "The medium around the whole scene: fog, haze, water. Only the integrator `path` uses it; the others "
       "ignore it.",
       medium_keys(), nullptr, medium_manual()},
      {verify, "verify", "[verify]", "Settings of the scene for `eyeray verify`.", verify_keys()},
      {animation, "animation", "[animation]", "The moment of an animation to show.", animation_keys()},
      {track, "track", "[[track]]", "A value that is animated by keyframes.", track_keys(), nullptr,
       track_manual},
      {light, "light", "[[light]]", "A light.", light_keys()},
      {material, "material", "[[material]]", "Materials of surfaces.", material_keys()},
      {mesh, "mesh", "[[mesh]]", "The triangles of a mesh file, or the points of a scan.", mesh_keys, nullptr,
       mesh_manual},
  };
  for (const auto types : {shapes::types(), shapes::made_types()}) {
    for (const shapes::ShapeType* type : types) {
      const std::span<const Key> keys = type->combine ? part_keys() : shape_keys;
      all.push_back({shape, type->name, fmt::format("[[{}]]", type->name), "", keys, type});
    }
  }
  all.push_back({group, "group", "[[group]]", "Shapes, meshes and groups that move together.", group_keys,
                 nullptr, group_manual});
  all.push_back({instance, "instance", "[[instance]]", "A group that is placed by its name.", instance_keys,
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
