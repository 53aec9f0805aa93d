#include "host/importers/obj_materials.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>

#define TINYOBJLOADER_IMPLEMENTATION
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include "host/core/diagnostic_log.hpp"
#include "host/core/error.hpp"
#include "host/core/input_file.hpp"
#include "host/importers/formats.hpp"
#include "host/importers/height_map.hpp"
#include "host/importers/obj_text.hpp"
#include "host/materials/make.hpp"
#include "host/scene/image_texture_file.hpp"

namespace eyeray::engine::importers {

namespace {

double share(double value) {
  return value >= 0 ? std::min(value, 1.0) : 0;  // NaN is 0
}
Vec3 color(const double (&rgb)[3]) {
  return {share(rgb[0]), share(rgb[1]), share(rgb[2])};
}

// True for the `illum` numbers of surfaces that mirror, and of surfaces that let light through.
bool mirrors(int illum) {
  return illum == 3 || illum == 5 || illum == 8;
}
bool refracts(int illum) {
  return illum == 4 || illum == 6 || illum == 7 || illum == 9;
}

materials::Highlight highlight(const tinyobj::material_t& source) {
  constexpr int no_highlight = 1;
  if (source.illum == no_highlight) return {};
  // `Ns` is the exponent of Blinn's lobe (Alias: Object Files, B1).
  const double shininess = source.shininess >= 1 ? std::min(source.shininess, 10000.0) : 1;
  return {textures::make_constant(color(source.specular)), shininess, true};
}

bool is_glass(const tinyobj::material_t& source) {
  // Maya gives opaque materials `illum 4`, `Tf 1 1 1` and `Ni 1`: an index of 1 bends nothing, and `d`
  // blends.
  return refracts(source.illum) && source.ior > 1;
}

constexpr size_t most_statements_named = 16;

// Limit on a material's emission: a larger value is a mistake.
constexpr double most_emission = 1e6;

TexturePtr emission(const tinyobj::material_t& source, std::shared_ptr<const ImageTexture> picture) {
  Vec3 color(0);
  for (int c = 0; c < 3; ++c)
    if (source.emission[c] > 0) color[c] = std::min<double>(source.emission[c], most_emission);
  if (picture && color == Vec3(0)) color = Vec3(1);
  return textured(color, std::move(picture));
}

// The pictures of a material.
struct Maps {
  std::shared_ptr<const ImageTexture> diffuse, emission, roughness, metallic, sheen;
};

// True if a value or map of the physically based extension (Pr, Pm, Pc, Ps) is set, which `illum` does not
// describe.
bool is_principled(const tinyobj::material_t& source, const Maps& maps) {
  return source.roughness > 0 || source.metallic > 0 || source.clearcoat_thickness > 0 || source.sheen > 0 ||
         maps.roughness || maps.metallic || maps.sheen;
}

std::unique_ptr<Material> convert(const tinyobj::material_t& source, const Maps& maps) {
  if (is_glass(source)) {
    const double ior = source.ior <= 4 ? source.ior : 1.5;
    return materials::make_dielectric({.ior = ior, .highlight = highlight(source)});
  }
  const TexturePtr diffuse = textured(color(source.diffuse), maps.diffuse);
  const TexturePtr emitted = emission(source, maps.emission);
  if (is_principled(source, maps)) {
    const auto constant = [](double value) { return textures::make_constant(Vec3(share(value))); };
    // A value multiplies its map. A value of 0 beside a map is absent.
    const auto scaled = [](double value, const std::shared_ptr<const ImageTexture>& map) {
      return textured(Vec3(map && !(value > 0) ? 1 : share(value)), map);
    };
    auto made = materials::make_principled({.color = diffuse,
                                            .metallic = scaled(source.metallic, maps.metallic),
                                            .roughness = scaled(source.roughness, maps.roughness),
                                            .anisotropy = constant(source.anisotropy),
                                            .sheen = scaled(source.sheen, maps.sheen),
                                            .coat = constant(source.clearcoat_thickness),
                                            .coat_roughness = constant(source.clearcoat_roughness),
                                            .emission = emitted});
    if (made->rough_axis) made->rough_axis->turn = 2 * std::numbers::pi * double(source.anisotropy_rotation);
    return made;
  }
  if (!mirrors(source.illum))
    return materials::make_phong({.diffuse = diffuse, .emission = emitted, .highlight = highlight(source)});
  const TexturePtr reflectance = textures::make_constant(color(source.specular));
  if (color(source.diffuse) == Vec3(0) && emitted->constant() == Vec3(0))
    return materials::make_mirror({.reflectance = reflectance});
  return materials::make_phong(
      {.diffuse = diffuse, .reflectance = reflectance, .emission = emitted, .highlight = highlight(source)});
}

// The alpha mask of `d` and `map_d`. It blends if either has a value between 0 and 1; else it cuts out.
std::optional<AlphaMask> mask(double dissolve, const std::shared_ptr<const ImageTexture>& picture) {
  const double factor = share(dissolve);
  if (!picture && factor == 1) return std::nullopt;
  if (!picture) return AlphaMask{.alpha = textured(Vec3(factor), nullptr), .blends = factor > 0};
  // Ignore a `d 0`, which some writers set beside a map.
  const bool counts = factor > 0 && factor < 1;
  const auto between = [](const auto& texel) { return texel[3] != 0 && texel[3] != 255; };
  return AlphaMask{.alpha = textured(Vec3(counts ? factor : 1), picture),
                   .blends = counts || std::ranges::any_of(picture->texels, between)};
}

// The options that position a map on the surface.
ObjUv uv_of(const tinyobj::texture_option_t& options) {
  return {{options.scale[0], options.scale[1]}, {options.origin_offset[0], options.origin_offset[1]}};
}

// Adds the unknown statements of a material to `names`.
void add_unknown(const tinyobj::material_t& source, std::set<std::string>& names) {
  // Advice about the quality of maps.
  constexpr std::string_view advice[] = {"map_aat", "sharpness"};
  for (const auto& [name, value] : source.unknown_parameter)
    if (std::ranges::find(advice, name) == std::end(advice)) names.insert(printable(name));
}

// The words for a warning about each value of a material that has no counterpart here.
std::vector<std::string> left_out(const tinyobj::material_t& source, const Maps& maps) {
  std::vector<std::string> words;
  const auto add = [&](bool has, const char* what) {
    if (has) words.emplace_back(what);
  };
  const bool glass = is_glass(source);
  const bool emits = color(source.emission) != Vec3(0) || !source.emissive_texname.empty();
  // A `Tf` of 0 is absent.
  const Vec3 tint(source.transmittance[0], source.transmittance[1], source.transmittance[2]);
  add(glass && color(source.diffuse) != Vec3(0), "the colour (Kd) of glass");
  add(glass && tint != Vec3(0) && tint != Vec3(1), "the tint (Tf) of glass");
  add(glass && source.dissolve > 0 && source.dissolve < 1,
      "the transparency (d) of glass: an index (Ni) of 1 makes it count");
  add(glass && !source.diffuse_texname.empty(), "pictures (map_Kd) of glass");
  add(glass && is_principled(source, maps), "the values and maps Pr, Pm, Pc and Ps of glass");
  add(glass && !source.alpha_texname.empty(), "maps of transparency (map_d) of glass");
  add(glass && emits, "the emission (Ke) of glass");
  add(!source.displacement_texname.empty(), "displacement maps");
  add(!source.specular_texname.empty() || !source.specular_highlight_texname.empty(),
      "maps of highlights (map_Ks, map_Ns)");
  add(!source.reflection_texname.empty(), "reflection maps (refl)");
  const bool turned = source.anisotropy != 0 || source.anisotropy_rotation != 0;
  add(turned && (glass || !is_principled(source, maps)),
      "anisotropy (aniso, anisor) without Pr, Pm, Pc or Ps");
  // Many programs repeat the colour's picture as map_Ka.
  add(source.ambient_texname != source.diffuse_texname && !source.ambient_texname.empty(),
      "maps of ambient light (map_Ka)");
  return words;
}

}  // namespace

int ObjMaterials::find(const std::string& name) const {
  const auto found = indices_.find(name);
  return found == indices_.end() ? -1 : found->second;
}

void ObjMaterials::warn(std::string message) {
  if (std::ranges::find(warnings, message) == warnings.end()) warnings.push_back(std::move(message));
}

void ObjMaterials::load(std::string_view names) {
  const std::string all(names);
  const bool one = all.find(' ') == std::string::npos;
  if (read(all, one) || one) return;
  std::istringstream words(all);
  for (std::string name; words >> name;) read(name, true);
}

// Reads a .mtl file. If it cannot be read: warns and returns true if this is the `last` name to try; else
// returns false.
bool ObjMaterials::read(const std::string& name, bool last) {
  if (done_.contains(name)) return true;
  std::string text;
  try {
    text = assets_.read(name, "the materials");
  } catch (const Error& error) {
    if (last && done_.insert(name).second) warn(std::string("materials were left out: ") + error.what());
    return last;
  }
  done_.insert(name);
  if (is_utf16(text)) {
    warn(fmt::format("materials were left out: {} is text in UTF-16: save it as UTF-8", name));
  } else {
    parse(std::move(text));
  }
  return true;
}

void ObjMaterials::parse(std::string text) {
  drop_byte_order_mark(text);
  std::map<std::string, int> names;
  std::vector<tinyobj::material_t> sources;
  end_lines_with_newlines(text);
  const MtlText plain = plain_mtl(text);
  for (const std::string& what : plain.left_out) warn("left out: " + what);
  std::istringstream stream(plain.text);
  std::string unused;
  tinyobj::LoadMtl(&names, &sources, &stream, &unused, &unused);
  std::set<std::string> unknown;
  for (const tinyobj::material_t& source : sources) {
    // Skip statements before the first `newmtl`, which have no material's name.
    if (source.name.empty() || indices_.contains(source.name)) continue;
    indices_[source.name] = static_cast<int>(materials.size());

    // Load the material's pictures. A vertex has one uv, so the first picture's options apply to all
    // pictures.
    std::optional<ObjUv> uv;
    const auto load = [&](const std::string& name, const tinyobj::texture_option_t& options, MapUse use) {
      if (name.empty()) return std::shared_ptr<const ImageTexture>();
      if (uv && !(*uv == uv_of(options)))
        warn("options -s and -o that differ between a material's maps were left out");
      if (!uv) uv = uv_of(options);
      return picture(name, options.clamp, use);
    };
    Maps maps;
    maps.diffuse = load(source.diffuse_texname, source.diffuse_texopt, MapUse::color);
    const auto alpha = load(source.alpha_texname, source.alpha_texopt, MapUse::alpha);
    maps.emission = load(source.emissive_texname, source.emissive_texopt, MapUse::color);
    maps.roughness = load(source.roughness_texname, source.roughness_texopt, MapUse::data);
    maps.metallic = load(source.metallic_texname, source.metallic_texopt, MapUse::data);
    maps.sheen = load(source.sheen_texname, source.sheen_texopt, MapUse::data);
    auto normals = load(source.normal_texname, source.normal_texopt, MapUse::data);
    const auto bumps = load(source.bump_texname, source.bump_texopt, MapUse::data);
    if (bumps && normals)
      warn("left out: bump maps beside normal maps");
    else if (bumps)
      normals = normals_of(bumps, source.bump_texname, source.bump_texopt.clamp,
                           double(source.bump_texopt.bump_multiplier));

    std::unique_ptr<Material> made = convert(source, maps);
    made->name = printable(source.name);
    if (!made->medium()) made->mask = mask(source.dissolve, alpha);
    if (normals) made->normal_map = NormalMap{textures::make_image(normals)};
    materials.push_back(std::move(made));
    uv_.push_back(uv.value_or(ObjUv{}));
    for (const std::string& what : left_out(source, maps)) warn("left out: " + what);
    add_unknown(source, unknown);
  }
  if (unknown.empty()) return;
  const size_t named = std::min(unknown.size(), most_statements_named);
  warn(fmt::format("left out: statements that eyeray does not know ({}{})",
                   fmt::join(unknown.begin(), std::next(unknown.begin(), std::ptrdiff_t(named)), ", "),
                   named < unknown.size() ? ", …" : ""));
}

// The normal map of a bump map, which many programs make one already. Null, with a warning, if it is neither
// that nor grey.
std::shared_ptr<const ImageTexture> ObjMaterials::normals_of(const std::shared_ptr<const ImageTexture>& bumps,
                                                             const std::string& name, bool clamp,
                                                             double multiplier) {
  if (has_normals(*bumps)) return bumps;
  if (!has_heights(*bumps)) {
    warn("left out: bump maps that are neither grey nor normal maps");
    return nullptr;
  }
  constexpr double most_strength = 1000;
  const double strength =
      std::isfinite(multiplier) ? std::clamp(multiplier, -most_strength, most_strength) : 1;
  return textures_.load(fmt::format("{} {} heights {}", name, clamp, strength),
                        [&](image::PixelBudget& budget, std::vector<std::string>&) {
                          budget.take(bumps->width, bumps->height, bumps->name);
                          return normals_of_heights(*bumps, strength);
                        });
}

std::shared_ptr<const ImageTexture> ObjMaterials::picture(const std::string& name, bool clamp, MapUse use) {
  return textures_.load(
      fmt::format("{} {} {}", name, clamp, static_cast<int>(use)),
      [&](image::PixelBudget& budget, std::vector<std::string>& messages) {
        ImageTexture image = load_image_texture(assets_.locate(name), budget, messages);
        if (clamp) image.wrap_u = image.wrap_v = Wrap::clamp;
        image.srgb = use == MapUse::color;
        // The opacity is the picture's alpha, or its brightness if all of the picture is opaque.
        const auto opaque = [](const auto& texel) { return texel[3] == 255; };
        if (use == MapUse::alpha && std::ranges::all_of(image.texels, opaque))
          for (auto& texel : image.texels)
            texel[3] = static_cast<uint8_t>((54 * texel[0] + 183 * texel[1] + 19 * texel[2] + 128) / 256);
        return image;
      });
}

}  // namespace eyeray::engine::importers
