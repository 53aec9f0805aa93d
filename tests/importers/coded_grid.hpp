// A hilly grid of triangles as plain glTF, coded by meshoptimizer, and coded by Draco.
#pragma once

#include <draco/compression/expert_encode.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>

#include "gltf_files.hpp"

namespace eyeray::engine::test {

inline constexpr int grid_side = 12;  // vertices

inline double height(double x, double y) {
  return 0.3 * std::sin(3 * x) * std::cos(2 * y);
}
inline Vec3 normal_at(double x, double y) {
  return glm::normalize(
      Vec3(-0.9 * std::cos(3 * x) * std::cos(2 * y), 0.6 * std::sin(3 * x) * std::sin(2 * y), 1));
}

struct Grid {
  std::vector<double> positions, normals, uv, indices;
};
// A grid over x and y from 0 to 1, which are its uv too. Its vertices are unique.
inline Grid hilly_grid(int side = grid_side) {
  Grid grid;
  const auto add = [](std::vector<double>& to, const auto& vector) {
    for (int i = 0; i < vector.length(); ++i) to.push_back(vector[i]);
  };
  for (int i = 0; i < side * side; ++i) {
    const Vec2 at = Vec2(i % side, i / side) / double(side - 1);
    add(grid.positions, Vec3(at, height(at.x, at.y)));
    add(grid.normals, normal_at(at.x, at.y));
    add(grid.uv, at);
  }
  for (int i = 0; i + side < side * side; ++i) {
    if (i % side == side - 1) continue;
    for (const int corner : {i, i + 1, i + side, i + side, i + 1, i + side + 1})
      grid.indices.push_back(corner);
  }
  return grid;
}

inline GltfFile grid_file(int index_component = 5123) {
  const Grid grid = hilly_grid();
  GltfFile file;
  file.add_positions(grid.positions);
  file.primitive()["attributes"]["NORMAL"] = file.add(grid.normals, 5126, "VEC3", 3);
  file.primitive()["attributes"]["TEXCOORD_0"] = file.add(grid.uv, 5126, "VEC2", 2);
  file.primitive()["indices"] = file.add(grid.indices, index_component, "SCALAR", 1);
  return file;
}

// Checks that the scene is the grid, each vertex within the tolerance.
inline void check_grid(const importers::ImportedScene& scene, double tolerance, int side = grid_side) {
  REQUIRE(scene.meshes.size() == 1);
  const Mesh& mesh = scene.meshes[0];
  CHECK(mesh.triangles.size() == size_t(2 * (side - 1) * (side - 1)));
  CHECK(mesh.positions.size() == size_t(side * side));
  REQUIRE(mesh.normals.size() == mesh.positions.size());
  REQUIRE(mesh.uv.size() == mesh.positions.size());
  double worst = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 p = mesh.positions[i];
    const Vec2 uv(mesh.uv[i].x, 1 - mesh.uv[i].y);
    worst = std::max({worst, std::abs(p.z - height(p.x, p.y)), glm::length(uv - Vec2(p)),
                      glm::length(mesh.normals[i] - normal_at(p.x, p.y))});
  }
  CHECK(worst < tolerance);
  CHECK(signed_area(mesh, {0, 0, 1}) == doctest::Approx(2).epsilon(tolerance));
  CHECK(scene.warnings.empty());
}

struct MeshoptCoding {
  std::string mode = "ATTRIBUTES";
  size_t stride = 0;  // bytes of an element
  std::string filter = "";
  std::string name = "EXT_meshopt_compression";
};

// The bytes of elements, as the library codes them.
inline std::string meshopt_code(const std::string& bytes, const MeshoptCoding& coding) {
  const size_t count = bytes.size() / coding.stride;
  std::string coded(1 << 16, '\0');
  auto* to = reinterpret_cast<unsigned char*>(coded.data());
  if (coding.mode == "ATTRIBUTES") {
    coded.resize(meshopt_encodeVertexBuffer(to, coded.size(), bytes.data(), count, coding.stride));
    return coded;
  }
  std::vector<unsigned> indices;
  for (size_t i = 0; i < count; ++i) {
    unsigned index = 0;
    std::memcpy(&index, bytes.data() + i * coding.stride, coding.stride);
    indices.push_back(index);
  }
  coded.resize(coding.mode == "TRIANGLES"
                   ? meshopt_encodeIndexBuffer(to, coded.size(), indices.data(), count)
                   : meshopt_encodeIndexSequence(to, coded.size(), indices.data(), count));
  return coded;
}

// Makes the coded `bytes` the view's data: the view itself then refers to a buffer that does not exist.
inline Json& code_view(GltfFile& file, int index, const std::string& bytes, const MeshoptCoding& coding) {
  const std::string coded = meshopt_code(bytes, coding);
  const Json coded_view = file.json["bufferViews"][size_t(file.add_view(coded))];
  file.json["bufferViews"].erase(file.json["bufferViews"].size() - 1);
  Json& view = file.json["bufferViews"][size_t(index)];
  view = {{"buffer", 1}, {"byteOffset", 0}, {"byteLength", bytes.size()}};
  Json& extension = view["extensions"][coding.name];
  extension = {
      {"buffer", 0},         {"byteOffset", coded_view["byteOffset"]}, {"byteLength", coded.size()},
      {"mode", coding.mode}, {"count", bytes.size() / coding.stride},  {"byteStride", coding.stride}};
  if (!coding.filter.empty()) extension["filter"] = coding.filter;
  if (file.more_buffers.empty()) file.more_buffers.push_back({{"byteLength", 1 << 20}});
  file.json["extensionsRequired"] = file.json["extensionsUsed"] = {coding.name};
  return extension;
}

