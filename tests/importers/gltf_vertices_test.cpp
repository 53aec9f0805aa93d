// Tests of the changes that glTF files make to vertices, beside placing them: colours, transforms of uv,
// morph targets, skins.
#include <numbers>

#include "gltf_files.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

TEST_CASE("colours of vertices are linear, with and without alpha, and kept within 0 to 1") {
  for (const auto& [component, one] :
       {std::pair(5121, 255.0), std::pair(5123, 65535.0), std::pair(5126, 1.0)}) {
    for (const bool alpha : {false, true}) {
      const int component_type = component;
      CAPTURE(component_type);
      std::vector<double> colors;
      for (int i = 0; i < 4; ++i) {
        colors.insert(colors.end(), {one * (i % 2), one / 5, component == 5126 ? 7.0 : one});
        if (alpha) colors.push_back(i < 2 ? 0 : one);
      }
      GltfFile file = square_file();
      file.primitive()["attributes"]["COLOR_0"] =
          file.add(colors, component, alpha ? "VEC4" : "VEC3", alpha ? 4 : 3, component != 5126);
      const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
      REQUIRE(scene.meshes[0].colors.size() == 4);
      CHECK(scene.meshes[0].colors[0].x == 0);
      CHECK(scene.meshes[0].colors[1].x == 1);
      CHECK(scene.meshes[0].colors[2].y == doctest::Approx(0.2));
      CHECK(scene.meshes[0].colors[3].z == 1);
      CHECK(scene.meshes[0].alphas == (alpha ? std::vector<double>{0, 0, 1, 1} : std::vector<double>{}));
      CHECK(warns(scene, "colours of vertices below 0 or above 1, clamped: 1") == (component == 5126));
      CHECK(scene.warnings.size() == (component == 5126));
    }
  }
  GltfFile file = square_file();
  file.primitive()["attributes"]["COLOR_0"] = file.add({1, 1, 1}, 5126, "VEC3", 3);
  CHECK(contains(refusal(file.gltf(), "a.gltf"), "do not all have as many elements"));
}

// By the specification, uv are scaled, then rotated counter-clockwise as pictures are seen, then moved.
TEST_CASE("KHR_texture_transform transforms uv, and selects the set that it names") {
  GltfFile file = square_file();
  file.primitive()["attributes"]["TEXCOORD_2"] = file.add({0, 0, 1, 0, 1, 1, 0, 1}, 5126, "VEC2", 2);
  file.primitive()["material"] = 0;
  file.json["materials"] = {{{"pbrMetallicRoughness",
                              {{"baseColorTexture",
                                {{"index", 0},
                                 {"extensions",
                                  {{"KHR_texture_transform",
                                    {{"offset", {0.5, 3}},
                                     {"rotation", std::numbers::pi / 2},
                                     {"scale", {2, 4}},
                                     {"texCoord", 2}}}}}}}}}}};
  file.json["textures"] = Json::array({Json::object()});
  const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  const std::vector<Vec2> expected = {{0.5, 3}, {0.5, 1}, {4.5, 1}, {4.5, 3}};
  for (size_t i = 0; i < 4; ++i) {
    CHECK(scene.meshes[0].uv[i].x == doctest::Approx(expected[i].x));
    CHECK(1 - scene.meshes[0].uv[i].y == doctest::Approx(expected[i].y));
  }
}

TEST_CASE("morph targets use the node's weights before the mesh's") {
  GltfFile file = square_file();
  const std::vector<double> up = {0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2};
  file.primitive()["targets"] = {{{"POSITION", file.add(up, 5126, "VEC3", 3)}}};
  file.json["meshes"][0]["weights"] = {0.5};
  file.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"weights", {0}}}, {{"mesh", 0}}};
  file.json["scenes"] = {{{"nodes", {0, 1, 2}}}};
  const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  REQUIRE(scene.instances.size() == 3);
  const auto height = [&](size_t i) { return scene.meshes[size_t(scene.instances[i].mesh)].positions[0].z; };
  CHECK(height(0) == 1);
  CHECK(height(1) == 0);
  CHECK(scene.instances[0].mesh == scene.instances[2].mesh);
  file.primitive()["targets"][0]["POSITION"] = file.add({0, 0, 1}, 5126, "VEC3", 3);
  CHECK(contains(refusal(file.gltf(), "a.gltf"), "do not all have as many elements"));
}

TEST_CASE("a skin's vertices follow its joints, wherever its node is") {
  // Each of two joints holds two corners, and the second joint stands above the first.
  GltfFile file = square_file();
  const auto skinned = [&](const std::vector<double>& joints, const std::vector<double>& weights) {
    file.primitive()["attributes"]["JOINTS_0"] = file.add(joints, 5121, "VEC4", 4);
    file.primitive()["attributes"]["WEIGHTS_0"] = file.add(weights, 5126, "VEC4", 4);
  };
  const std::vector<double> first_two = {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  skinned(first_two, {1, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0.5, 0, 0, 0});  // the sum counts as 1
  file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"scale", {9, 0, 9}}},
                        {{"translation", {5, 0, 0}}, {"children", {2}}},
                        {{"translation", {0, 3, 0}}}};
  file.json["scenes"] = {{{"nodes", {0, 1}}}};
  const int inverse = file.add(
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1}, 5126,
      "MAT4", 16);
  file.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", inverse}}};
  const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  REQUIRE(scene.instances.size() == 1);
  CHECK(scene.instances[0].transform == Mat4(1.0));
  CHECK(scene.meshes[0].positions == std::vector<Vec3>{{5, 0, 0}, {6, 0, 0}, {6, 3, 0}, {5, 3, 0}});
  CHECK(scene.warnings ==
        std::vector<std::string>{"weights of joints that do not sum to 1, divided by their sum: 1, the first "
                                 "meshes[0].primitives[0].attributes.WEIGHTS_0"});

  // A corner halfway between both joints; then a joint that does not exist; then joints that are not in the
  // scene.
  skinned({0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, {1, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  CHECK(import_sound(file.gltf(), "a.gltf").meshes[0].positions[0] == Vec3(5, 1, 0));
  skinned({0, 2, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, {1, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  CHECK(contains(refusal(file.gltf(), "a.gltf"), "name joint 2, but there are 2"));
  file.json["scenes"] = {{{"nodes", {0}}}};
  file.json["nodes"][0]["scale"] = {1, 1, 1};
  CHECK(warns(import_sound(file.gltf(), "a.gltf"), "left out: skins whose joints are not in the scene (1)"));
}
