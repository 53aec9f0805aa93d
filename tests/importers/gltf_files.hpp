// Small glTF files, made by tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "bytes.hpp"
#include "support.hpp"

namespace eyeray::engine::test {

using Json = nlohmann::json;

inline std::string base64(const std::string& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](size_t k) { return k < bytes.size() ? uint32_t(uint8_t(bytes[k])) : 0u; };
    const uint32_t bits = at(i) << 16 | at(i + 1) << 8 | at(i + 2);
    for (size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

// A file of one mesh, one node and one buffer, which tests change and extend.
class GltfFile {
 public:
  Json json = {{"asset", {{"version", "2.0"}}},
               {"scenes", {{{"nodes", {0}}}}},
               {"scene", 0},
               {"nodes", {{{"mesh", 0}}}},
               {"meshes", {{{"primitives", {{{"attributes", Json::object()}}}}}}},
               {"bufferViews", Json::array()},
               {"accessors", Json::array()}};
  std::vector<Json> more_buffers;  // after the one that the bytes are in

  // Adds an accessor of the numbers, stored as the component type, in a separate bufferView and with their
  // bounds; returns its index. Vectors begin at multiples of 4 bytes.
  int add(const std::vector<double>& numbers, int component, const char* type, size_t components,
          bool normalized = false) {
    const size_t size = component < 5122 ? 1 : component < 5125 ? 2 : 4;
    const size_t padded = components == 1 ? 1 : (components * size + 3) / 4 * 4 / size;
    std::vector<double> stored, least(components, double(INFINITY)), most(components, -double(INFINITY));
    for (size_t i = 0; i < numbers.size(); ++i) {
      stored.push_back(component == 5126 ? double(float(numbers[i])) : numbers[i]);
      least[i % components] = std::min(least[i % components], stored.back());
      most[i % components] = std::max(most[i % components], stored.back());
      if ((i + 1) % components == 0) stored.resize((i + 1) / components * padded);
    }
    const int view = add_view(stored, component);
    if (padded > components) json["bufferViews"].back()["byteStride"] = padded * size;
    Json accessor = {{"bufferView", view},
                     {"componentType", component},
                     {"type", type},
                     {"count", numbers.size() / components},
                     {"normalized", normalized}};
    const auto finite = [](double number) { return std::isfinite(number); };
    if (std::ranges::all_of(numbers, finite) && numbers.size() >= components) {
      accessor["min"] = least;
      accessor["max"] = most;
    }
    json["accessors"].push_back(accessor);
    return int(json["accessors"].size()) - 1;
  }
  int add_view(const std::vector<double>& numbers, int component) {
    static const std::map<int, std::string> names = {{5120, "char"},   {5121, "uchar"}, {5122, "short"},
                                                     {5123, "ushort"}, {5125, "uint"},  {5126, "float"}};
    while (data_.text().size() % 4 != 0) data_.add(char(0));
    const size_t offset = data_.text().size();
    for (const double number : numbers) data_.add_as(names.at(component), number);
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", data_.text().size() - offset}});
    return int(json["bufferViews"].size()) - 1;
  }
  int add_view(const std::string& bytes) {
    const int view = add_view({}, 5121);
    for (const char byte : bytes) data_.add(byte);
    json["bufferViews"][size_t(view)]["byteLength"] = bytes.size();
    return view;
  }
  void add_positions(const std::vector<double>& xyz) {
    primitive()["attributes"]["POSITION"] = add(xyz, 5126, "VEC3", 3);
  }
  Json& primitive() { return json["meshes"][0]["primitives"][0]; }

  std::string data() const { return data_.text(); }
  // The file's bytes, with the buffer as a data URI, as a file's name, or as the chunk of a .glb.
  std::string gltf() const { return gltf("data:application/octet-stream;base64," + base64(data_.text())); }
  std::string gltf(const std::string& uri) const {
    Json whole = declared();
    whole["buffers"] = {{{"byteLength", data_.text().size()}, {"uri", uri}}};
    for (const Json& buffer : more_buffers) whole["buffers"].push_back(buffer);
    return whole.dump();
  }
  std::string glb() const {
    Json whole = declared();
    whole["buffers"] = {{{"byteLength", data_.text().size()}}};
    for (const Json& buffer : more_buffers) whole["buffers"].push_back(buffer);
    std::string text = whole.dump();
    while (text.size() % 4 != 0) text += ' ';
    std::string binary = data_.text();
    while (binary.size() % 4 != 0) binary += '\0';
    Bytes bytes;
    bytes.add(uint32_t(0x46546c67)).add(uint32_t(2)).add(uint32_t(28 + text.size() + binary.size()));
    bytes.add(uint32_t(text.size())).add(uint32_t(0x4e4f534a));
    Bytes chunk;
    chunk.add(uint32_t(binary.size())).add(uint32_t(0x004e4942));
    return bytes.text() + text + chunk.text() + binary;
  }

 private:
  // The JSON with its extensions in extensionsUsed, unless the test lists them itself.
  Json declared() const {
    Json whole = json;
    if (whole.contains("extensionsUsed")) return whole;
    std::set<std::string> names;
    const std::function<void(const Json&)> collect = [&](const Json& part) {
      for (const auto& [key, value] : part.items()) {
        if (key == "extensions")
          for (const auto& extension : value.items()) names.insert(extension.key());
        if (value.is_structured()) collect(value);
      }
    };
    collect(whole);
    if (!names.empty()) whole["extensionsUsed"] = names;
    return whole;
  }

  Bytes data_;
};

inline const std::vector<double> square_positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

// A square of two triangles in the plane z = 0.
inline GltfFile square_file() {
  GltfFile file;
  file.add_positions(square_positions);
  file.primitive()["indices"] = file.add({0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 1);
  return file;
}

// The square with a material.
inline GltfFile with_material(const Json& material) {
  GltfFile file = square_file();
  file.json["materials"] = Json::array({material});
  file.primitive()["material"] = 0;
  return file;
}

}  // namespace eyeray::engine::test
