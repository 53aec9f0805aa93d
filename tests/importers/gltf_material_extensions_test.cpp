// The extensions of materials in glTF files.
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gltf_files.hpp"
#include "host/scene/image_texture_file.hpp"
#include "host/textures/make.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

TEST_CASE("each material extension reads the right channel of its picture") {
  std::ifstream png("tests/image/pictures/rgba_interlaced.png", std::ios::binary);
  const std::string picture{std::istreambuf_iterator<char>(png), {}};
  const Json map = {{"index", 0}};
  const auto imported = [&](const Json& extensions, const Json& pbr = Json::object()) {
    GltfFile file = with_material({{"pbrMetallicRoughness", pbr}, {"extensions", extensions}});
    file.primitive()["attributes"]["TEXCOORD_0"] = file.add({0, 0, 1, 0, 1, 1, 0, 1}, 5126, "VEC2", 2);
    file.json["textures"] = {{{"source", 0}}};
    file.json["images"] = {{{"uri", "data:image/png;base64," + base64(picture)}}};
    return import_sound(file.gltf(), "a.gltf");
  };
  const auto plain = imported(Json::object(), {{"baseColorTexture", map}});
  const Json dielectric = {{"metallicFactor", 0}, {"roughnessFactor", 0.5}};
  const ImportedScene clear =
      imported({{"KHR_materials_transmission", {{"transmissionFactor", 0.5}, {"transmissionTexture", map}}}},
               dielectric);
  const ImportedScene cloth = imported({{"KHR_materials_sheen",
                                         {{"sheenColorFactor", {0.5, 1, 1}},
                                          {"sheenColorTexture", map},
                                          {"sheenRoughnessFactor", 0.5},
                                          {"sheenRoughnessTexture", map}}},
                                        {"KHR_materials_specular", {{"specularTexture", map}}},
                                        {"KHR_materials_clearcoat",
                                         {{"clearcoatFactor", 1},
                                          {"clearcoatTexture", map},
                                          {"clearcoatRoughnessFactor", 1},
                                          {"clearcoatRoughnessTexture", map}}}});
  CHECK(clear.warnings.empty());
  CHECK(cloth.warnings.empty());
  CHECK(clear.materials[0]->thin());
  image::PixelBudget budget;
  std::vector<std::string> warnings;
  const ImageTexture read =
      decode_image_texture(std::as_bytes(std::span(picture)), "a.png", budget, warnings);
  const auto channel = [&](int i) {
    ImageTexture alone = read;
    alone.srgb = false;
    for (auto& texel : alone.texels) texel = {texel[size_t(i)], texel[size_t(i)], texel[size_t(i)], 255};
    return textures::make_image(std::make_shared<const ImageTexture>(alone));
  };
  for (const Vec2 uv : {Vec2(0.1, 0.1), Vec2(0.4, 0.7), Vec2(0.8, 0.3)}) {
    const ScatteringContext context{uv, 1, 1, 1};
    const auto bsdf_of = [&](const ImportedScene& scene) {
      return scene.materials[0]->bsdf(context, scene.materials[0]->scattering(context));
    };
    CHECK(bsdf_of(clear).thin.x == doctest::Approx(0.5 * channel(0)->at(uv).x));
    const Bsdf over = bsdf_of(cloth);
    CHECK(over.sheen.x == doctest::Approx(0.5 * plain.materials[0]->base_color(uv).x));
    CHECK(over.sheen.z == doctest::Approx(plain.materials[0]->base_color(uv).z));
    CHECK(over.sheen_roughness == doctest::Approx(0.5 * channel(3)->at(uv).x));
    CHECK(over.layer.f90.x == doctest::Approx(channel(3)->at(uv).x));
    CHECK(over.coat == doctest::Approx(channel(0)->at(uv).x));
    CHECK(over.coat_roughness == doctest::Approx(channel(1)->at(uv).x));
  }
  const ImportedScene shade =
      imported({{"KHR_materials_diffuse_transmission",
                 {{"diffuseTransmissionFactor", 0.5},
                  {"diffuseTransmissionTexture", map},
                  {"diffuseTransmissionColorFactor", {1, 0.5, 1}},
                  {"diffuseTransmissionColorTexture", map}}},
                {"KHR_materials_anisotropy",
                 {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 2}, {"anisotropyTexture", map}}},
                {"KHR_materials_iridescence",
                 {{"iridescenceFactor", 0.5},
                  {"iridescenceTexture", map},
                  {"iridescenceIor", 1.8},
                  {"iridescenceThicknessMinimum", 50},
                  {"iridescenceThicknessMaximum", 250},
                  {"iridescenceThicknessTexture", map}}}},
               dielectric);
  CHECK(shade.warnings.empty());
  for (const Vec2 uv : {Vec2(0.1, 0.1), Vec2(0.4, 0.7), Vec2(0.8, 0.3)}) {
    const ScatteringContext context{uv, 1, 1, 1};
    const Bsdf bsdf = shade.materials[0]->bsdf(context, shade.materials[0]->scattering(context));
    const double through = 0.5 * channel(3)->at(uv).x;
    CHECK(bsdf.translucent.y == doctest::Approx(through * 0.5 * plain.materials[0]->base_color(uv).y));
    CHECK(bsdf.diffuse.x == doctest::Approx(1 - through));
    const double strength = 0.5 * channel(2)->at(uv).x;
    CHECK(bsdf.widths.x == doctest::Approx(0.25 + 0.75 * strength * strength));
    CHECK(bsdf.widths.y == 0.25);
    CHECK(bsdf.film.share == doctest::Approx(0.5 * channel(0)->at(uv).x));
    CHECK(bsdf.film.thickness == doctest::Approx(50 + 200 * channel(1)->at(uv).x));
    CHECK(bsdf.film.ior == 1.8);
    REQUIRE(shade.materials[0]->rough_axis);
    CHECK(shade.materials[0]->rough_axis->turn == 2);
    CHECK(shade.materials[0]->rough_axis->texture->at(uv).x == doctest::Approx(channel(0)->at(uv).x));
  }
  // A material with thickness refracts, is tinted and dims light. A material without thickness is a pane,
  // however Whitted's pictures show it.
  const Json volume = {{"thicknessFactor", 1}, {"attenuationDistance", 2}, {"attenuationColor", {1, 0.5, 1}}};
  const ImportedScene thick = imported({{"KHR_materials_transmission", {{"transmissionFactor", 0.25}}},
                                        {"KHR_materials_volume", volume},
                                        {"KHR_materials_ior", {{"ior", 1.33}}}},
                                       dielectric);
  CHECK_FALSE(thick.materials[0]->thin());
  CHECK(thick.materials[0]->medium()->absorption.y == doctest::Approx(std::log(2) / 2));
  const ScatteringContext entering{Vec2(0), 1, 1, 1.33};
  const Bsdf half = thick.materials[0]->bsdf(entering, thick.materials[0]->scattering(entering));
  CHECK(half.glass == Vec3(0.25));
  CHECK(half.layered == 0.75);

  // Dispersion needs an inside, and a film does not colour refracted light.
  const Json spread = {{"dispersion", 0.5}};
  const ImportedScene prism = imported({{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                                        {"KHR_materials_volume", volume},
                                        {"KHR_materials_iridescence", {{"iridescenceFactor", 1}}},
                                        {"KHR_materials_dispersion", spread}},
                                       dielectric);
  CHECK(prism.materials[0]->medium()->dispersion == 0.5);
  CHECK(prism.warnings == std::vector<std::string>{"left out: thin films on glass with an inside (1)"});
  const ImportedScene flat = imported(
      {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}, {"KHR_materials_dispersion", spread}},
      dielectric);
  REQUIRE(flat.warnings.size() == 1);
  CHECK(contains(flat.warnings[0], "dispersion of materials without thickness, left out: 1"));
  const ImportedScene wax =
      imported({{"KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 1}}},
                {"KHR_materials_volume", volume}},
               dielectric);
  CHECK(wax.warnings ==
        std::vector<std::string>{"left out: volumes of materials that transmit light evenly (1)"});
}
