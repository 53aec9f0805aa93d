// Reads the extensions of metallic-roughness materials, and their pictures.
#include <fmt/format.h>

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
    {"KHR_materials_diffuse_transmission", "diffuseTransmissionTexture"},
    {"KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture"},
    {"KHR_materials_anisotropy", "anisotropyTexture"},
    {"KHR_materials_iridescence", "iridescenceTexture"},
    {"KHR_materials_iridescence", "iridescenceThicknessTexture"},
};

}  // namespace

TexturePtr GltfMaterials::scaled(const GltfObject& material, const GltfObject& extension, const char* map,
                                 const Vec3& factor, Content content) {
  const TexturePtr constant = textures::make_constant(factor);
  const auto reference = extension.object(map);
  if (!reference || factor == Vec3(0)) return constant;
  const auto at = position(material, *reference, "pictures of extensions");
  if (!at) return constant;
  const auto image = texture(*reference, content);
  return image ? textures::make_image(image, factor, *at) : constant;
}

void GltfMaterials::add_extension_textures(const GltfObject& material, std::vector<GltfObject>& textures) {
  for (const auto& [name, map] : extension_maps)
    if (const auto extension = material.extension(name))
      if (const auto reference = extension->object(map)) textures.push_back(*reference);
}

// The index of refraction; 0 stands for infinity, for a surface that mirrors all light.
double GltfMaterials::ior(const GltfObject& material) {
  const auto extension = material.extension("KHR_materials_ior");
  return !extension ? 1.5 : extension->number("ior", 1.5) == 0 ? 0 : index_of(*extension, "ior", 1.5);
}

double GltfMaterials::index_of(const GltfObject& owner, const char* key, double fallback) {
  const double written = owner.number(key, fallback), ior = std::clamp(written, 1.0, 4.0);
  if (ior != written)
    breaches_.add("indices of refraction below 1 or above 4, clamped",
                  fmt::format("{}.{}", owner.location(), key));
  return ior;
}

std::unique_ptr<Material> GltfMaterials::glass(const GltfObject& material, const Surface& surface) {
  materials::DielectricValues glass;
  glass.roughness = surface.roughness_texture();
  glass.ior = std::max(1.0, ior(material));
  glass.absorption = absorption(material);
  glass.dispersion = dispersion(material);
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

// 20 / Abbe number, of a material with an inside.
double GltfMaterials::dispersion(const GltfObject& material) {
  const auto extension = material.extension("KHR_materials_dispersion");
  if (!extension) return 0;
  const double written = extension->number("dispersion", 0), value = std::clamp(written, 0.0, 10.0);
  if (value != written)
    breaches_.add("dispersions below 0 or above 10, clamped", extension->location() + ".dispersion");
  return value;
}

// The direction along which the surface is rougher, and how much rougher it is there.
std::optional<RoughAxis> GltfMaterials::anisotropy(const GltfObject& material,
                                                   materials::PrincipledValues& values) {
  const auto extension = material.extension("KHR_materials_anisotropy");
  if (!extension) return std::nullopt;
  const double strength = factor(*extension, "anisotropyStrength", 0);
  if (strength == 0) return std::nullopt;
  values.anisotropy = scaled(material, *extension, "anisotropyTexture", Vec3(strength));
  RoughAxis axis{.turn = extension->number("anisotropyRotation", 0)};
  // Blue is the strength, red and green are the direction.
  if (!values.anisotropy->constant())
    axis.texture = scaled(material, *extension, "anisotropyTexture", Vec3(1));
  return axis;
}

void GltfMaterials::iridescence(const GltfObject& material, materials::PrincipledValues& values) {
  const auto extension = material.extension("KHR_materials_iridescence");
  if (!extension) return;
  values.iridescence =
      scaled(material, *extension, "iridescenceTexture", Vec3(factor(*extension, "iridescenceFactor", 0)));
  values.iridescence_ior = index_of(*extension, "iridescenceIor", 1.3);
  values.iridescence_least = not_negative(*extension, "iridescenceThicknessMinimum", 100);
  values.iridescence_most = not_negative(*extension, "iridescenceThicknessMaximum", 400);
  values.iridescence_thickness = scaled(material, *extension, "iridescenceThicknessTexture", Vec3(1));
}

void GltfMaterials::diffuse_transmission(const GltfObject& material, materials::PrincipledValues& values) {
  const auto extension = material.extension("KHR_materials_diffuse_transmission");
  if (!extension) return;
  const std::vector<double> color = factors(*extension, "diffuseTransmissionColorFactor", {1, 1, 1});
  values.diffuse_transmission =
      scaled(material, *extension, "diffuseTransmissionTexture",
             Vec3(factor(*extension, "diffuseTransmissionFactor", 0)), Content::alpha);
  values.diffuse_transmission_color = scaled(material, *extension, "diffuseTransmissionColorTexture",
                                             Vec3(color[0], color[1], color[2]), Content::color);
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
    if (!values.thin) values.dispersion = dispersion(source);
  }
  if (source.extension("KHR_materials_dispersion") && values.dispersion == 0 && dispersion(source) > 0)
    breaches_.add("dispersion of materials without thickness, left out", source.location());
  diffuse_transmission(source, values);
  iridescence(source, values);
  const bool glass = !values.thin && values.transmission->constant() != Vec3(0);
  if (glass && values.iridescence->constant() != Vec3(0)) left_out_.add("thin films on glass with an inside");
  const std::optional<RoughAxis> axis = anisotropy(source, values);
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
  std::unique_ptr<Material> made = materials::make_principled(values, std::move(stand_in));
  made->rough_axis = axis;
  return made;
}

}  // namespace eyeray::engine::importers
