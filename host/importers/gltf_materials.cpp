// Metallic-roughness materials, with a stand-in by Phong's model for Whitted's pictures. F0 is the
// reflectance at normal incidence (0.04, or the base colour of a metal), and r the roughness. A smooth
// surface mirrors F0 · (1 − r)², and lights show a Blinn highlight of exponent 2 / r⁴ − 2 (Karis: Specular
// BRDF Reference, 2013). A rough metal scatters the light that it does not mirror. An unlit material emits
// its base colour.
#include "host/importers/gltf_materials.hpp"

#include <algorithm>

#include "host/core/diagnostic_log.hpp"
#include "host/core/error.hpp"
#include "host/scene/image_texture_file.hpp"

namespace eyeray::engine::importers {

namespace {

// Least reflectance of a mirror: a mirrored ray that counts for less is not worth its time.
constexpr double least_reflectance = 0.02;

double share(double value) {
  return std::clamp(value, 0.0, 1.0);
}
Vec3 share(const std::vector<double>& rgb) {
  return {share(rgb[0]), share(rgb[1]), share(rgb[2])};
}

// Limit on emission; it is brighter than any screen.
constexpr double most_emission = 1e6;

// The predecessor of metallic-roughness; its scattering part is read.
constexpr const char* specular_glossiness = "KHR_materials_pbrSpecularGlossiness";

// The extensions that an unlit material, or one with specular_glossiness, cannot have.
constexpr const char* lit_extensions[] = {"KHR_materials_ior",         "KHR_materials_transmission",
                                          "KHR_materials_volume",      "KHR_materials_specular",
                                          "KHR_materials_clearcoat",   "KHR_materials_sheen",
                                          "KHR_materials_iridescence", "KHR_materials_dispersion",
                                          "KHR_materials_anisotropy",  "KHR_materials_diffuse_transmission"};

// The linear means of the green and blue channels, which are roughness and metalness.
Vec2 mean_green_blue(const ImageTexture& image) {
  Vec2 sum(0);
  for (const auto& texel : image.texels) sum += Vec2(texel[1], texel[2]);
  return sum / (255.0 * static_cast<double>(std::max<size_t>(1, image.texels.size())));
}

// The specification's numbers for the settings of samplers.
constexpr uint64_t nearest = 9728, linear = 9729;
constexpr uint64_t repeat = 10497, clamp_to_edge = 33071, mirrored_repeat = 33648;

Wrap wrap(uint64_t code) {
  return code == clamp_to_edge ? Wrap::clamp : code == mirrored_repeat ? Wrap::mirror : Wrap::repeat;
}

}  // namespace

void GltfLeftOut::add(const std::string& what, size_t count) {
  const auto known = std::ranges::find(counts_, what, [](const auto& entry) { return entry.first; });
  if (known != counts_.end()) {
    known->second += count;
  } else {
    counts_.emplace_back(what, count);
  }
}

void GltfLeftOut::report(std::vector<std::string>& warnings) const {
  std::string list;
  for (const auto& [what, count] : counts_)
    list += fmt::format("{}{} ({})", list.empty() ? "left out: " : ", ", what, count);
  if (!list.empty()) warnings.push_back(list);
}

GltfMaterials::GltfMaterials(const GltfObject& document, GltfBuffers& buffers, TextureFiles& textures,
                             GltfLeftOut& left_out, GltfBreaches& breaches)
    : document_(document), buffers_(buffers), textures_(textures), left_out_(left_out), breaches_(breaches) {}

ImageTexture GltfMaterials::decode_image(size_t index, image::PixelBudget& budget,
                                         std::vector<std::string>& warnings) {
  const GltfObject image = document_.element("images", index);
  std::string data;
  std::string_view bytes;
  if (const auto view = image.index("bufferView", document_.size("bufferViews"))) {
    if (image.has("uri")) image.fail("has both a uri and a bufferView: it is one picture");
    bytes = buffers_.view(*view);
    if (document_.element("bufferViews", *view).has("byteStride"))
      breaches_.add("pictures in views with a byteStride, which is ignored", image.location());
    if (!image.has("mimeType"))
      breaches_.add("pictures in views without a mimeType, decoded by their content", image.location());
  } else {
    data = buffers_.read_uri(image, "the picture");
    bytes = data;
  }
  std::string type = image.text("mimeType");
  if (const std::string uri = image.text("uri"); type.empty() && uri.starts_with("data:"))
    type = uri.substr(5, uri.find(';') - 5);
  const bool is_png = bytes.starts_with("\x89PNG"), is_jpeg = bytes.starts_with("\xff\xd8");
  const bool is_webp = bytes.starts_with("RIFF");
  if (!type.empty() && ((is_png && type != "image/png") || (is_jpeg && type != "image/jpeg") ||
                        (is_webp && type != "image/webp")))
    breaches_.add("pictures of another type than their mimeType, decoded by their content", image.location());
  if (!is_png && !is_jpeg && !is_webp)
    breaches_.add("pictures that are none of PNG, JPEG and WebP, decoded by their content", image.location());
  return decode_image_texture(std::as_bytes(std::span(bytes)), image.location(), budget, warnings);
}

// The picture that `reference` names; null if it cannot be read.
std::shared_ptr<const ImageTexture> GltfMaterials::texture(const GltfObject& reference, Content content) {
  const auto index = reference.index("index", document_.size("textures"));
  if (!index) reference.fail("has no index");
  const GltfObject texture = document_.element("textures", *index);
  // The WebP is that of a reader who knows it; `source` is the PNG or JPEG for the others.
  const auto webp = texture.extension("EXT_texture_webp");
  auto source = (webp ? *webp : texture).index("source", document_.size("images"));
  if (!source && webp) source = texture.index("source", document_.size("images"));
  if (!source) {
    left_out_.add(texture.extension("KHR_texture_basisu")
                      ? "textures in KTX2 (KHR_texture_basisu), which other programs convert to PNG or WebP"
                      : "textures without a picture");
    return nullptr;
  }
  uint64_t filter = 0, wrap_s = 0, wrap_t = 0;
  if (const auto sampler = texture.index("sampler", document_.size("samplers"))) {
    const GltfObject how = document_.element("samplers", *sampler);
    const auto one_of = [&](const char* key, std::initializer_list<uint64_t> known) {
      const uint64_t code = how.count(key, *known.begin());
      if (std::ranges::find(known, code) == known.end())
        how.fail(fmt::format("has a {} that glTF does not define", key));
      return code;
    };
    filter = one_of("magFilter", {linear, nearest});
    one_of("minFilter", {linear, nearest, 9984, 9985, 9986,
                         9987});  // the last four use mipmaps, which eyeray does not have
    wrap_s = one_of("wrapS", {repeat, clamp_to_edge, mirrored_repeat});
    wrap_t = one_of("wrapT", {repeat, clamp_to_edge, mirrored_repeat});
  }

  // Include the settings in the name: the same picture with other settings is another texture.
  ImageTexture settings;
  settings.srgb = content == Content::color;
  settings.filter = filter == nearest ? Filter::nearest : Filter::bilinear;
  settings.wrap_u = wrap(wrap_s);
  settings.wrap_v = wrap(wrap_t);
  const std::string name =
      fmt::format("{} {} {} {} {}", *source, static_cast<int>(content), static_cast<int>(settings.filter),
                  static_cast<int>(settings.wrap_u), static_cast<int>(settings.wrap_v));
  return textures_.load(name, [&](image::PixelBudget& budget, std::vector<std::string>& warnings) {
    ImageTexture image = decode_image(*source, budget, warnings);
    image.srgb = settings.srgb;
    image.filter = settings.filter;
    image.wrap_u = settings.wrap_u;
    image.wrap_v = settings.wrap_v;
    if (content == Content::alpha)
      for (auto& texel : image.texels) texel = {texel[3], texel[3], texel[3], 255};
    return image;
  });
}

std::optional<textures::ImagePosition> GltfMaterials::position(const GltfObject& material,
                                                               const GltfObject& reference,
                                                               const char* what) {
  const auto position = position_among(uv_of_material(material), uv_of(reference));
  if (!position) left_out_.add(fmt::format("{} with uv of a third kind", what));
  return position;
}

TexturePtr GltfMaterials::emission(const GltfObject& material) {
  const TexturePtr none = textures::make_constant(Vec3(0));
  Vec3 color = share(factors(material, "emissiveFactor", {0, 0, 0}));
  const auto strength = material.extension("KHR_materials_emissive_strength");
  if (color == Vec3(0)) {
    if (strength)
      breaches_.add("emissive strengths of materials without an emissiveFactor, which emit no light",
                    strength->location());
    return none;
  }
  if (strength) color *= std::clamp(not_negative(*strength, "emissiveStrength", 1), 0.0, most_emission);
  const auto reference = material.object("emissiveTexture");
  if (!reference) return textures::make_constant(color);
  const auto image = texture(*reference, Content::color);
  if (!image) return none;
  const auto at = position(material, *reference, "emission maps");
  return at ? textures::make_image(image, color, *at) : none;
}

GltfMaterials::Surface GltfMaterials::surface(const GltfObject& material) {
  Surface surface;
  if (const auto reference = base_texture(material)) surface.image = texture(*reference, Content::color);
  surface.emission = emission(material);
  const auto pbr = material.object("pbrMetallicRoughness");
  if (!pbr) {
    if (const auto old = material.extension(specular_glossiness)) {
      surface.base = share(factors(*old, "diffuseFactor", {1, 1, 1, 1}));
      surface.metalness = 0;
      surface.roughness = 1 - factor(*old, "glossinessFactor", 1);
    }
    return surface;
  }
  surface.base = share(factors(*pbr, "baseColorFactor", {1, 1, 1, 1}));
  surface.metalness = factor(*pbr, "metallicFactor", 1);
  surface.roughness = factor(*pbr, "roughnessFactor", 1);
  if (const auto reference = pbr->object("metallicRoughnessTexture")) {
    if (const auto image = texture(*reference, Content::data)) {
      const Vec3 factors(1, surface.roughness, surface.metalness);
      const Vec2 mean = mean_green_blue(*image);
      surface.roughness *= mean.x;
      surface.metalness *= mean.y;
      if (const auto at = position(material, *reference, "variations of metalness and roughness"))
        surface.metal_rough = textures::make_image(image, factors, *at);
    }
  }
  return surface;
}

std::unique_ptr<Material> GltfMaterials::material(size_t index) {
  const GltfObject source = document_.element("materials", index);
  note_rest(source);
  std::unique_ptr<Material> made;
  const auto transmission = source.extension("KHR_materials_transmission");
  if (transmission && factor(*transmission, "transmissionFactor", 0) >= 0.5) {
    const Surface s = surface(source);
    made = principled(source, s, glass(source, s));
  } else if (source.extension("KHR_materials_unlit")) {
    const Surface s = surface(source);
    made = materials::make_phong(
        {.diffuse = textures::make_constant(Vec3(0)), .emission = textured(s.base, s.image)});
  } else {
    const Surface s = surface(source);
    const double smooth = (1 - s.roughness) * (1 - s.roughness);
    const Vec3 mirrored = glm::mix(Vec3(0.04), s.base, s.metalness) * smooth;
    const bool mirrors = std::max({mirrored.x, mirrored.y, mirrored.z}) >= least_reflectance;
    const double exponent = std::clamp(2 / std::max(1e-4, std::pow(s.roughness, 4)) - 2, 1.0, 10000.0);
    const Vec3 lobe = glm::mix(Vec3(0.04), s.base, s.metalness) * ((exponent + 2) / 8);
    const materials::Highlight highlight{textures::make_constant(glm::min(lobe, Vec3(1))), exponent, true};
    // Only a metal's reflection has the colour of its picture.
    const TexturePtr reflectance =
        textured(mirrors ? mirrored : Vec3(0), mirrors && s.metalness > 0.5 ? s.image : nullptr);
    const TexturePtr diffuse = textured(s.base * (1 - s.metalness * smooth), s.image);
    // A pure mirror has no diffuse body.
    const bool mirror = s.metalness * smooth > 0.95;
    auto stand_in = materials::make_phong({.diffuse = mirror ? textures::make_constant(Vec3(0)) : diffuse,
                                           .reflectance = reflectance,
                                           .emission = s.emission,
                                           .highlight = highlight});
    made = principled(source, s, std::move(stand_in));
  }
  if (const std::string mode = source.text("alphaMode"); mode == "MASK" || mode == "BLEND") {
    const bool blends = mode == "BLEND";
    if (made->medium()) {
      left_out_.add(blends ? "alpha transparency of glass" : "cutouts in glass");
    } else {
      made->mask = mask(source, blends);
    }
  }
  // Glass needs its back: rays leave through it.
  made->front_only = !source.flag("doubleSided") && !made->medium() && !made->thin();
  made->emits_in_front = made->front_only && made->emits();
  made->normal_map = normal_map(source, source.object("normalTexture"));
  if (const auto coat = source.extension("KHR_materials_clearcoat"))
    made->coat_normal_map = normal_map(source, coat->object("clearcoatNormalTexture"));
  made->name = printable(source.text("name"));
  return made;
}

std::optional<NormalMap> GltfMaterials::normal_map(const GltfObject& material,
                                                   const std::optional<GltfObject>& reference) {
  if (!reference) return std::nullopt;
  const auto image = texture(*reference, Content::data);
  if (!image) return std::nullopt;
  const auto at = position(material, *reference, "normal maps");
  if (!at) return std::nullopt;
  return NormalMap{textures::make_image(image, Vec3(1), *at), reference->number("scale", 1)};
}

// The alpha mask of the material; nothing if its cutoff of 0 cuts nothing out.
std::optional<AlphaMask> GltfMaterials::mask(const GltfObject& material, bool blends) {
  const double cutoff = blends ? 1 : not_negative(material, "alphaCutoff", 0.5);
  if (!(cutoff > 0)) return std::nullopt;
  const auto pbr = material.object("pbrMetallicRoughness");
  const auto old = pbr ? std::nullopt : material.extension(specular_glossiness);
  double alpha = 1;
  if (pbr) alpha = factors(*pbr, "baseColorFactor", {1, 1, 1, 1})[3];
  if (old) alpha = factors(*old, "diffuseFactor", {1, 1, 1, 1})[3];
  const auto reference = base_texture(material);
  return AlphaMask{textured(Vec3(alpha), reference ? texture(*reference, Content::color) : nullptr), cutoff,
                   blends};
}

// The base colour's texture of metallic-roughness, or else the diffuse texture of specular-glossiness.
std::optional<GltfObject> GltfMaterials::base_texture(const GltfObject& material) {
  if (const auto pbr = material.object("pbrMetallicRoughness")) return pbr->object("baseColorTexture");
  const auto old = material.extension(specular_glossiness);
  return old ? old->object("diffuseTexture") : std::nullopt;
}

// The textures of the material. The base colour's texture comes first: an alpha takes the first uv.
std::vector<GltfObject> GltfMaterials::textures_of(const GltfObject& material) {
  std::vector<GltfObject> textures;
  const auto add = [&](const std::optional<GltfObject>& texture) {
    if (texture) textures.push_back(*texture);
  };
  add(base_texture(material));
  add(material.object("emissiveTexture"));
  if (const auto pbr = material.object("pbrMetallicRoughness")) add(pbr->object("metallicRoughnessTexture"));
  add(material.object("normalTexture"));
  add_extension_textures(material, textures);
  return textures;
}

std::vector<GltfUv> GltfMaterials::uv_of_material(const GltfObject& material) {
  std::vector<GltfUv> found;
  for (const GltfObject& texture : textures_of(material))
    if (const GltfUv uv = uv_of(texture); found.size() < 2 && !position_among(found, uv)) found.push_back(uv);
  return found;
}

GltfUvUse GltfMaterials::uv_use(size_t index) const {
  const GltfObject material = document_.element("materials", index);
  GltfUvUse use{uv_of_material(material)};
  auto normal = material.object("normalTexture");
  if (const auto anisotropy = material.extension("KHR_materials_anisotropy")) {
    if (!normal) normal = anisotropy->object("anisotropyTexture");
    if (use.uv.empty()) use.uv.emplace_back();
  }
  const auto at = normal ? position_among(use.uv, uv_of(*normal)) : std::nullopt;
  use.second_tangents = at && at->second_uv;
  return use;
}

double GltfMaterials::factor(const GltfObject& owner, const char* key, double fallback) {
  const double value = owner.number(key, fallback);
  if (share(value) != value)
    breaches_.add("factors below 0 or above 1, clamped", fmt::format("{}.{}", owner.location(), key));
  return share(value);
}

double GltfMaterials::not_negative(const GltfObject& owner, const char* key, double fallback) {
  const double value = owner.number(key, fallback);
  if (value < 0)
    breaches_.add("values of materials below 0, set to 0", fmt::format("{}.{}", owner.location(), key));
  return std::max(value, 0.0);
}

std::vector<double> GltfMaterials::factors(const GltfObject& owner, const char* key,
                                           std::vector<double> fallback) {
  std::vector<double> values = owner.numbers(key, std::move(fallback));
  for (double& value : values) {
    if (share(value) != value)
      breaches_.add("factors below 0 or above 1, clamped", fmt::format("{}.{}", owner.location(), key));
    value = share(value);
  }
  return values;
}

void GltfMaterials::note_rest(const GltfObject& material) {
  const std::string alpha = material.text("alphaMode");
  if (!alpha.empty() && alpha != "OPAQUE" && alpha != "MASK" && alpha != "BLEND")
    material.fail("has an alphaMode that glTF does not define");
  const bool excludes = material.extension("KHR_materials_unlit") || material.extension(specular_glossiness);
  if (excludes && std::ranges::any_of(lit_extensions,
                                      [&](const char* name) { return material.extension(name).has_value(); }))
    breaches_.add("materials with extensions that exclude each other", material.location());
  if (material.has("occlusionTexture")) left_out_.add("occlusion maps");
  if (material.has("alphaCutoff") && alpha != "MASK")
    breaches_.add("alpha cutoffs of materials whose alphaMode is not MASK, left out", material.location());
  const auto volume = material.extension("KHR_materials_volume");
  const bool evenly = material.extension("KHR_materials_diffuse_transmission").has_value();
  if (volume && evenly && !material.extension("KHR_materials_transmission"))
    left_out_.add("volumes of materials that transmit light evenly");
  else if (volume && !material.extension("KHR_materials_transmission"))
    breaches_.add("volumes of materials that transmit no light, left out", volume->location());
}

}  // namespace eyeray::engine::importers
