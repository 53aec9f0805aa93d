// The materials and textures of glTF files, and the parts that are left out.
#include "gltf_files.hpp"
#include "host/image/coded_image.hpp"
#include "host/scene/image_texture_file.hpp"
#include "host/textures/make.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

Scattering scattering_of(const Json& material) {
  const ImportedScene scene = import_sound(with_material(material).gltf(), "a.gltf");
  REQUIRE(scene.instances[0].material == 0);
  return scene.materials[0]->scattering({Vec2(0.25, 0.75), 1, 1, 1});
}

Json surface(const Json& color, double metallic, double roughness) {
  return {{"pbrMetallicRoughness",
           {{"baseColorFactor", color}, {"metallicFactor", metallic}, {"roughnessFactor", roughness}}}};
}

}  // namespace

TEST_CASE("metallic-roughness becomes the nearest supported material") {
  const Scattering plastic = scattering_of(surface({1, 0.5, 0, 1}, 0, 0.5));
  CHECK(plastic.diffuse == Vec3(1, 0.5, 0));
  CHECK(plastic.reflected == Vec3(0));
  CHECK(plastic.specular.x == doctest::Approx(0.04 * 32 / 8));
  CHECK(plastic.shininess == doctest::Approx(30));
  CHECK(plastic.blinn);
  const Scattering chrome = scattering_of(surface({1, 0.5, 0, 1}, 1, 0));
  CHECK(chrome.reflected == Vec3(1, 0.5, 0));
  CHECK(chrome.diffuse == Vec3(0));
  const Scattering rough_metal = scattering_of(surface({1, 0.5, 0, 1}, 1, 1));
  CHECK(rough_metal.reflected == Vec3(0));
  CHECK(rough_metal.diffuse == Vec3(1, 0.5, 0));
  CHECK(scattering_of(Json::object()).diffuse == Vec3(1));

  const ImportedScene glass = import_sound(
      with_material(
          {{"name", "glass"},
           {"extensions",
            {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
             {"KHR_materials_ior", {{"ior", 1.33}}},
             {"KHR_materials_volume", {{"attenuationDistance", 2}, {"attenuationColor", {1, 0.5, 1}}}}}}})
          .gltf(),
      "a.gltf");
  CHECK(glass.materials[0]->name == "glass");
  REQUIRE(glass.materials[0]->medium());
  CHECK(glass.materials[0]->medium()->ior == 1.33);
  CHECK(glass.materials[0]->medium()->absorption.y == doctest::Approx(std::log(2) / 2));
}

TEST_CASE("metallic-roughness becomes a BSDF, with its coat, its index and its map") {
  const auto bsdf_of = [](const GltfFile& file, const Vec2& uv) {
    const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
    const ScatteringContext context{uv, 1, 1, 1};
    return scene.materials[0]->bsdf(context, scene.materials[0]->scattering(context));
  };
  Json car = surface({0.5, 0.25, 0, 1}, 0.5, 0.4);
  car["extensions"] = {
      {"KHR_materials_clearcoat", {{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.1}}},
      {"KHR_materials_ior", {{"ior", 2}}},
      {"KHR_materials_specular", {{"specularFactor", 0.5}}}};
  const Bsdf painted = bsdf_of(with_material(car), Vec2(0));
  CHECK(painted.diffuse == Vec3(0.25, 0.125, 0));
  CHECK(painted.layer.f0.x == doctest::Approx(0.5 / 9));
  CHECK(painted.layer.f90.x == 0.5);
  CHECK(painted.layered == 0.5);
  CHECK(painted.metal.f0.x == 0.5);
  CHECK(painted.metallic == 0.5);
  CHECK(painted.roughness == 0.4);
  CHECK(painted.coat == 0.75);
  CHECK(painted.coat_roughness == 0.1);

  // In a map, green is roughness and blue is metalness; red has no meaning.
  std::ifstream png("tests/image/pictures/rgb.png", std::ios::binary);
  const std::string picture{std::istreambuf_iterator<char>(png), {}};
  GltfFile mapped = with_material({{"pbrMetallicRoughness",
                                    {{"baseColorFactor", {1, 1, 1, 1}},
                                     {"roughnessFactor", 0.5},
                                     {"metallicRoughnessTexture", {{"index", 0}}}}}});
  mapped.primitive()["attributes"]["TEXCOORD_0"] = mapped.add({0, 0, 1, 0, 1, 1, 0, 1}, 5126, "VEC2", 2);
  mapped.json["textures"] = {{{"source", 0}}};
  mapped.json["images"] = {{{"uri", "data:image/png;base64," + base64(picture)}}};
  const ImportedScene scene = import_sound(mapped.gltf(), "a.gltf");
  CHECK(scene.warnings.empty());
  double least = 1, most = 0, metal = 0;
  for (double u = 0.05; u < 1; u += 0.1)
    for (double v = 0.05; v < 1; v += 0.1) {
      const Bsdf bsdf = bsdf_of(mapped, Vec2(u, v));
      least = std::min(least, bsdf.roughness);
      most = std::max(most, bsdf.roughness);
      metal = std::max(metal, 1 - bsdf.diffuse.x);
    }
  CHECK(least < 0.25);
  CHECK(most > 0.25);
  CHECK(most <= 0.5);
  CHECK(metal > 0.25);
}

