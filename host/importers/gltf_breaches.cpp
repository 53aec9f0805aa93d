#include "host/importers/gltf_breaches.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/diagnostic.hpp"
#include "host/importers/gltf_components.hpp"

namespace eyeray::engine::importers {

namespace {

// Limit on the positions that are remembered: a hostile file may have more, which would take far more memory
// than the file.
constexpr size_t most_locations = 65536;

// A set of component types: a bit for each type, and another bit for the normalized form of each.
using Types = uint32_t;

constexpr Types plain(uint64_t component) {
  return Types{1} << (component - signed_byte);
}
constexpr Types normalized(uint64_t component) {
  return plain(component) << 8;
}

constexpr Types any_float = plain(floating) | normalized(floating);
constexpr Types bytes_and_shorts =
    plain(signed_byte) | plain(unsigned_byte) | plain(signed_short) | plain(unsigned_short);
constexpr Types shares = any_float | normalized(unsigned_byte) | normalized(unsigned_short);
constexpr Types directions = normalized(signed_byte) | normalized(signed_short);

// The component types of an attribute. `core`: allowed by the specification, 3.7.2.1 and 3.11. `quantized`:
// added by KHR_mesh_quantization. `clear`: allowed by neither, but readable in only one way.
struct AttributeRule {
  std::string_view name;
  Types core;
  Types quantized = 0;
  Types clear = 0;
};
constexpr AttributeRule rules[] = {
    {"POSITION", any_float, bytes_and_shorts | bytes_and_shorts << 8},
    {"NORMAL", any_float, directions},
    {"TANGENT", any_float, directions},
    {"TEXCOORD_", shares, bytes_and_shorts | bytes_and_shorts << 8},
    {"COLOR_", shares, 0, directions},
    {"JOINTS_", plain(unsigned_byte) | plain(unsigned_short), 0, plain(unsigned_int)},
    {"WEIGHTS_", shares, 0, directions},
    {"times", any_float},
    {"translation", any_float},
    {"rotation", shares | directions},
    {"scale", any_float},
    {"weights", shares | directions},
};

}  // namespace

GltfBreaches::GltfBreaches(const GltfObject& document)
    : document_(document),
      quantization_declared_(std::ranges::count(document.texts("extensionsUsed"), "KHR_mesh_quantization") >
                             0) {}

void GltfBreaches::add(std::string_view kind, const std::string& location) {
  auto known = std::ranges::find(kinds_, kind, &Kind::name);
  if (known == kinds_.end()) known = kinds_.insert(known, {std::string(kind), location});
  if (known->locations.size() == most_locations || known->locations.insert(location).second) ++known->count;
}

void GltfBreaches::report(std::vector<std::string>& warnings) const {
  for (const Kind& kind : kinds_)
    warnings.push_back(fmt::format("{}: {}, the first {}", kind.name, kind.count, kind.first));
}

void GltfBreaches::check_attribute(std::string_view name, size_t index) {
  const auto rule =
      std::ranges::find_if(rules, [&](const AttributeRule& r) { return name.starts_with(r.name); });
  if (rule == std::end(rules)) return;
  const GltfObject accessor = document_.element("accessors", index);
  const uint64_t component = accessor.count("componentType", 0);
  if (bytes_of(component) == 0) return;  // the reader reports it
  const bool is_normalized = accessor.flag("normalized");
  const Types type = is_normalized ? normalized(component) : plain(component);
  if (type & (quantization_declared_ ? rule->core | rule->quantized : rule->core)) return;
  if (!(type & (rule->quantized | rule->clear))) {
    accessor.fail(fmt::format("contains {}, which cannot be {}componentType {}", name,
                              is_normalized ? "normalized " : "", component));
  }
  add("attributes of component types that glTF does not allow for them, read by their componentType",
      accessor.location());
}

void GltfBreaches::check_attribute_names(const GltfObject& attributes) {
  constexpr std::string_view sets[] = {"TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_"};
  for (const std::string& name : attributes.keys()) {
    const auto location = [&] { return attributes.location() + "." + printable(name); };
    // Skip the names that applications and extensions define.
    if (name.starts_with('_') || name.find(':') != std::string::npos) continue;
    if (name == "POSITION" || name == "NORMAL" || name == "TANGENT") continue;
    const auto set = std::ranges::find_if(sets, [&](std::string_view s) { return name.starts_with(s); });
    const std::string number = set == std::end(sets) ? "" : name.substr(set->size());
    const bool counted = !number.empty() && number.size() < 6 && (number == "0" || number[0] != '0') &&
                         std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; });
    if (!counted) {
      add("attributes whose names glTF does not define, left out", location());
    } else if (number != "0") {
      const std::string before = fmt::format("{}{}", *set, std::stoi(number) - 1);
      if (!attributes.has(before.c_str())) add("sets of attributes that are not counted from 0", location());
    }
  }
}

}  // namespace eyeray::engine::importers