// The bytes that a view of the file has, before it is coded.
inline std::string view_bytes(const GltfFile& file, int index) {
  const Json& view = file.json["bufferViews"][size_t(index)];
  return file.data().substr(view["byteOffset"], view["byteLength"]);
}

// The grid with all of its views coded; only the accessors of the plain grid are left.
inline GltfFile meshopt_grid(const std::string& index_mode = "TRIANGLES", int index_component = 5123,
                             const std::string& name = "EXT_meshopt_compression") {
  const GltfFile plain = grid_file(index_component);
  GltfFile file;
  file.json = plain.json;
  for (int view = 0; view < 3; ++view)
    code_view(file, view, view_bytes(plain, view), {"ATTRIBUTES", view == 2 ? 8u : 12u, "", name});
  code_view(file, 3, view_bytes(plain, 3), {index_mode, index_component == 5123 ? 2u : 4u, "", name});
  return file;
}

struct DracoCoding {
  int method = draco::MESH_EDGEBREAKER_ENCODING;
  int speed = 5;
  bool quantized = true;
  bool metadata = false;
};

// Builds a Draco mesh; each attribute has one value for each vertex.
class DracoMesh {
 public:
  explicit DracoMesh(const Grid& grid) {
    mesh_.set_num_points(unsigned(grid.positions.size() / 3));
    for (size_t i = 0; i < grid.indices.size(); i += 3) {
      draco::Mesh::Face face;
      for (size_t k = 0; k < 3; ++k) face[k] = unsigned(grid.indices[i + k]);
      mesh_.AddFace(face);
    }
  }

  // Adds an attribute, and returns its unique id.
  template <typename T>
  unsigned add(draco::GeometryAttribute::Type type, draco::DataType data, const std::vector<double>& numbers,
               bool normalized = false) {
    const auto components = numbers.size() / mesh_.num_points();
    draco::GeometryAttribute attribute;
    attribute.Init(type, nullptr, uint8_t(components), data, normalized, int64_t(components * sizeof(T)), 0);
    const int id = mesh_.AddAttribute(attribute, true, mesh_.num_points());
    for (unsigned i = 0; i < mesh_.num_points(); ++i) {
      std::vector<T> value;
      for (size_t k = 0; k < components; ++k) value.push_back(T(numbers[i * components + k]));
      mesh_.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), value.data());
    }
    return mesh_.attribute(id)->unique_id();
  }

  std::string code(const DracoCoding& coding) {
    if (coding.metadata) {
      auto metadata = std::make_unique<draco::GeometryMetadata>();
      metadata->AddEntryString("name", "hill");
      auto branch = std::make_unique<draco::Metadata>();
      branch->AddEntryInt("age", 7);
      metadata->AddSubMetadata("branch", std::move(branch));
      mesh_.AddMetadata(std::move(metadata));
    }
    draco::ExpertEncoder encoder(mesh_);
    encoder.SetEncodingMethod(coding.method);
    encoder.SetSpeedOptions(coding.speed, coding.speed);
    for (int i = 0; i < mesh_.num_attributes() && coding.quantized; ++i)
      encoder.SetAttributeQuantization(i, mesh_.attribute(i)->data_type() == draco::DT_FLOAT32 ? 12 : -1);
    draco::EncoderBuffer buffer;
    REQUIRE(encoder.EncodeToBuffer(&buffer).ok());
    return {buffer.data(), buffer.size()};
  }

 private:
  draco::Mesh mesh_;
};

// Makes `data` the source of the primitive's attributes (name to unique id); their accessors lose their
// views.
inline void code_primitive(GltfFile& file, const std::string& data, const Json& attributes) {
  Json& primitive = file.primitive();
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", file.add_view(data)},
                                                           {"attributes", attributes}};
  for (const auto& [name, id] : attributes.items())
    file.json["accessors"][primitive["attributes"][name].get<size_t>()].erase("bufferView");
  file.json["accessors"][primitive["indices"].get<size_t>()].erase("bufferView");
  file.json["extensionsRequired"] = file.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
}

inline std::string draco_grid_data(const DracoCoding& coding, const Grid& grid) {
  DracoMesh mesh(grid);
  mesh.add<float>(draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, grid.positions);
  mesh.add<float>(draco::GeometryAttribute::NORMAL, draco::DT_FLOAT32, grid.normals);
  mesh.add<float>(draco::GeometryAttribute::TEX_COORD, draco::DT_FLOAT32, grid.uv);
  return mesh.code(coding);
}

// The grid with its attributes and indices coded by Draco; only the accessors of the plain grid are left.
inline GltfFile draco_grid(const DracoCoding& coding = {}) {
  const Grid grid = hilly_grid();
  GltfFile file;
  file.json = grid_file().json;
  file.json["bufferViews"] = Json::array();
  code_primitive(file, draco_grid_data(coding, grid), {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}});
  return file;
}

}  // namespace eyeray::engine::test