TEST_CASE("pictures come from data and files, with their samplers") {
  std::ifstream png("tests/image/pictures/rgb.png", std::ios::binary);
  const std::string picture{std::istreambuf_iterator<char>(png), {}};
  GltfFile file =
      with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}});
  file.primitive()["attributes"]["TEXCOORD_0"] = file.add({0, 0, 0, 0, 0, 0, 0, 0}, 5126, "VEC2", 2);
  file.primitive()["attributes"]["TEXCOORD_1"] =
      file.add({0, 255, 255, 255, 255, 0, 0, 0}, 5121, "VEC2", 2, true);
  file.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  file.json["samplers"] = {{{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}}};
  file.json["images"] = {{{"uri", "data:image/png;base64," + base64(picture)}}};
  const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  CHECK(scene.warnings.empty());
  CHECK(scene.meshes[0].uv == std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}});  // the second set

  // If the picture cannot be read, the material keeps its colour.
  for (const std::string& uri : {std::string("data:image/png;base64,AAAA"), std::string("none.png")}) {
    file.json["images"] = {{{"uri", uri}}};
    const ImportedScene without = import_sound(file.gltf(), "a.gltf");
    CHECK(warns(without, "a picture was left out: "));
    CHECK(without.materials[0]->base_color(Vec2{0, 0}) == Vec3(1));
  }
  file.json["textures"] = {{{"extensions", Json::object()}}};
  CHECK(warns(import_sound(file.gltf(), "a.gltf"), "textures without a picture (1)"));
}

