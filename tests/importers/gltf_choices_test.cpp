// The parts of a glTF file of which one is shown: scenes, variants of materials, cameras.
#include "gltf_files.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

// A triangle that two scenes show, at x = 0 and at x = 5.
GltfFile two_scenes() {
  GltfFile file;
  file.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  file.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}};
  file.json["scenes"] = {{{"nodes", {0}}}, {{"name", "far"}, {"nodes", {1}}}};
  return file;
}

double x_of(const ImportedScene& scene) {
  REQUIRE(scene.instances.size() == 1);
  return scene.instances[0].transform[3].x;
}

}  // namespace

TEST_CASE("a scene of a glTF file is chosen by its name or number") {
  GltfFile file = two_scenes();
  const auto shown = [&](const ImportOptions& options) {
    return import_sound(file.gltf(), "a.gltf", options);
  };
  CHECK(x_of(shown({})) == 0);
  CHECK(x_of(shown({.gltf_scene = "0"})) == 0);
  CHECK(x_of(shown({.gltf_scene = "1"})) == 5);
  CHECK(x_of(shown({.gltf_scene = "far"})) == 5);
  CHECK(shown({.gltf_scene = "far"}).warnings.empty());
  CHECK(shown({}).scenes == std::vector<std::string>{"", "far"});
  file.json.erase("scene");
  CHECK(warns(shown({}),
              "it has no default scene: the first of 2 is shown; `gltf_scene` or --gltf-scene shows "
              "another: 0, \"far\""));
  CHECK(x_of(shown({.gltf_scene = "far"})) == 5);
  CHECK(shown({.gltf_scene = "far"}).warnings.empty());
}

TEST_CASE("KHR_materials_variants: a variant chooses the materials of primitives") {
  GltfFile file = two_scenes();
  for (const double red : {0.25, 0.5, 1.0})
    file.json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorFactor", {red, 0, 0, 1}}}}});
  file.json["extensions"]["KHR_materials_variants"]["variants"] = {
      {{"name", "dull"}}, {{"name", "bright"}}, {{"name", "unused"}}};
  file.primitive()["material"] = 0;
  file.primitive()["extensions"]["KHR_materials_variants"]["mappings"] = {
      {{"material", 1}, {"variants", {0}}}, {{"material", 2}, {"variants", {1}}}};
  const auto material = [&](const std::optional<std::string>& variant) {
    const ImportedScene scene = import_sound(file.gltf(), "a.gltf", {.variant = variant});
    CHECK(scene.warnings == std::vector<std::string>{});
    CHECK(scene.variants == std::vector<std::string>{"dull", "bright", "unused"});
    return scene.instances.at(0).material;
  };
  CHECK(material({}) == 0);
  CHECK(material("dull") == 1);
  CHECK(material("bright") == 2);
  CHECK(material("1") == 2);
  CHECK(material("unused") == 0);

  file.primitive()["extensions"]["KHR_materials_variants"]["mappings"][0].erase("material");
  CHECK(contains(refusal(file.gltf(), "a.gltf", {.variant = "dull"}),
                 "meshes[0].primitives[0].extensions.KHR_materials_variants.mappings[0] has no material"));
  CHECK(warns(import_sound(file.gltf(), "a.gltf"), "properties that glTF requires and the file lacks: 1"));
}

TEST_CASE("a camera that is faulty is an error only where it is shown") {
  GltfFile file = two_scenes();
  file.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}},
      {{"type", "perspective"}, {"name", "wide"}, {"perspective", {{"yfov", 4}, {"znear", 1}}}}};
  file.json["nodes"] = {{{"mesh", 0}, {"children", {1, 2}}}, {{"camera", 0}}, {{"camera", 1}}};
  file.json["scenes"] = {{{"nodes", {0}}}};
  const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  REQUIRE(scene.cameras.size() == 2);
  CHECK(!scene.cameras[0].fault);
  CHECK(scene.cameras[1].name == "wide");
  REQUIRE(scene.cameras[1].fault);
  CHECK(scene.cameras[1].fault->message == "cameras[1].perspective has a yfov that is out of range");
  CHECK(warns(scene, "cameras that are faulty, so they cannot be shown: 1, the first cameras[1]"));
}
