#include "host/importers/gltf_properties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/importers/gltf_property.hpp"

namespace eyeray::engine::importers {

namespace {

using namespace gltf;
using Json = nlohmann::json;

namespace shapes {

constexpr Property nothing[] = {text("name")};
constexpr Property asset[] = {text("version").must(), text("generator"), text("copyright"),
                              text("minVersion")};

// Binary data.
constexpr Property fallback[] = {flag("fallback")};
constexpr Property buffer[] = {text("uri"), count("byteLength", 1).must(),
                               extension("EXT_meshopt_compression", fallback),
                               extension("KHR_meshopt_compression", fallback)};
constexpr Property meshopt[] = {index("buffer", "buffers").must(),
                                count("byteOffset"),
                                count("byteLength", 1).must(),
                                count("byteStride").must(),
                                count("count", 1).must(),
                                text("mode").must(),
                                text("filter")};
constexpr Property view[] = {index("buffer", "buffers").must(),
                             count("byteOffset"),
                             count("byteLength", 1).must(),
                             count("byteStride"),
                             one_of("target", "34962 34963"),
                             extension("EXT_meshopt_compression", meshopt),
                             extension("KHR_meshopt_compression", meshopt)};
constexpr Property sparse_index[] = {index("bufferView", "bufferViews").must(), count("byteOffset"),
                                     one_of("componentType", "5121 5123 5125").must()};
constexpr Property values[] = {index("bufferView", "bufferViews").must(), count("byteOffset")};
constexpr Property sparse[] = {count("count", 1).must(), object("indices", sparse_index).must(),
                               object("values", values).must()};
constexpr Property accessor[] = {index("bufferView", "bufferViews"),
                                 count("byteOffset"),
                                 one_of("componentType", "5120 5121 5122 5123 5125 5126").must(),
                                 flag("normalized"),
                                 count("count", 1).must(),
                                 one_of("type", "SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4").must(),
                                 number("max").of_length(1, 16),
                                 number("min").of_length(1, 16),
                                 object("sparse", sparse)};

// Meshes and skins.
constexpr Property attributes[] = {index("*", "accessors")};
constexpr Property draco_ids[] = {count("*")};
constexpr Property draco[] = {index("bufferView", "bufferViews").must(),
                              object("attributes", draco_ids).must()};
constexpr Property mapping[] = {number("variants").listed().must(), index("material", "materials").must(),
                                text("name")};
constexpr Property mappings[] = {objects("mappings", mapping).must()};
constexpr Property primitive[] = {object("attributes", attributes).must(),
                                  index("indices", "accessors"),
                                  index("material", "materials"),
                                  one_of("mode", "0 1 2 3 4 5 6"),
                                  objects("targets", attributes),
                                  extension("KHR_draco_mesh_compression", draco),
                                  extension("KHR_materials_variants", mappings)};
constexpr Property mesh[] = {objects("primitives", primitive).must(), number("weights").listed()};
constexpr Property skin[] = {index("inverseBindMatrices", "accessors"), index("skeleton", "nodes"),
                             index("joints", "nodes").listed().must()};

// Materials.
constexpr Property transform[] = {number("offset").of_length(2), number("rotation"),
                                  number("scale").of_length(2), count("texCoord")};
constexpr Property map[] = {index("index", "textures").must(), count("texCoord"),
                            extension("KHR_texture_transform", transform)};
constexpr Property normal_map[] = {index("index", "textures").must(), count("texCoord"), number("scale"),
                                   extension("KHR_texture_transform", transform)};
constexpr Property occlusion_map[] = {index("index", "textures").must(), count("texCoord"),
                                      number("strength"), extension("KHR_texture_transform", transform)};
constexpr Property metallic_roughness[] = {
    number("baseColorFactor").of_length(4), object("baseColorTexture", map), number("metallicFactor"),
    number("roughnessFactor"), object("metallicRoughnessTexture", map)};
constexpr Property ior[] = {number("ior")};
constexpr Property transmission[] = {number("transmissionFactor"), object("transmissionTexture", map)};
constexpr Property volume[] = {number("thicknessFactor"), object("thicknessTexture", map),
                               number("attenuationDistance"), number("attenuationColor").of_length(3)};
constexpr Property strength[] = {number("emissiveStrength")};
constexpr Property specular[] = {number("specularFactor"), object("specularTexture", map),
                                 number("specularColorFactor").of_length(3),
                                 object("specularColorTexture", map)};
constexpr Property clearcoat[] = {
    number("clearcoatFactor"), object("clearcoatTexture", map), number("clearcoatRoughnessFactor"),
    object("clearcoatRoughnessTexture", map), object("clearcoatNormalTexture", normal_map)};
constexpr Property sheen[] = {number("sheenColorFactor").of_length(3), object("sheenColorTexture", map),
                              number("sheenRoughnessFactor"), object("sheenRoughnessTexture", map)};
constexpr Property diffuse_transmission[] = {
    number("diffuseTransmissionFactor"), object("diffuseTransmissionTexture", map),
    number("diffuseTransmissionColorFactor").of_length(3), object("diffuseTransmissionColorTexture", map)};
constexpr Property anisotropy[] = {number("anisotropyStrength"), number("anisotropyRotation"),
                                   object("anisotropyTexture", map)};
constexpr Property iridescence[] = {number("iridescenceFactor"),
                                    object("iridescenceTexture", map),
                                    number("iridescenceIor"),
                                    number("iridescenceThicknessMinimum"),
                                    number("iridescenceThicknessMaximum"),
                                    object("iridescenceThicknessTexture", map)};
constexpr Property dispersion[] = {number("dispersion")};
constexpr Property specular_glossiness[] = {number("diffuseFactor").of_length(4),
                                            object("diffuseTexture", map),
                                            number("specularFactor").of_length(3), number("glossinessFactor"),
                                            object("specularGlossinessTexture", map)};
constexpr Property material[] = {object("pbrMetallicRoughness", metallic_roughness),
                                 object("normalTexture", normal_map),
                                 object("occlusionTexture", occlusion_map),
                                 object("emissiveTexture", map),
                                 number("emissiveFactor").of_length(3),
                                 one_of("alphaMode", "OPAQUE MASK BLEND"),
                                 number("alphaCutoff"),
                                 flag("doubleSided"),
                                 extension("KHR_materials_ior", ior),
                                 extension("KHR_materials_transmission", transmission),
                                 extension("KHR_materials_volume", volume),
                                 extension("KHR_materials_unlit", nothing),
                                 extension("KHR_materials_emissive_strength", strength),
                                 extension("KHR_materials_specular", specular),
                                 extension("KHR_materials_clearcoat", clearcoat),
                                 extension("KHR_materials_sheen", sheen),
                                 extension("KHR_materials_diffuse_transmission", diffuse_transmission),
                                 extension("KHR_materials_anisotropy", anisotropy),
                                 extension("KHR_materials_iridescence", iridescence),
                                 extension("KHR_materials_dispersion", dispersion),
                                 extension("KHR_materials_pbrSpecularGlossiness", specular_glossiness)};
constexpr Property webp[] = {index("source", "images").must()};
constexpr Property texture[] = {index("sampler", "samplers"), index("source", "images"),
                                extension("EXT_texture_webp", webp)};
constexpr Property sampler[] = {one_of("magFilter", "9728 9729"),
                                one_of("minFilter", "9728 9729 9984 9985 9986 9987"),
                                one_of("wrapS", "33071 33648 10497"), one_of("wrapT", "33071 33648 10497")};
constexpr Property image[] = {text("uri"), text("mimeType"), index("bufferView", "bufferViews")};

// Nodes, and the objects that they refer to.
constexpr Property perspective[] = {number("aspectRatio"), number("yfov").must(), number("zfar"),
                                    number("znear").must()};
constexpr Property orthographic[] = {number("xmag").must(), number("ymag").must(), number("zfar").must(),
                                     number("znear").must()};
constexpr Property camera[] = {text("type"), object("perspective", perspective),
                               object("orthographic", orthographic)};
constexpr Property spot[] = {number("innerConeAngle"), number("outerConeAngle")};
constexpr Property light[] = {number("color").of_length(3), number("intensity"),
                              one_of("type", "directional point spot").must(), number("range"),
                              object("spot", spot)};
constexpr Property lights[] = {objects("lights", light).must()};
constexpr Property node_light[] = {count("light").must()};
constexpr Property visibility[] = {flag("visible")};
constexpr Property instancing[] = {object("attributes", attributes).must()};
constexpr Property node[] = {index("camera", "cameras"),
                             index("children", "nodes").listed(),
                             index("skin", "skins"),
                             number("matrix").of_length(16),
                             index("mesh", "meshes"),
                             number("rotation").of_length(4),
                             number("scale").of_length(3),
                             number("translation").of_length(3),
                             number("weights").listed(),
                             extension("KHR_lights_punctual", node_light),
                             extension("KHR_node_visibility", visibility),
                             extension("EXT_mesh_gpu_instancing", instancing)};
constexpr Property scene[] = {index("nodes", "nodes").listed()};

// Animations.
constexpr Property target[] = {index("node", "nodes"),
                               one_of("path", "translation rotation scale weights pointer").must()};
constexpr Property channel[] = {count("sampler").must(), object("target", target).must()};
constexpr Property curve[] = {index("input", "accessors").must(),
                              one_of("interpolation", "LINEAR STEP CUBICSPLINE"),
                              index("output", "accessors").must()};
constexpr Property animation[] = {objects("channels", channel).must(), objects("samplers", curve).must()};

constexpr Property variant[] = {text("name").must()};
constexpr Property variants[] = {objects("variants", variant).must()};

constexpr Property document[] = {object("asset", asset).must(),
                                 index("scene", "scenes"),
                                 objects("scenes", scene),
                                 objects("nodes", node),
                                 objects("meshes", mesh),
                                 objects("skins", skin),
                                 objects("cameras", camera),
                                 objects("materials", material),
                                 objects("animations", animation),
                                 objects("textures", texture),
                                 objects("samplers", sampler),
                                 objects("images", image),
                                 objects("accessors", accessor),
                                 objects("bufferViews", view),
                                 objects("buffers", buffer),
                                 text("extensionsUsed").listed(),
                                 text("extensionsRequired").listed(),
                                 extension("KHR_lights_punctual", lights),
                                 extension("KHR_materials_variants", variants)};

}  // namespace shapes

// The extensions that are read, except those of materials.
constexpr std::string_view known_extensions[] = {"KHR_lights_punctual",     "KHR_mesh_quantization",
                                                 "KHR_texture_transform",   "EXT_meshopt_compression",
                                                 "KHR_meshopt_compression", "KHR_draco_mesh_compression",
                                                 "KHR_node_visibility",     "EXT_mesh_gpu_instancing",
                                                 "KHR_materials_variants",  "EXT_texture_webp"};

// The extensions that change no picture.
constexpr std::string_view harmless_extensions[] = {"KHR_xmp",
                                                    "KHR_xmp_json_ld",
                                                    "KHR_node_hoverability",
                                                    "KHR_node_selectability",
                                                    "EXT_mesh_features",
                                                    "EXT_instance_features",
                                                    "EXT_structural_metadata",
                                                    "EXT_mesh_manifold",
                                                    "FB_geometry_metadata"};

template <size_t N>
bool is_listed(std::string_view name, const std::string_view (&names)[N]) {
  return std::ranges::find(names, name) != std::end(names);
}

constexpr Property name_of_object = text("name");

const Property* find(Members table, std::string_view name, bool extension) {
  const auto found = std::ranges::find_if(table, [&](const Property& row) {
    return (row.name == name || row.name == "*") && row.extension == extension;
  });
  return found == table.end() ? nullptr : &*found;
}

bool is_read(std::string_view extension) {
  return find(shapes::material, extension, true) || is_listed(extension, known_extensions);
}

// The value if it is an integer of at least 0; else nothing.
std::optional<double> as_count(const Json& value) {
  const double number = value.is_number() ? value.get<double>() : -1;
  return number >= 0 && number == std::trunc(number) ? std::optional(number) : std::nullopt;
}

bool is_word(const Json& value, std::string_view words) {
  const auto number = as_count(value);
  const std::string word = value.is_string() ? value.get<std::string>()
                           : number          ? fmt::format("{}", *number)
                                             : "";
  for (size_t end; !words.empty(); words.remove_prefix(std::min(end + 1, words.size()))) {
    end = std::min(words.find(' '), words.size());
    if (words.substr(0, end) == word) return true;
  }
  return false;
}

class PropertyCheck {
 public:
  PropertyCheck(const Json& document, GltfBreaches& breaches) : document_(document), breaches_(breaches) {}