TEST_CASE("a normal map uses its raw codes, and the mesh's tangents if they are sound") {
  std::ifstream png("tests/image/pictures/rgb.png", std::ios::binary);
  const std::string picture{std::istreambuf_iterator<char>(png), {}};
  GltfFile file = with_material({{"normalTexture", {{"index", 0}, {"scale", -0.5}}}});
  file.json["textures"] = {{{"source", 0}}};
  file.json["images"] = {{{"uri", "data:image/png;base64," + base64(picture)}}};
  Json& attributes = file.primitive()["attributes"];
  attributes["TEXCOORD_0"] = file.add({0, 0, 1, 0, 1, 1, 0, 1}, 5126, "VEC2", 2);
  attributes["NORMAL"] = file.add({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 3);
  attributes["TANGENT"] = file.add({2, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1}, 5126, "VEC4", 4);
  const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  CHECK(scene.warnings ==
        std::vector<std::string>{"tangents that are not of unit length, normalised: 1, the first "
                                 "meshes[0].primitives[0].attributes.TANGENT"});
  REQUIRE(scene.materials[0]->normal_map);
  CHECK(scene.materials[0]->normal_map->scale == -0.5);
  CHECK(scene.meshes[0].tangents[0] == Vec4(1, 0, 0, -1));
  CHECK(scene.meshes[0].uv[0] == Vec2(0, 1));

  attributes["TANGENT"] = file.add({0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, 5126, "VEC4", 4);
  const ImportedScene unsound = import_sound(file.gltf(), "a.gltf");
  CHECK(warns(unsound,
              "meshes with tangents that are not directions; their tangents are computed from uv instead"));
  CHECK(unsound.meshes[0].tangents.empty());

  // A coat has a separate normal map, or none.
  file.primitive()["attributes"].erase("TANGENT");
  Json& material = file.json["materials"][0];
  file.json["extensionsUsed"] = {"KHR_materials_clearcoat"};
  material["extensions"] = {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}};
  CHECK_FALSE(import_sound(file.gltf(), "a.gltf").materials[0]->coat_normal_map);
  material["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"] = {{"index", 0},
                                                                                 {"scale", 0.25}};
  const ImportedScene coated = import_sound(file.gltf(), "a.gltf");
  CHECK(coated.warnings.empty());
  REQUIRE(coated.materials[0]->coat_normal_map);
  CHECK(coated.materials[0]->coat_normal_map->scale == 0.25);
}

TEST_CASE("alphaMode MASK cuts out by factor, picture and vertices, BLEND blends by them") {
  Json material = {{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.6}}}}};
  const auto mask_of = [&] {
    return import_sound(with_material(material).gltf(), "a.gltf").materials[0]->mask;
  };
  CHECK_FALSE(mask_of());
  material["alphaMode"] = "MASK";
  REQUIRE(mask_of());
  CHECK(mask_of()->cutoff == 0.5);
  CHECK(mask_of()->covers({0, 0}));
  CHECK_FALSE(mask_of()->covers({0, 0}, 0.8));
  material["alphaCutoff"] = 0.7;
  CHECK_FALSE(mask_of()->covers({0, 0}));
  material["alphaCutoff"] = 0;
  CHECK_FALSE(mask_of());
  material["alphaCutoff"] = 0.6;
  material["extensions"] = {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}};
  const ImportedScene glass = import_sound(with_material(material).gltf(), "a.gltf");
  CHECK_FALSE(glass.materials[0]->mask);
  REQUIRE(glass.warnings.size() == 1);
  CHECK(contains(glass.warnings[0], "cutouts in glass (1)"));

  material.erase("extensions");
  material["alphaMode"] = "BLEND";
  REQUIRE(mask_of());
  CHECK(mask_of()->blends);
  CHECK(mask_of()->alpha->alpha_at(Vec2(0)) == 0.6);
  // A ray hits the surface with a probability of 0.6, or of half of that where its vertices' alpha is 0.5.
  CHECK(mask_of()->covers(Vec2(0), 1, 0.6));
  CHECK_FALSE(mask_of()->covers(Vec2(0), 0.5, 0.6));
  CHECK(mask_of()->covers(Vec2(0), 0.5, 0.3));
}

