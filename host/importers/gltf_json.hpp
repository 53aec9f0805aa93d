// The JSON of a glTF file. It is not trusted: each value is read by name and checked. Private to the
// importers. Source: Khronos Group: glTF 2.0 Specification (2.0.1).
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace eyeray::engine::importers {

// An object of the document, and its position there. Any fault in the object is an InputError with that
// position. The document and the file's name must outlive this object.
class GltfObject {
 public:
  GltfObject(const nlohmann::json& json, std::string location, const std::string& file);

  bool has(const char* key) const { return find(key) != nullptr; }
  std::vector<std::string> keys() const;
  // A finite number, or the fallback if the key is not written.
  double number(const char* key, double fallback) const;
  // An integer of at least 0, or the fallback if the key is not written.
  uint64_t count(const char* key, uint64_t fallback) const;
  // An index into a list of the document that has `size` elements; nothing if the key is not written.
  std::optional<size_t> index(const char* key, size_t size) const;
  bool flag(const char* key) const;         // false if it is not written
  std::string text(const char* key) const;  // "" if it is not written
  // The numbers of a list, which must be as many as those of the fallback. Without a list, the fallback.
  std::vector<double> numbers(const char* key, std::vector<double> fallback) const;
  // The numbers of a list of any length; empty if there is no list.
  std::vector<double> numbers(const char* key) const;
  std::optional<GltfObject> object(const char* key) const;
  // Access to a list of objects, of indices or of strings; it is empty if it is not written.
  size_t size(const char* key) const;
  GltfObject element(const char* key, size_t i) const;
  std::vector<size_t> indices(const char* key, size_t size) const;
  std::vector<std::string> texts(const char* key) const;
  // The names of a list's objects; "" for one without a name.
  std::vector<std::string> names(const char* key) const;
  // The object of an extension.
  std::optional<GltfObject> extension(const char* name) const;

  const std::string& location() const { return location_; }
  [[noreturn]] void fail(const std::string& message) const;

 private:
  const nlohmann::json* find(const char* key) const;
  [[noreturn]] void mismatch(const char* key, std::string_view what) const;
  const nlohmann::json& list(const char* key) const;

  const nlohmann::json* json_;
  std::string location_;  // "accessors[3]"; "" for the document
  const std::string* file_;
};

// The names of all extensions that objects of the document have, except within `extras`.
std::set<std::string> extensions_of_objects(const nlohmann::json& document);

// The document. InputError for text that is no JSON, is nested too deep, has more than 2^24 values, or is no
// glTF 2.
nlohmann::json parse_gltf_json(std::string_view text, const std::string& file);

}  // namespace eyeray::engine::importers
