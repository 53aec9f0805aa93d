// Reads the extensions of metallic-roughness materials, and their pictures.
#include <algorithm>
#include <cmath>

#include "host/importers/gltf_materials.hpp"
#include "host/materials/make.hpp"

namespace eyeray::engine::importers {

namespace {

// The pictures of extensions, in the order in which textures_of() lists them.
constexpr std::pair<const char*, const char*> extension_maps[] = {
    {"KHR_materials_transmission", "transmissionTexture"},
    {"KHR_materials_specular", "specularTexture"},
    {"KHR_materials_specular", "specularColorTexture"},
    {"KHR_materials_clearcoat", "clearcoatTexture"},
    {"KHR_materials_clearcoat", "clearcoatRoughnessTexture"},
    {"KHR_materials_clearcoat", "clearcoatNormalTexture"},
    {"KHR_materials_sheen", "sheenColorTexture"},
    {"KHR_materials_sheen", "sheenRoughnessTexture"},
};

}  // namespace

TexturePtr GltfMaterials::scaled(const GltfObject& material, const GltfObject& extension, const char* map,
                                 const Vec3& factor, Content content) {
  const TexturePtr constant = textures::make_constant(factor);
  const auto reference = extension.object(map);
  if (!reference || factor == Vec3(0)) return constant;
  const auto second = takes_second(material, *reference, "pictures of extensions");
  if (!second) return constant;
  const auto image = texture(*reference, content);
  return image ? textures::make_image(image, factor, Vec2(1), *second) : constant;
}

void GltfMaterials::add_extension_textures(const GltfObject& material, std::vector<GltfObject>& textures) {
  for (const auto& [name, map] : extension_maps)
    if (const auto extension = material.extension(name))
      if (const auto reference = extension->object(map)) textures.push_back(*reference);
}

// The index of refraction; 0 stands for infinity, for a surface that mirrors all light.
double GltfMaterials::ior(const GltfObject& material) {
  const auto extension = material.extension("KHR_materials_ior");
  const double written = extension ? extension->number("ior", 1.5) : 1.5;
  const double ior = written == 0 ? 0 : std::clamp(written, 1.0, 4.0);
  if (ior != written)
    breaches_.add("indices of refraction below 1 or above 4, clamped", extension->location() + ".ior");
  return ior;
}

std::unique_ptr<Material> GltfMaterials::glass(const GltfObject& material, const Surface& surface) {
  materials::DielectricValues glass;
  glass.roughness = surface.roughness_texture();
  glass.ior = std::max(1.0, ior(material));
  glass.absorption = absorption(material);
  return materials::make_dielectric(glass);
}

// The absorption of KHR_materials_volume, by Beer's law, from the colour of light that has crossed a
// distance.
Vec3 GltfMaterials::absorption(const GltfObject& material) {
  const auto volume = material.extension("KHR_materials_volume");
  if (!volume) return Vec3(0);
  const double distance = volume->number("attenuationDistance", 0);
  if (volume->has("attenuationDistance") && !(distance > 0))
    breaches_.add("attenuation distances that are not above 0, left out", volume->location());
  const std::vector<double> color = factors(*volume, "attenuationColor", {1, 1, 1});
  if (!(distance > 1e-12)) return Vec3(0);
  return -glm::log(glm::max(Vec3(color[0], color[1], color[2]), Vec3(1e-6))) / distance;
}

// `stand_in` is glass if the surface transmits most of its light.
std::unique_ptr<Material> GltfMaterials::principled(const GltfObject& source, const Surface& surface,
                                                    std::unique_ptr<Material> stand_in) {
  materials::PrincipledValues values;
  values.color = textured(surface.base, surface.image);
  values.metallic = surface.metalness_texture();
  values.roughness = surface.roughness_texture();
  values.emission = surface.emission;
  values.ior = ior(source);
  if (const auto specular = source.extension("KHR_materials_specular")) {
    const std::vector<double> color = specular->numbers("specularColorFactor", {1, 1, 1});
    const Vec3 tint = glm::max(Vec3(color[0], color[1], color[2]), Vec3(0));
    if (tint != Vec3(color[0], color[1], color[2]))
      breaches_.add("values of materials below 0, set to 0", specular->location() + ".specularColorFactor");
    values.specular = scaled(source, *specular, "specularTexture",
                             Vec3(factor(*specular, "specularFactor", 1)), Content::alpha);
    values.specular_color = scaled(source, *specular, "specularColorTexture", tint, Content::color);
  }
  if (const auto transmission = source.extension("KHR_materials_transmission")) {
    values.transmission = scaled(source, *transmission, "transmissionTexture",
                                 Vec3(factor(*transmission, "transmissionFactor", 0)));
    // A surface without thickness has no inside. Paths measure the thickness themselves.
    const auto volume = source.extension("KHR_materials_volume");
    values.thin = !(volume && not_negative(*volume, "thicknessFactor", 0) > 0);
    values.absorption = absorption(source);
  }
  if (const auto sheen = source.extension("KHR_materials_sheen")) {
    const std::vector<double> color = factors(*sheen, "sheenColorFactor", {0, 0, 0});
    values.sheen =
        scaled(source, *sheen, "sheenColorTexture", Vec3(color[0], color[1], color[2]), Content::color);
    values.sheen_roughness = scaled(source, *sheen, "sheenRoughnessTexture",
                                    Vec3(factor(*sheen, "sheenRoughnessFactor", 0)), Content::alpha);
  }
  if (const auto coat = source.extension("KHR_materials_clearcoat")) {
    values.coat = scaled(source, *coat, "clearcoatTexture", Vec3(factor(*coat, "clearcoatFactor", 0)));
    values.coat_roughness = scaled(source, *coat, "clearcoatRoughnessTexture",
                                   Vec3(factor(*coat, "clearcoatRoughnessFactor", 0)));
  }
  return materials::make_principled(values, std::move(stand_in));
}

}  // namespace eyeray::engine::importers
