// Metallic-roughness in the terms of Phong and Whitted. With F0 what the surface mirrors at right angles
// (0.04, or the base colour of a metal) and r its roughness: what is smooth mirrors F0 · (1 − r)², the lights
// show a Blinn highlight of exponent 2 / r⁴ − 2 (Karis: Specular BRDF Reference, 2013), and what a rough
// metal does not mirror it scatters.
#include "importers/gltf_materials.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "materials/make.hpp"
#include "scene/diagnostic_log.hpp"
#include "scene/image_texture_file.hpp"

namespace eyeray {

namespace {

// A mirrored ray that would count for less is not worth its time.
constexpr double least_reflectance = 0.02;

double share(double value) {
  return std::clamp(value, 0.0, 1.0);
}
Vec3 share(const std::vector<double>& rgb) {
  return {share(rgb[0]), share(rgb[1]), share(rgb[2])};
}

// The mean of green and blue, linear: roughness and metalness.
Vec2 mean_green_blue(const ImageTexture& image) {
  Vec2 sum(0);
  for (const auto& texel : image.texels) sum += Vec2(texel[1], texel[2]);
  return sum / (255.0 * static_cast<double>(std::max<size_t>(1, image.texels.size())));
}

Wrap wrap(uint64_t code) {
  constexpr uint64_t clamp_to_edge = 33071;
  constexpr uint64_t mirrored_repeat = 33648;
  return code == clamp_to_edge ? Wrap::clamp : code == mirrored_repeat ? Wrap::mirror : Wrap::repeat;
}

std::unique_ptr<Material> make_glass(const GltfObject& material) {
  const auto ior = material.extension("KHR_materials_ior");
  DielectricValues glass;
  glass.ior = std::clamp(ior ? ior->number("ior", 1.5) : 1.5, 1.0, 4.0);
  if (const auto volume = material.extension("KHR_materials_volume")) {
    // Beer's law, from the colour that is left at a distance.
    const double distance = volume->number("attenuationDistance", 0);
    const Vec3 color = share(volume->numbers("attenuationColor", {1, 1, 1}));
    if (distance > 1e-12) glass.absorption = -glm::log(glm::max(color, Vec3(1e-6))) / distance;
  }
  return make_dielectric(glass);
}

}  // namespace

struct GltfMaterials::Surface {
  Vec3 base{1};
  std::shared_ptr<const ImageTexture> image;
  double metalness = 1;
  double roughness = 1;
};

GltfMaterials::GltfMaterials(const GltfObject& document, GltfBuffers& buffers, TextureFiles& textures,
                             GltfWarnings& warnings)
    : document_(document), buffers_(buffers), textures_(textures), warnings_(warnings) {}

ImageTexture GltfMaterials::decode_image(size_t index) {
  const GltfObject image = document_.element("images", index);
  std::string data;
  std::string_view bytes;
  if (const auto view = image.index("bufferView", document_.size("bufferViews"))) {
    bytes = buffers_.view(*view);
  } else {
    data = buffers_.read_uri(image, "the picture");
    bytes = data;
  }
  return decode_image_texture(std::as_bytes(std::span(bytes)), image.place());
}

// Null where the picture cannot be had.
std::shared_ptr<const ImageTexture> GltfMaterials::texture(const GltfObject& reference, bool srgb) {
  const auto index = reference.index("index", document_.size("textures"));
  if (!index) reference.fail("has no index");
  if (reference.extension("KHR_texture_transform"))
    warnings_.left_out("transforms of uv (KHR_texture_transform)");
  const GltfObject texture = document_.element("textures", *index);
  const auto source = texture.index("source", document_.size("images"));
  if (!source) {
    warnings_.left_out("textures in formats other than PNG and JPEG");
    return nullptr;
  }
  constexpr uint64_t nearest = 9728;
  uint64_t filter = 0, wrap_s = 0, wrap_t = 0;
  if (const auto sampler = texture.index("sampler", document_.size("samplers"))) {
    const GltfObject how = document_.element("samplers", *sampler);
    filter = how.count("magFilter", 0);
    wrap_s = how.count("wrapS", 0);
    wrap_t = how.count("wrapT", 0);
  }

  // The same picture with other settings is another texture.
  ImageTexture settings;
  settings.srgb = srgb;
  settings.filter = filter == nearest ? Filter::nearest : Filter::bilinear;
  settings.wrap_u = wrap(wrap_s);
  settings.wrap_v = wrap(wrap_t);
  const std::string name = fmt::format("{} {} {} {} {}", *source, srgb, static_cast<int>(settings.filter),
                                       static_cast<int>(settings.wrap_u), static_cast<int>(settings.wrap_v));
  return textures_.load(name, [&] {
    ImageTexture image = decode_image(*source);
    image.srgb = settings.srgb;
    image.filter = settings.filter;
    image.wrap_u = settings.wrap_u;
    image.wrap_v = settings.wrap_v;
    return image;
  });
}

GltfMaterials::Surface GltfMaterials::surface(const GltfObject& material) {
  Surface surface;
  const auto pbr = material.object("pbrMetallicRoughness");
  if (!pbr) return surface;
  surface.base = share(pbr->numbers("baseColorFactor", {1, 1, 1, 1}));
  surface.metalness = share(pbr->number("metallicFactor", 1));
  surface.roughness = share(pbr->number("roughnessFactor", 1));
  if (const auto reference = pbr->object("baseColorTexture")) surface.image = texture(*reference, true);
  if (const auto reference = pbr->object("metallicRoughnessTexture")) {
    if (const auto image = texture(*reference, false)) {
      warnings_.left_out("variations of metalness and roughness within a texture");
      const Vec2 mean = mean_green_blue(*image);
      surface.roughness *= mean.x;
      surface.metalness *= mean.y;
    }
  }
  return surface;
}

std::unique_ptr<Material> GltfMaterials::material(size_t index) {
  const GltfObject source = document_.element("materials", index);
  warn_of_rest(source);
  std::unique_ptr<Material> made;
  const auto transmission = source.extension("KHR_materials_transmission");
  if (transmission && transmission->number("transmissionFactor", 0) >= 0.5) {
    made = make_glass(source);
  } else {
    const Surface s = surface(source);
    const double smooth = (1 - s.roughness) * (1 - s.roughness);
    const Vec3 mirrored = glm::mix(Vec3(0.04), s.base, s.metalness) * smooth;
    const bool mirrors = std::max({mirrored.x, mirrored.y, mirrored.z}) >= least_reflectance;
    const double exponent = std::clamp(2 / std::max(1e-4, std::pow(s.roughness, 4)) - 2, 1.0, 10000.0);
    const Vec3 lobe = glm::mix(Vec3(0.04), s.base, s.metalness) * ((exponent + 2) / 8);
    const Highlight highlight{Texture{glm::min(lobe, Vec3(1)), {}}, exponent, true};
    // Only what a metal mirrors has the colour of its picture.
    const Texture reflectance{
        mirrors ? mirrored : Vec3(0), {}, mirrors && s.metalness > 0.5 ? s.image : nullptr};
    const Texture diffuse{s.base * (1 - s.metalness * smooth), {}, s.image};
    if (s.metalness * smooth > 0.95) {
      made = make_mirror({.reflectance = reflectance, .highlight = highlight});
    } else {
      made = make_phong({.diffuse = diffuse, .reflectance = reflectance, .highlight = highlight});
    }
  }
  made->name = printable(source.text("name"));
  return made;
}

uint64_t GltfMaterials::uv_set(size_t index) const {
  const auto pbr = document_.element("materials", index).object("pbrMetallicRoughness");
  const auto reference = pbr ? pbr->object("baseColorTexture") : std::nullopt;
  return reference ? reference->count("texCoord", 0) : 0;
}

void GltfMaterials::warn_of_rest(const GltfObject& material) {
  if (material.has("normalTexture")) warnings_.left_out("normal maps");
  if (material.has("occlusionTexture")) warnings_.left_out("occlusion maps");
  const Vec3 emission = share(material.numbers("emissiveFactor", {0, 0, 0}));
  if (emission != Vec3(0)) warnings_.left_out("emission and its maps");
  const std::string alpha = material.text("alphaMode");
  if (alpha == "BLEND" || alpha == "MASK") warnings_.left_out("transparencies by alpha (BLEND, MASK)");
}

}  // namespace eyeray
