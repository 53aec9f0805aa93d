// Tests of the texture coordinates that the pictures of a glTF material read.
#include <limits>

#include "gltf_files.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

// A square with two sets of uv and a picture.
GltfFile two_uv_file(const Json& material) {
  std::ifstream png("tests/image/pictures/rgb.png", std::ios::binary);
  const std::string picture{std::istreambuf_iterator<char>(png), {}};
  GltfFile file = square_file();
  Json& attributes = file.primitive()["attributes"];
  attributes["NORMAL"] = file.add({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 3);
  attributes["TANGENT"] = file.add({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, 5126, "VEC4", 4);
  attributes["TEXCOORD_0"] = file.add({0, 0, 1, 0, 1, 1, 0, 1}, 5126, "VEC2", 2);
  attributes["TEXCOORD_1"] = file.add({0, 0, 0.5, 0, 0.5, 0.5, 0, 0.5}, 5126, "VEC2", 2);
  file.json["textures"] = {{{"source", 0}}};
  file.json["images"] = {{{"uri", "data:image/png;base64," + base64(picture)}}};
  file.json["materials"] = Json::array({material});  // {material} alone is a copy to Clang
  file.primitive()["material"] = 0;
  return file;
}

Json texture_of_set(int set) {
  return {{"index", 0}, {"texCoord", set}};
}
Json scaled(double scale) {
  Json scaled = texture_of_set(0);
  scaled["extensions"]["KHR_texture_transform"]["scale"] = {scale, scale};
  return scaled;
}

// A material whose base colour's picture reads set 0, and whose emission's picture reads as `emission`
// states.
Json glowing(const Json& emission) {
  return {{"pbrMetallicRoughness", {{"baseColorTexture", texture_of_set(0)}, {"metallicFactor", 0}}},
          {"emissiveFactor", {1, 1, 1}},
          {"emissiveTexture", emission}};
}

}  // namespace

TEST_CASE("a picture may use another set of uv, or another transform of the same set") {
  for (const Json& emission : {texture_of_set(1), scaled(0.5)}) {
    const ImportedScene scene = import_sound(two_uv_file(glowing(emission)).gltf(), "a.gltf");
    CHECK(scene.warnings.empty());
    CHECK(scene.meshes[0].uv == std::vector<Vec2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    CHECK(scene.meshes[0].second_uv == std::vector<Vec2>{{0, 1}, {0.5, 1}, {0.5, 0.5}, {0, 0.5}});
    CHECK_FALSE(scene.meshes[0].second_tangents);
    const Material& material = *scene.materials[0];
    const Vec2 here(0.1, 0.9), there(0.9, 0.1);
    const auto at = [&](const Vec2& first, const Vec2& second) {
      return material.scattering({{first, second, Vec3(0)}, 1, 1, 1});
    };
    CHECK(at(here, there).emitted == at(there, there).emitted);
    CHECK(at(here, there).emitted != at(here, here).emitted);
    CHECK(at(here, there).diffuse == at(here, here).diffuse);
    CHECK(at(here, there).diffuse != at(there, there).diffuse);
  }
  const ImportedScene alone = import_sound(two_uv_file(glowing(texture_of_set(0))).gltf(), "a.gltf");
  CHECK(alone.meshes[0].second_uv.empty());
}

TEST_CASE("any picture may read the second uv, and a third is left out") {
  for (const std::pair<const char*, const char*>& texture :
       {std::pair("/pbrMetallicRoughness/metallicRoughnessTexture", "variations of metalness and roughness"),
        std::pair("/normalTexture", "normal maps"),
        std::pair("/extensions/KHR_materials_clearcoat/clearcoatTexture", "pictures of extensions"),
        std::pair("/extensions/KHR_materials_clearcoat/clearcoatNormalTexture", "normal maps")}) {
    const auto& [pointer, left_out] = texture;
    CAPTURE(texture.first);
    Json material = glowing(texture_of_set(1));
    material["extensions"]["KHR_materials_clearcoat"]["clearcoatFactor"] = 1;
    material[Json::json_pointer(pointer)] = texture_of_set(1);
    CHECK(import_sound(two_uv_file(material).gltf(), "a.gltf").warnings.empty());
    material[Json::json_pointer(pointer)] = scaled(3);
    const ImportedScene third = import_sound(two_uv_file(material).gltf(), "a.gltf");
    CHECK(warns(third, fmt::format("left out: {} with uv of a third kind (1)", left_out)));
    CHECK(third.meshes[0].second_uv.size() == 4);
  }
}

TEST_CASE("tangents follow the uv of the normal map") {
  Json material = glowing(texture_of_set(0));
  material["normalTexture"] = texture_of_set(1);
  GltfFile file = two_uv_file(material);
  const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  CHECK(scene.warnings.empty());
  CHECK(scene.meshes[0].tangents.size() == 4);
  CHECK(scene.meshes[0].second_tangents);
  REQUIRE(scene.materials[0]->normal_map);
  CHECK(scene.materials[0]->normal_map->texture->reads_second_uv());

  file.primitive()["attributes"]["TEXCOORD_1"] =
      file.add({0, 0, 0.5, 0, 0.5, 0.5, std::numeric_limits<double>::infinity(), 0}, 5126, "VEC2", 2);
  CHECK(warns(import_sound(file.gltf(), "a.gltf"), "1 corner whose uv is not finite"));

  file.primitive()["attributes"].erase("TEXCOORD_1");
  const ImportedScene without = import_sound(file.gltf(), "a.gltf");
  CHECK(warns(without, "meshes without the uv that their material's picture needs: 1"));
  CHECK(without.meshes[0].second_uv.empty());
  CHECK(without.meshes[0].tangents.empty());
}
