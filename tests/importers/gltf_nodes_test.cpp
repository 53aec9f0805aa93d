// Nodes that glTF's extensions hide or repeat.
#include "gltf_files.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

// The square at a node with attributes of EXT_mesh_gpu_instancing.
GltfFile instanced_file() {
  GltfFile file = square_file();
  file.json["nodes"][0]["translation"] = {0, 0, 10};
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", file.add({1, 2, 3, 4, 5, 6}, 5126, "VEC3", 3)}};
  return file;
}
Json& attributes_of(GltfFile& file) {
  return file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
}

Vec3 corner(const ImportedScene& scene, size_t instance) {
  return Vec3(scene.instances.at(instance).transform * Vec4(1, 1, 0, 1));
}

}  // namespace

TEST_CASE(
    "KHR_node_visibility hides a node and its descendants, but the node still moves joints and cameras") {
  GltfFile file = square_file();
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  file.json["cameras"] = {
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}}}};
  const Json hidden = {{"KHR_node_visibility", {{"visible", false}}}};
  const Json shown = {{"KHR_node_visibility", {{"visible", true}}}};
  file.json["nodes"] = {{{"mesh", 0}, {"extensions", shown}},
                        {{"mesh", 0}, {"extensions", hidden}, {"children", {2, 3}}},
                        {{"mesh", 0}, {"extensions", shown}, {"camera", 0}},
                        {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
                        {{"mesh", 0}, {"extensions", {{"KHR_node_visibility", Json::object()}}}}};
  file.json["scenes"][0]["nodes"] = {0, 1, 4};
  const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  CHECK(scene.instances.size() == 2);
  CHECK(scene.lights.empty());
  CHECK(scene.cameras.size() == 1);
  CHECK(scene.warnings.empty());
  for (const size_t node : {0u, 4u}) file.json["nodes"][node]["extensions"] = hidden;
  CHECK(contains(refusal(file.gltf(), "a.gltf"), "it has no visible triangles"));
}

TEST_CASE("EXT_mesh_gpu_instancing shows a mesh many times, each transformed before its node") {
  GltfFile file = instanced_file();
  ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  CHECK(scene.warnings.empty());
  CHECK(scene.meshes.size() == 1);
  REQUIRE(scene.instances.size() == 2);
  CHECK(corner(scene, 0) == Vec3(2, 3, 13));
  CHECK(corner(scene, 1) == Vec3(5, 6, 16));

  // The first instance is rotated by a half turn about z, stored in bytes, and twice as big; the second is
  // flat.
  attributes_of(file)["ROTATION"] = file.add({0, 0, 127, 0, 0, 0, 0, 127}, 5120, "VEC4", 4, true);
  attributes_of(file)["SCALE"] = file.add({2, 2, 2, 1, 0, 1}, 5126, "VEC3", 3);
  scene = import_sound(file.gltf(), "a.gltf");
  REQUIRE(scene.instances.size() == 1);
  CHECK(glm::length(corner(scene, 0) - Vec3(-1, 0, 13)) < 1e-9);
  CHECK(warns(scene, "a node whose transforms flatten everything was left out"));
}

TEST_CASE("EXT_mesh_gpu_instancing whose attributes do not fit together is refused") {
  const std::string location = "a.gltf: error: nodes[0].extensions.EXT_mesh_gpu_instancing";
  GltfFile file = instanced_file();
  attributes_of(file)["SCALE"] = file.add({1, 1, 1}, 5126, "VEC3", 3);
  CHECK(refusal(file.gltf(), "a.gltf") == location + ".attributes do not all have as many elements");
  file = instanced_file();
  attributes_of(file)["ROTATION"] = file.add({0, 0, 0, 1, 0, 0, 0, 0}, 5126, "VEC4", 4);
  CHECK(refusal(file.gltf(), "a.gltf") == location + ".attributes has a rotation of length 0");
  file = instanced_file();
  attributes_of(file) = Json::object();
  CHECK(refusal(file.gltf(), "a.gltf") ==
        location + ".attributes have none of TRANSLATION, ROTATION and SCALE");
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = Json::object();
  CHECK(refusal(file.gltf(), "a.gltf") == location + " has no attributes");
}
