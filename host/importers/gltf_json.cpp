#include "host/importers/gltf_json.hpp"

#include <cmath>

#include "host/core/diagnostic_log.hpp"
#include "host/importers/json_text.hpp"
#include "host/importers/malformed.hpp"

namespace eyeray::engine::importers {

namespace {

using Json = nlohmann::json;

// The value if it is an integer from 0 to 2^53, which a double holds exactly; else nothing.
std::optional<uint64_t> as_count(const Json& json) {
  if (!json.is_number()) return std::nullopt;
  const double value = json.get<double>();
  if (!(value >= 0 && value <= 0x1p53) || value != std::trunc(value)) return std::nullopt;
  return static_cast<uint64_t>(value);
}

// True if a reader of glTF 2.0 may read a file that requires `version`: "MAJOR.MINOR", up to 2.0.
bool is_readable(std::string_view version) {
  return version == "2.0" || version.starts_with("1.") || version.starts_with("0.");
}

}  // namespace

GltfObject::GltfObject(const Json& json, std::string location, const std::string& file)
    : json_(&json), location_(std::move(location)), file_(&file) {
  if (!json.is_object()) fail("must be an object");
}

void GltfObject::fail(const std::string& message) const {
  throw malformed(*file_,
                  printable(fmt::format("{} {}", location_.empty() ? "the document" : location_, message)));
}

void GltfObject::mismatch(const char* key, std::string_view what) const {
  throw malformed(*file_,
                  fmt::format("{}{}{} must be {}", location_, location_.empty() ? "" : ".", key, what));
}

const Json* GltfObject::find(const char* key) const {
  const auto found = json_->find(key);
  return found == json_->end() ? nullptr : &*found;
}

std::vector<std::string> GltfObject::keys() const {
  std::vector<std::string> all;
  for (const auto& [key, value] : json_->items()) all.push_back(key);
  return all;
}

double GltfObject::number(const char* key, double fallback) const {
  const Json* value = find(key);
  if (!value) return fallback;
  if (!value->is_number()) mismatch(key, "a number");
  return value->get<double>();
}

uint64_t GltfObject::count(const char* key, uint64_t fallback) const {
  const Json* value = find(key);
  if (!value) return fallback;
  const auto count = as_count(*value);
  if (!count) mismatch(key, "an integer of at least 0");
  return *count;
}

std::optional<size_t> GltfObject::index(const char* key, size_t size) const {
  const Json* value = find(key);
  if (!value) return std::nullopt;
  const auto index = as_count(*value);
  if (!index || *index >= size) mismatch(key, fmt::format("an index below {}", size));
  return *index;
}

bool GltfObject::flag(const char* key) const {
  const Json* value = find(key);
  if (!value) return false;
  if (!value->is_boolean()) mismatch(key, "true or false");
  return value->get<bool>();
}

std::string GltfObject::text(const char* key) const {
  const Json* value = find(key);
  if (!value) return "";
  if (!value->is_string()) mismatch(key, "a string");
  return value->get<std::string>();
}

const Json& GltfObject::list(const char* key) const {
  static const Json empty = Json::array();
  const Json* value = find(key);
  if (!value) return empty;
  if (!value->is_array()) mismatch(key, "a list");
  return *value;
}

std::vector<double> GltfObject::numbers(const char* key, std::vector<double> fallback) const {
  if (!has(key)) return fallback;
  const Json& values = list(key);
  if (values.size() != fallback.size()) mismatch(key, fmt::format("a list of {} numbers", fallback.size()));
  for (size_t i = 0; i < values.size(); ++i) {
    if (!values[i].is_number()) mismatch(key, fmt::format("a list of {} numbers", fallback.size()));
    fallback[i] = values[i].get<double>();
  }
  return fallback;
}

std::vector<double> GltfObject::numbers(const char* key) const {
  return numbers(key, std::vector<double>(size(key)));
}

std::optional<GltfObject> GltfObject::object(const char* key) const {
  const Json* value = find(key);
  if (!value) return std::nullopt;
  return GltfObject(*value, location_.empty() ? key : fmt::format("{}.{}", location_, key), *file_);
}

size_t GltfObject::size(const char* key) const {
  return list(key).size();
}

GltfObject GltfObject::element(const char* key, size_t i) const {
  return {list(key).at(i), fmt::format("{}{}{}[{}]", location_, location_.empty() ? "" : ".", key, i),
          *file_};
}

std::vector<size_t> GltfObject::indices(const char* key, size_t size) const {
  std::vector<size_t> all;
  for (const Json& value : list(key)) {
    const auto index = as_count(value);
    if (!index || *index >= size) mismatch(key, fmt::format("a list of indices below {}", size));
    all.push_back(*index);
  }
  return all;
}

std::vector<std::string> GltfObject::names(const char* key) const {
  std::vector<std::string> all;
  for (size_t i = 0; i < size(key); ++i) all.push_back(element(key, i).text("name"));
  return all;
}

std::vector<std::string> GltfObject::texts(const char* key) const {
  std::vector<std::string> all;
  for (const Json& value : list(key)) {
    if (!value.is_string()) mismatch(key, "a list of strings");
    all.push_back(value.get<std::string>());
  }
  return all;
}

std::optional<GltfObject> GltfObject::extension(const char* name) const {
  const auto extensions = object("extensions");
  return extensions ? extensions->object(name) : std::nullopt;
}

// This recursion is safe: parse_gltf_json limits the depth of the document.
std::set<std::string> extensions_of_objects(const Json& document) {
  std::set<std::string> names;
  for (const auto& [key, value] : document.items()) {
    if (key == "extras" || !value.is_structured()) continue;
    if (key == "extensions" && value.is_object())
      for (const auto& [name, extension] : value.items()) names.insert(name);
    names.merge(extensions_of_objects(value));
  }
  return names;
}

Json parse_gltf_json(std::string_view text, const std::string& file) {
  check_json_text(text, file);
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw malformed_at(file, text, error.byte > 0 ? error.byte - 1 : 0, "this is not JSON");
  } catch (const Json::exception&) {
    throw malformed(file, "its JSON has a number that is out of range");
  }
  const GltfObject document(json, "", file);
  const auto asset = document.object("asset");
  const std::string version = asset ? asset->text("version") : "";
  if (!version.starts_with("2."))
    throw malformed(file, fmt::format("it is not glTF 2: its asset.version is \"{}\"", printable(version)));
  if (asset->has("minVersion") && !is_readable(asset->text("minVersion")))
    throw malformed(file, fmt::format("it requires glTF {} (asset.minVersion), but eyeray reads 2.0",
                                      printable(asset->text("minVersion"))));
  return json;
}

}  // namespace eyeray::engine::importers