  // The recursion goes only as deep as the table.
  void check_object(const Json& object, const std::string& location, Members table) {
    const std::string before = location.empty() ? "" : location + ".";
    if (object.empty() && table[0].name == "*") empty(location);
    for (const auto& [key, value] : object.items()) {
      if (key == "extras") continue;
      const std::string here = before + printable(key);
      if (key == "extensions") {
        check_extensions(value, here, table);
      } else if (const Property* row = key == "name" ? &name_of_object : find(table, key, false)) {
        check_value(value, here, *row);
      } else {
        breaches_.add("properties that glTF does not define, left out", here);
      }
    }
    for (const Property& row : table) {
      if (row.required && !object.contains(row.name))
        breaches_.add("properties that glTF requires and the file lacks",
                      fmt::format("{}{}", before, row.name));
    }
  }

 private:
  void check_extensions(const Json& extensions, const std::string& location, Members table) {
    if (!extensions.is_object()) return mismatch(location);
    for (const auto& [name, value] : extensions.items()) {
      const std::string here = location + "." + printable(name);
      if (const Property* row = find(table, name, true)) {
        check_value(value, here, *row);
      } else if (is_read(name)) {
        breaches_.add("extensions of objects to which they do not apply, left out", here);
      }
    }
  }

  void check_value(const Json& value, const std::string& here, const Property& row) {
    if (!row.list) return check_single(value, here, row);
    if (!value.is_array()) return mismatch(here);
    const double length = static_cast<double>(value.size());
    if (length == 0) return empty(here);
    if (length < row.least || length > row.most) out_of_range(here);
    for (size_t i = 0; i < value.size(); ++i) {
      if (row.type == Type::number && value[i].is_number())
        continue;  // saves the text of a position in most lists
      check_single(value[i], fmt::format("{}[{}]", here, i), row);
    }
    if (row.type != Type::index && row.type != Type::text) return;
    std::vector<Json> sorted(value.begin(), value.end());
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end())
      breaches_.add("lists that contain the same element twice", here);
  }

