// Every entry of the registries has a scene.
#include <set>

#include "host/cameras/registry.hpp"
#include "host/lights/registry.hpp"
#include "host/loader/scene_file.hpp"
#include "host/loader/suite.hpp"
#include "host/materials/registry.hpp"
#include "host/pack/pack.hpp"
#include "host/scene/texture_rows.hpp"
#include "host/shapes/registry.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::records;

namespace {

// The kinds of a scene's shapes, of the materials on them, and of the materials' textures.
struct Kinds {
  std::set<uint32_t> shapes;
  std::set<uint32_t> materials;
  std::set<uint32_t> textures;
};

Kinds kinds_of(const Scene& scene) {
  const PackedScene packed = pack::pack(scene);
  Kinds kinds;
  for (const auto& [shape, material] : packed.uses) {
    kinds.shapes.insert(shape);
    kinds.materials.insert(packed.materials[material].kind);
  }
  for (const shader::Texture& texture : packed.textures) kinds.textures.insert(texture.kind);
  return kinds;
}

}  // namespace

TEST_CASE("every shape of the registry occurs in a scene of its name") {
  for (uint32_t kind = 0; kind < shapes::types().size(); ++kind) {
    const std::string file = "scenes/shapes/" + std::string(shapes::types()[kind]->name) + ".toml";
    CAPTURE(file);
    REQUIRE(std::filesystem::exists(file));
    // The manual shows this picture, made by scripts/pictures.
    CHECK(std::filesystem::exists("docs/images/shapes/" + std::string(shapes::types()[kind]->name) + ".png"));
    CHECK(kinds_of(load_scene(file)).shapes.contains(kind));
  }
}

TEST_CASE(
    "some scene has each texture, light and camera type, and each material on a shape; one scene warns") {
  Kinds used;
  std::set<std::string_view> lights;
  std::set<uint32_t> cameras;
  for (const std::filesystem::path& file : scenes_below("scenes")) {
    CAPTURE(file);
    const Scene scene = load_scene(file);
    // In that scene glass stands before lights without a size.
    CHECK(scene.warnings.empty() == (file != "scenes/path/lamps.toml"));
    Kinds kinds = kinds_of(scene);
    used.materials.merge(kinds.materials);
    used.textures.merge(kinds.textures);
    for (const auto& light : scene.lights) lights.insert(light->type);
    cameras.insert(scene.camera.projection->kind());
  }
  for (uint32_t kind = 0; kind < materials::types().size(); ++kind) {
    CAPTURE(materials::types()[kind]->name);
    CHECK(used.materials.contains(kind));
  }
  for (const TextureRow& row : texture_rows) CHECK_MESSAGE(used.textures.contains(row.number), row.name);
  for (const lights::LightType* type : lights::types())
    CHECK_MESSAGE(lights.contains(type->name), type->name);
  CHECK(cameras.size() == cameras::types().size());
}
