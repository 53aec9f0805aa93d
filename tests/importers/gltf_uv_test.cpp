// Tests of the texture coordinates that the pictures of a glTF material read.
#include <cmath>
#include <limits>

#include "gltf_files.hpp"
#include "tests/support/random.hpp"

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
Json transformed(const Json& transform) {
  Json texture = texture_of_set(0);
  texture["extensions"]["KHR_texture_transform"] = transform;
  return texture;
}
Json turned(double scale) {
  return transformed({{"scale", {scale, scale}}, {"rotation", M_PI / 2}});
}

// A material whose base colour's picture reads set 0, and whose emission's picture reads as `emission`
// states.
Json glowing(const Json& emission) {
  return {{"pbrMetallicRoughness", {{"baseColorTexture", texture_of_set(0)}, {"metallicFactor", 0}}},
          {"emissiveFactor", {1, 1, 1}},
          {"emissiveTexture", emission}};
}

}  // namespace

TEST_CASE("a picture may use another set of uv, or the same set turned") {
  for (const Json& emission : {texture_of_set(1), turned(0.5)}) {
    const ImportedScene scene = import_sound(two_uv_file(glowing(emission)).gltf(), "a.gltf");
    CHECK(scene.warnings.empty());
    CHECK(scene.meshes[0].uv == std::vector<Vec2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    const bool turns = emission != texture_of_set(1);
    const std::vector<Vec2> expected = turns ? std::vector<Vec2>{{0, 1}, {0, 1.5}, {0.5, 1.5}, {0.5, 1}}
                                             : std::vector<Vec2>{{0, 1}, {0.5, 1}, {0.5, 0.5}, {0, 0.5}};
    REQUIRE(scene.meshes[0].second_uv.size() == 4);
    for (size_t i = 0; i < 4; ++i) CHECK(glm::length(scene.meshes[0].second_uv[i] - expected[i]) < 1e-12);
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

TEST_CASE("pictures that are scaled and shifted against each other share one uv") {
  // The specification's map of uv, with v from the top, for uv with v from the bottom.
  const auto transform = [](const Vec2& uv, const Json& by) {
    const Vec2 scale(by["scale"][0], by["scale"][1]), offset(by["offset"][0], by["offset"][1]);
    const Vec2 from_top = scale * Vec2(uv.x, 1 - uv.y) + offset;
    return Vec2(from_top.x, 1 - from_top.y);
  };
  const auto emitted = [](const ImportedScene& scene, const Vec2& uv) {
    return scene.materials[0]
        ->scattering({.point = {uv, Vec3(0)}, .cos_view = 1, .ior_from = 1, .ior_to = 1})
        .emitted;
  };
  const Json of_base = {{"scale", {3, 0.25}}, {"offset", {-0.4, 0.7}}};
  const Json of_emission = {{"scale", {0.5, 2}}, {"offset", {0.3, 0.1}}};
  Json material = glowing(transformed(of_emission));
  const ImportedScene plain = import_sound(two_uv_file(glowing(texture_of_set(0))).gltf(), "a.gltf");
  for (const bool base_too : {false, true}) {
    if (base_too) material["pbrMetallicRoughness"]["baseColorTexture"] = transformed(of_base);
    const ImportedScene scene = import_sound(two_uv_file(material).gltf(), "a.gltf");
    CHECK(scene.warnings.empty());
    CHECK(scene.meshes[0].second_uv.empty());
    Random random(1);
    for (int i = 0; i < 100; ++i) {
      const Vec2 uv(random.uniform(), random.uniform());
      const Vec2 stored = base_too ? transform(uv, of_base) : uv;
      CHECK(glm::length(emitted(scene, stored) - emitted(plain, transform(uv, of_emission))) < 1e-9);
    }
  }
  // A mirrored picture has a uv of its own: normal maps need the direction of u.
  material = glowing(transformed({{"scale", {-1, 1}}}));
  CHECK(import_sound(two_uv_file(material).gltf(), "a.gltf").meshes[0].second_uv.size() == 4);
}

TEST_CASE("any picture may read the second uv, and a third that is turned is left out") {
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
    material[Json::json_pointer(pointer)] = turned(3);
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
