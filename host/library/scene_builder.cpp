// Scenes built in code become the text of a scene file, and meshes become the bytes of .ply files. So there
// is one reader for all scenes, which trusts neither text nor bytes.
#include <eyeray/eyeray.hpp>

#include <array>
#include <cstring>

#include "host/library/engine_call.hpp"
#include "host/library/scene.hpp"
#include "host/library/toml_text.hpp"

namespace eyeray::engine::library {
namespace {

v0::Error wrong_length(const char* what, size_t length, const std::string& expected) {
  return {v0::ErrorKind::bad_input,
          fmt::format("a mesh's {} have {} numbers, not {}", what, length, expected)};
}

void check_lengths(const v0::MeshArrays& mesh) {
  if (mesh.positions.empty() || mesh.positions.size() % 3 != 0)
    throw wrong_length("positions", mesh.positions.size(), "three a vertex");
  if (mesh.triangles.empty() || mesh.triangles.size() % 3 != 0)
    throw wrong_length("triangles", mesh.triangles.size(), "three a triangle");
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size())
    throw wrong_length("normals", mesh.normals.size(),
                       fmt::format("{}, as positions", mesh.positions.size()));
  const size_t uv = mesh.positions.size() / 3 * 2;
  if (!mesh.uv.empty() && mesh.uv.size() != uv)
    throw wrong_length("uv", mesh.uv.size(), fmt::format("{}, two a vertex", uv));
}

template <typename Number>
char* put(char* to, std::span<const Number> numbers) {
  std::memcpy(to, numbers.data(), numbers.size_bytes());
  return to + numbers.size_bytes();
}

std::string ply(const v0::MeshArrays& mesh) {
  const size_t vertices = mesh.positions.size() / 3, triangles = mesh.triangles.size() / 3;
  std::string bytes = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", vertices);
  bytes += "property float x\nproperty float y\nproperty float z\n";
  if (!mesh.normals.empty()) bytes += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!mesh.uv.empty()) bytes += "property float u\nproperty float v\n";
  bytes += fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", triangles);

  const size_t vertex_bytes = 4 * (3u + (mesh.normals.empty() ? 0 : 3) + (mesh.uv.empty() ? 0 : 2));
  const size_t header = bytes.size();
  bytes.resize(header + vertices * vertex_bytes + triangles * 13);
  char* to = bytes.data() + header;
  for (size_t i = 0; i < vertices; ++i) {
    to = put(to, mesh.positions.subspan(3 * i, 3));
    if (!mesh.normals.empty()) to = put(to, mesh.normals.subspan(3 * i, 3));
    if (!mesh.uv.empty()) to = put(to, mesh.uv.subspan(2 * i, 2));
  }
  for (size_t i = 0; i < triangles; ++i) {
    *to++ = 3;
    to = put(to, mesh.triangles.subspan(3 * i, 3));
  }
  return bytes;
}

}  // namespace
}  // namespace eyeray::engine::library

namespace eyeray::inline v0 {

struct SceneBuilder::Data {
  std::string text;
  engine::loader::MemoryFiles meshes;
};

SceneBuilder::SceneBuilder() : data_(std::make_unique<Data>()) {}
SceneBuilder::~SceneBuilder() = default;
SceneBuilder::SceneBuilder(SceneBuilder&&) noexcept = default;
SceneBuilder& SceneBuilder::operator=(SceneBuilder&&) noexcept = default;

SceneBuilder& SceneBuilder::set(std::string_view section, const Table& table) {
  data_->text += fmt::format("[{}]\n{}\n", engine::library::key_text(section), engine::library::lines(table));
  return *this;
}

SceneBuilder& SceneBuilder::add(std::string_view section, const Table& table) {
  data_->text +=
      fmt::format("[[{}]]\n{}\n", engine::library::key_text(section), engine::library::lines(table));
  return *this;
}

SceneBuilder& SceneBuilder::add_mesh(const MeshArrays& arrays, const Table& table) {
  engine::library::check_lengths(arrays);
  const std::string name = fmt::format("mesh-{}.ply", data_->meshes.size());
  data_->meshes[name] = engine::library::ply(arrays);
  Table whole;
  whole.set("file", name);
  for (const auto& [key, value] : table.entries()) whole.set(key, value);
  return add("mesh", whole);
}

std::string SceneBuilder::text() const {
  return data_->text;
}

Scene SceneBuilder::scene(std::string_view name, const SceneOptions& options) const {
  return engine::library::parse(data_->text, name, options, data_->meshes);
}

}  // namespace eyeray::inline v0
