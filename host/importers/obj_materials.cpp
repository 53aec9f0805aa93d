#include "host/importers/obj_materials.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#define TINYOBJLOADER_IMPLEMENTATION
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include "host/core/error.hpp"
#include "host/materials/make.hpp"
#include "host/scene/diagnostic_log.hpp"

namespace eyeray::importers {

namespace {

double share(double value) {
  return value >= 0 ? std::min(value, 1.0) : 0;  // NaN is 0
}
Vec3 color(const double (&rgb)[3]) {
  return {share(rgb[0]), share(rgb[1]), share(rgb[2])};
}

// `illum` numbers of surfaces that mirror, and of those that let light through.
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

std::unique_ptr<Material> convert(const tinyobj::material_t& source,
                                  std::shared_ptr<const ImageTexture> image) {
  if (refracts(source.illum)) {
    const double ior = source.ior >= 1 && source.ior <= 4 ? source.ior : 1.5;
    return materials::make_dielectric({.ior = ior, .highlight = highlight(source)});
  }
  const TexturePtr diffuse = textured(color(source.diffuse), std::move(image));
  if (!mirrors(source.illum))
    return materials::make_phong({.diffuse = diffuse, .highlight = highlight(source)});
  const TexturePtr reflectance = textures::make_constant(color(source.specular));
  if (color(source.diffuse) == Vec3(0)) return materials::make_mirror({.reflectance = reflectance});
  return materials::make_phong(
      {.diffuse = diffuse, .reflectance = reflectance, .highlight = highlight(source)});
}

// What a material says that ours cannot; the words for a warning.
std::vector<std::string> left_out(const tinyobj::material_t& source) {
  std::vector<std::string> words;
  const auto add = [&](bool has, const char* what) {
    if (has) words.emplace_back(what);
  };
  add(source.dissolve < 1 && !refracts(source.illum), "the transparency (d, Tr) of materials");
  add(!source.alpha_texname.empty(), "maps of transparency (map_d)");
  add(color(source.emission) != Vec3(0) || !source.emissive_texname.empty(),
      "the emission (Ke) of materials");
  const auto& option = source.diffuse_texopt;
  const auto is = [](const double(&v)[3], double value) {
    return v[0] == value && v[1] == value && v[2] == value;
  };
  add(option.clamp || !is(option.scale, 1) || !is(option.origin_offset, 0), "options of map_Kd");
  add(!source.bump_texname.empty() || !source.normal_texname.empty(), "bump and normal maps");
  add(!source.displacement_texname.empty(), "displacement maps");
  add(!source.specular_texname.empty() || !source.specular_highlight_texname.empty(),
      "maps of highlights (map_Ks, map_Ns)");
  add(!source.reflection_texname.empty(), "reflection maps (refl)");
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

// Whether there is such a file; where there is none and this was the `last` name to try, warns.
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
  parse(std::move(text));
  return true;
}

void ObjMaterials::parse(std::string text) {
  std::map<std::string, int> names;
  std::vector<tinyobj::material_t> sources;
  std::istringstream stream(std::move(text));
  std::string unused;
  tinyobj::LoadMtl(&names, &sources, &stream, &unused, &unused);
  for (const tinyobj::material_t& source : sources) {
    // What stands before the first `newmtl` has no name, and nobody uses it.
    if (source.name.empty() || indices_.contains(source.name)) continue;
    indices_[source.name] = static_cast<int>(materials.size());
    std::shared_ptr<const ImageTexture> image;
    if (!source.diffuse_texname.empty()) image = textures_.load(source.diffuse_texname);
    materials.push_back(convert(source, std::move(image)));
    materials.back()->name = printable(source.name);
    for (const std::string& what : left_out(source)) warn(what + " were left out");
  }
}

}  // namespace eyeray::importers
