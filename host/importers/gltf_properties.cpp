#include "host/importers/gltf_properties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "host/core/diagnostic.hpp"

namespace eyeray::importers {

namespace {

using Names = std::span<const std::string_view>;

namespace names {

constexpr std::string_view anywhere[] = {"name", "extensions", "extras"};

constexpr std::string_view root[] = {"asset",
                                     "scene",
                                     "scenes",
                                     "nodes",
                                     "meshes",
                                     "skins",
                                     "cameras",
                                     "materials",
                                     "animations",
                                     "textures",
                                     "samplers",
                                     "images",
                                     "accessors",
                                     "bufferViews",
                                     "buffers",
                                     "extensionsUsed",
                                     "extensionsRequired"};
constexpr std::string_view asset[] = {"version", "generator", "copyright", "minVersion"};
constexpr std::string_view scene[] = {"nodes"};
constexpr std::string_view node[] = {"camera",   "children", "skin",        "matrix", "mesh",
                                     "rotation", "scale",    "translation", "weights"};
constexpr std::string_view mesh[] = {"primitives", "weights"};
constexpr std::string_view primitive[] = {"attributes", "indices", "material", "mode", "targets"};
constexpr std::string_view skin[] = {"inverseBindMatrices", "skeleton", "joints"};
constexpr std::string_view camera[] = {"type", "perspective", "orthographic"};
constexpr std::string_view perspective[] = {"aspectRatio", "yfov", "zfar", "znear"};
constexpr std::string_view orthographic[] = {"xmag", "ymag", "zfar", "znear"};
constexpr std::string_view animation[] = {"channels", "samplers"};
constexpr std::string_view channel[] = {"sampler", "target"};
constexpr std::string_view curve[] = {"input", "interpolation", "output"};
constexpr std::string_view material[] = {"pbrMetallicRoughness", "normalTexture",  "occlusionTexture",
                                         "emissiveTexture",      "emissiveFactor", "alphaMode",
                                         "alphaCutoff",          "doubleSided"};
constexpr std::string_view metallic_roughness[] = {"baseColorFactor", "baseColorTexture", "metallicFactor",
                                                   "roughnessFactor", "metallicRoughnessTexture"};
constexpr std::string_view map[] = {"index", "texCoord"};
constexpr std::string_view normal_map[] = {"index", "texCoord", "scale"};
constexpr std::string_view occlusion_map[] = {"index", "texCoord", "strength"};
constexpr std::string_view texture[] = {"sampler", "source"};
constexpr std::string_view sampler[] = {"magFilter", "minFilter", "wrapS", "wrapT"};
constexpr std::string_view image[] = {"uri", "mimeType", "bufferView"};
constexpr std::string_view accessor[] = {"bufferView", "byteOffset", "componentType", "normalized", "count",
                                         "type",       "max",        "min",           "sparse"};
constexpr std::string_view sparse[] = {"count", "indices", "values"};
constexpr std::string_view view[] = {"buffer", "byteOffset", "byteLength", "byteStride", "target"};
constexpr std::string_view buffer[] = {"uri", "byteLength"};

}  // namespace names

// Objects at a path from the document: of a list each, of an object that one.
struct Kind {
  std::vector<std::string_view> path;
  Names known;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {{}, names::root},
      {{"asset"}, names::asset},
      {{"scenes"}, names::scene},
      {{"nodes"}, names::node},
      {{"meshes"}, names::mesh},
      {{"meshes", "primitives"}, names::primitive},
      {{"skins"}, names::skin},
      {{"cameras"}, names::camera},
      {{"cameras", "perspective"}, names::perspective},
      {{"cameras", "orthographic"}, names::orthographic},
      {{"animations"}, names::animation},
      {{"animations", "channels"}, names::channel},
      {{"animations", "samplers"}, names::curve},
      {{"materials"}, names::material},
      {{"materials", "pbrMetallicRoughness"}, names::metallic_roughness},
      {{"materials", "pbrMetallicRoughness", "baseColorTexture"}, names::map},
      {{"materials", "pbrMetallicRoughness", "metallicRoughnessTexture"}, names::map},
      {{"materials", "emissiveTexture"}, names::map},
      {{"materials", "normalTexture"}, names::normal_map},
      {{"materials", "occlusionTexture"}, names::occlusion_map},
      {{"textures"}, names::texture},
      {{"samplers"}, names::sampler},
      {{"images"}, names::image},
      {{"accessors"}, names::accessor},
      {{"accessors", "sparse"}, names::sparse},
      {{"bufferViews"}, names::view},
      {{"buffers"}, names::buffer},
  };
  return all;
}

bool holds(Names known, std::string_view name) {
  return std::ranges::find(known, name) != known.end();
}

// As deep as the path is long.
void check_names(const nlohmann::json& value, const std::string& place,
                 std::span<const std::string_view> path, Names known, GltfBreaches& breaches) {
  if (value.is_array()) {
    for (size_t i = 0; i < value.size(); ++i)
      if (value[i].is_object()) check_names(value[i], fmt::format("{}[{}]", place, i), path, known, breaches);
    return;
  }
  if (!value.is_object()) return;
  const std::string before = place.empty() ? "" : place + ".";
  if (path.empty()) {
    for (const auto& [key, unused] : value.items())
      if (!holds(known, key) && !holds(names::anywhere, key))
        breaches.add("properties that glTF does not define, left out", before + printable(key));
    return;
  }
  if (const auto found = value.find(path[0]); found != value.end())
    check_names(*found, before + std::string(path[0]), path.subspan(1), known, breaches);
}

}  // namespace

void check_properties(const nlohmann::json& document, GltfBreaches& breaches) {
  for (const Kind& kind : kinds()) check_names(document, "", kind.path, kind.known, breaches);
}

}  // namespace eyeray::importers