  // Checks a value that is no list, or an element of a list.
  void check_single(const Json& value, const std::string& here, const Property& row) {
    switch (row.type) {
      case Type::object:
        return value.is_object() ? check_object(value, here, {row.members, row.member_count})
                                 : mismatch(here);
      case Type::index:
        return as_count(value) ? check_index(*as_count(value), here, row.of) : mismatch(here);
      case Type::count:
        if (!as_count(value)) return mismatch(here);
        return *as_count(value) < row.least ? out_of_range(here) : void();
      case Type::number:
        return value.is_number() ? void() : mismatch(here);
      case Type::flag:
        return value.is_boolean() ? void() : mismatch(here);
      case Type::text:
        return value.is_string() ? void() : mismatch(here);
      case Type::word:
        return is_word(value, row.of) ? void() : out_of_range(here);
    }
  }

  void check_index(double index, const std::string& here, std::string_view list) {
    const auto found = document_.find(list);
    if (found == document_.end() || !found->is_array() || index >= static_cast<double>(found->size()))
      breaches_.add("indices of objects that the file does not have", here);
  }

  void empty(const std::string& here) {
    breaches_.add("lists and objects that are empty, which glTF does not allow", here);
  }
  void mismatch(const std::string& here) {
    breaches_.add("values of another type than that of their property in glTF", here);
  }
  void out_of_range(const std::string& here) {
    breaches_.add("values that glTF does not allow for their property", here);
  }

  const Json& document_;
  GltfBreaches& breaches_;
};

}  // namespace

bool is_known_extension(std::string_view name) {
  return is_read(name) || is_listed(name, harmless_extensions);
}

void check_properties(const Json& document, GltfBreaches& breaches) {
  PropertyCheck(document, breaches).check_object(document, "", shapes::document);
}

}  // namespace eyeray::engine::importers