TEST_CASE("a single-sided material is visible and emits only in front; glass has both sides") {
  const auto material_of = [](const Json& json) {
    return std::move(import_sound(with_material(json).gltf(), "a.gltf").materials[0]);
  };
  CHECK(material_of(Json::object())->front_only);
  CHECK_FALSE(material_of(Json::object())->emits_in_front);
  CHECK(material_of({{"emissiveFactor", {1, 1, 1}}})->emits_in_front);
  CHECK_FALSE(material_of({{"doubleSided", true}})->front_only);
  CHECK_FALSE(material_of({{"doubleSided", true}, {"emissiveFactor", {1, 1, 1}}})->emits_in_front);
  const ImportedScene plain = import_sound(square_file().gltf(), "a.gltf");
  REQUIRE(plain.materials.size() == 1);
  CHECK(plain.instances[0].material == 0);
  CHECK(plain.materials[0]->front_only);
  for (const double share : {0.25, 1.0}) {
    Json glass = {{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", share}}}}}};
    CHECK_FALSE(material_of(glass)->front_only);
    glass["extensions"]["KHR_materials_volume"]["thicknessFactor"] = 1;
    CHECK_FALSE(material_of(glass)->front_only);
  }
}

TEST_CASE("omitted parts are named once, with their count") {
  GltfFile file = with_material({{"occlusionTexture", {{"index", 0}}}});
  file.json["textures"].push_back(Json::object());
  file.json["materials"].push_back(file.json["materials"][0]);
  file.json["extensionsUsed"] = {"KHR_materials_volume_scatter", "KHR_materials_ior"};
  Json lines = file.primitive();
  lines["mode"] = 1;
  file.json["meshes"][0]["primitives"].push_back(lines);
  const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  CHECK(scene.warnings == std::vector<std::string>{
                              "left out: the extension KHR_materials_volume_scatter (1), occlusion maps (2), "
                              "lines, which `line_width` or --line-width shows (1)"});
}

TEST_CASE("EXT_texture_webp: the WebP counts more than the picture for other readers") {
  const auto uri = [](const std::string& name, const std::string& type) {
    std::ifstream picture("tests/image/pictures/" + name, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(picture), {}};
    return Json{{"uri", "data:" + type + ";base64," + base64(bytes)}};
  };
  GltfFile file = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  file.primitive()["attributes"]["TEXCOORD_0"] = file.add({0, 0, 1, 0, 1, 1, 0, 1}, 5126, "VEC2", 2);
  file.json["images"] = {uri("grey.png", "image/png"), uri("rgb.webp", "image/webp")};
  file.json["textures"] = {{{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}}};
  const auto red = [&] {
    const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
    CHECK(scene.warnings.empty());
    const ScatteringContext context{Vec2(0.17, 0.75), 1, 1, 1};
    return scene.materials[0]->scattering(context).ambient;
  };
  CHECK(red().x > 4 * red().y);
  file.json["textures"][0].erase("source");
  CHECK(red().x > 4 * red().y);
  file.json["textures"][0] = {{"source", 0}};
  CHECK(red().x == red().y);
}

TEST_CASE("textures in KTX2 leave the material's colour") {
  GltfFile file = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  file.json["images"] = {{{"uri", "data:image/ktx2;base64,AAAA"}}};
  file.json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
  CHECK(warns(import_sound(file.gltf(), "a.gltf"),
              "textures in KTX2 (KHR_texture_basisu), which other programs"));
}

TEST_CASE("emission has factor, strength and picture; an unlit material emits its base colour") {
  CHECK(scattering_of({{"emissiveFactor", {0.5, 0, 1}}}).emitted == Vec3(0.5, 0, 1));
  const Json strong = {{"KHR_materials_emissive_strength", {{"emissiveStrength", 3}}}};
  CHECK(scattering_of({{"emissiveFactor", {0.5, 0, 1}}, {"extensions", strong}}).emitted == Vec3(1.5, 0, 3));
  Json flat = surface({0.25, 0.5, 1, 1}, 0, 0.5);
  flat["extensions"]["KHR_materials_unlit"] = Json::object();
  const Scattering unlit = scattering_of(flat);
  CHECK(unlit.emitted == Vec3(0.25, 0.5, 1));
  CHECK(unlit.diffuse == Vec3(0));
  CHECK(unlit.ambient == Vec3(0));
  CHECK(unlit.specular == Vec3(0));

  // Emission has its own picture, whichever uv it reads.
  std::ifstream png("tests/image/pictures/rgb.png", std::ios::binary);
  const std::string picture{std::istreambuf_iterator<char>(png), {}};
  GltfFile file =
      with_material({{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}, {"texCoord", 1}}}});
  file.json["textures"] = {{{"source", 0}}};
  file.json["images"] = {{{"uri", "data:image/png;base64," + base64(picture)}}};
  file.primitive()["attributes"]["TEXCOORD_0"] = file.add(std::vector<double>(8, 0), 5126, "VEC2", 2);
  file.primitive()["attributes"]["TEXCOORD_1"] = file.add({0, 0, 1, 0, 1, 1, 0, 1}, 5126, "VEC2", 2);
  const ImportedScene alone = import_sound(file.gltf(), "a.gltf");
  CHECK(alone.warnings.empty());
  CHECK(alone.meshes[0].uv.size() == 4);
  CHECK(alone.materials[0]->scattering({Vec2(0.1, 0.9), 1, 1, 1}).emitted !=
        alone.materials[0]->scattering({Vec2(0.9, 0.1), 1, 1, 1}).emitted);
}

TEST_CASE("specular-glossiness gives its diffuse part") {
  const Scattering old =
      scattering_of({{"extensions",
                      {{"KHR_materials_pbrSpecularGlossiness",
                        {{"diffuseFactor", {0.5, 0.25, 1, 1}}, {"glossinessFactor", 0}}}}}});
  CHECK(old.diffuse == Vec3(0.5, 0.25, 1));
  CHECK(old.reflected == Vec3(0));
}
