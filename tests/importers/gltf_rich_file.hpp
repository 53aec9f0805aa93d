// A glTF file that keeps all rules, for tests that break them one by one.
#pragma once

#include <functional>
#include <span>

#include "gltf_files.hpp"

namespace eyeray::engine::test {

// The accessors of the file below, in order.
enum Accessor { positions, indices, normals, uv, joints, weights, bind_matrices, target };

inline const std::vector<double> identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

// A square with everything that the rules concern; it breaks none of them.
inline GltfFile rich_file() {
  GltfFile file = square_file();
  Json& attributes = file.primitive()["attributes"];
  attributes["NORMAL"] = file.add({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 3);
  attributes["TEXCOORD_0"] = file.add({0, 0, 1, 0, 1, 1, 0, 1}, 5126, "VEC2", 2);
  attributes["JOINTS_0"] = file.add(std::vector<double>(16, 0), 5121, "VEC4", 4);
  attributes["WEIGHTS_0"] = file.add({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5126, "VEC4", 4);
  const int bind = file.add(identity, 5126, "MAT4", 16);
  file.primitive()["targets"] = {{{"POSITION", file.add(std::vector<double>(12, 0.5), 5126, "VEC3", 3)}}};
  file.json["meshes"][0]["weights"] = {1};
  file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"children", {1}}}, {{"rotation", {0, 0, 0, 1}}}};
  file.json["skins"] = {{{"joints", {1}}, {"inverseBindMatrices", bind}}};
  file.json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0}}}}};
  file.primitive()["material"] = 0;
  return file;
}

// The message of the file's refusal, or the file's warnings, or "".
inline std::string message_of(const GltfFile& file) {
  const std::string refused = refusal(file.gltf(), "a.gltf");
  if (refused != "accepted") return refused;
  std::string all;
  for (const std::string& warning : import_sound(file.gltf(), "a.gltf").warnings)
    all += (all.empty() ? "" : "; ") + warning;
  return all;
}

// A way of breaking a rule, and the resulting message: a row of a table.
struct Rule {
  std::string name;
  std::function<void(GltfFile&)> breach;
  std::string message;
};

inline std::function<void(GltfFile&)> set(const char* pointer, const Json& value) {
  return [=](GltfFile& file) { file.json[Json::json_pointer(pointer)] = value; };
}
inline std::function<void(GltfFile&)> erase(const char* parent, const char* key) {
  return [=](GltfFile& file) { file.json[Json::json_pointer(parent)].erase(key); };
}
// The attribute made of other numbers.
inline std::function<void(GltfFile&)> attribute(const char* name, const std::vector<double>& numbers,
                                                int component, const char* type, size_t components,
                                                bool normalized = false) {
  return [=](GltfFile& file) {
    file.primitive()["attributes"][name] = file.add(numbers, component, type, components, normalized);
  };
}

const std::string attributes_at = "meshes[0].primitives[0].attributes";

// Breaks each rule in a separate file.
inline void check_rules(std::span<const Rule> table) {
  for (const Rule& rule : table) {
    GltfFile file = rich_file();
    rule.breach(file);
    CAPTURE(rule.name);
    CHECK(message_of(file) == rule.message);
  }
}

}  // namespace eyeray::engine::test
