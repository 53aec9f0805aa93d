#include "host/importers/import.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "host/core/diagnostic_log.hpp"
#include "host/core/input_file.hpp"
#include "host/image/coded_image.hpp"
#include "host/importers/formats.hpp"
#include "host/importers/malformed.hpp"
#include "host/materials/make.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::importers {

namespace {

using Reader = ImportedScene (*)(MeshFile&);

// The reader for the file's ending; null for an ending of another format.
Reader find_reader(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (ending == ".obj") return import_obj;
  if (ending == ".ply") return import_ply;
  if (ending == ".stl") return import_stl;
  if (ending == ".off") return import_off;
  if (ending == ".3mf") return import_3mf;
  if (ending == ".xyz") return import_xyz;
  if (ending == ".pcd") return import_pcd;
  if (ending == ".gltf" || ending == ".glb") return import_gltf;
  return nullptr;
}

// Removes the meshes that have no triangle left.
void drop_empty(ImportedScene& scene) {
  std::vector<int> now(scene.meshes.size(), -1);
  int count = 0;
  for (size_t i = 0; i < now.size(); ++i) {
    if (!scene.meshes[i].triangles.empty()) now[i] = count++;
  }
  for (Instance& instance : scene.instances) instance.mesh = now[static_cast<size_t>(instance.mesh)];
  std::erase_if(scene.instances, [](const Instance& instance) { return instance.mesh < 0; });
  std::erase_if(scene.meshes, [](const Mesh& mesh) { return mesh.triangles.empty(); });
}

// The rotation that turns an axis to +y. It turns about z for ±x, else about x.
Mat3 turn_upright(UpAxis up) {
  switch (up) {
    case UpAxis::y:
      return Mat3(1.0);
    case UpAxis::z:
      return {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    case UpAxis::x:
      return {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};
    case UpAxis::minus_y:
      return {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    case UpAxis::minus_z:
      return {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
    case UpAxis::minus_x:
      return {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
  }
  return Mat3(1.0);
}

void turn_upright(ImportedScene& scene, UpAxis up) {
  const Mat3 turn = turn_upright(up);
  for (Instance& instance : scene.instances) instance.transform = Mat4(turn) * instance.transform;
  for (const ImportedPoints& points : scene.clouds) {
    for (Vec3& position : points.cloud->positions) position = turn * position;
    for (glm::vec3& normal : points.cloud->normals) normal = turn * Vec3(normal);
  }
  for (ImportedLines& lines : scene.lines)
    for (LineSegment& each : lines.segments) each = {turn * each.from, turn * each.to};
}

ImportedScene read_mesh_file(MeshFile& file) {
  const Reader read = find_reader(file.name);
  if (!read) throw malformed(file.name, fmt::format("a mesh file's name must end in {}", mesh_endings));
  if (read == import_gltf && file.options.up != UpAxis::y)
    throw malformed(file.name,
                    "+y is up in glTF, by its specification: leave `up` out; `transform` turns it");
  if (read == import_3mf) {
    if (file.options.up != UpAxis::y && file.options.up != UpAxis::z)
      throw malformed(file.name,
                      "+z is up in 3MF, by its specification: leave `up` out; `transform` turns it");
    file.options.up = UpAxis::z;
  }
  if (is_utf16(file.bytes)) throw malformed(file.name, "it is text in UTF-16: save it as UTF-8");
  drop_byte_order_mark(file.bytes);
  ImportedScene scene;
  try {
    scene = read(file);
  } catch (const image::TooManyPixels& error) {
    throw malformed(file.name, error.what());
  }
  drop_empty(scene);
  if (file.options.up != UpAxis::y) turn_upright(scene, file.options.up);
  if (scene.instances.empty() && scene.clouds.empty() && scene.lines.empty() && !scene.played) {
    std::string why = "it has no visible triangles, points or lines";
    for (const std::string& warning : scene.warnings) why += "; " + warning;
    throw malformed(file.name, why);
  }
  return scene;
}

}  // namespace

std::optional<size_t> find_named(std::span<const std::string> names, const std::string& wanted) {
  if (const auto named = std::ranges::find(names, wanted); named != names.end() && !wanted.empty())
    return size_t(named - names.begin());
  size_t number = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  const bool whole = error == std::errc() && end == wanted.data() + wanted.size();
  return whole && number < names.size() ? std::optional(number) : std::nullopt;
}

std::string list_names(std::span<const std::string> names) {
  constexpr size_t most = 16;
  std::vector<std::string> all;
  for (size_t i = 0; i < std::min(names.size(), most); ++i)
    all.push_back(names[i].empty() ? std::to_string(i) : fmt::format("\"{}\"", printable(names[i])));
  return fmt::format("{}{}", fmt::join(all, ", "), names.size() > most ? ", …" : "");
}

bool is_mesh_file(const std::filesystem::path& file) {
  return find_reader(file) != nullptr;
}

ImportedScene import_file(const std::filesystem::path& file, const ImportOptions& options,
                          std::span<const std::filesystem::path> folders, image::PixelBudget* pixels) {
  image::PixelBudget own;
  MeshFile source{file.string(), read_input_file(file, "the mesh", most_mesh_bytes), options,
                  AssetFiles(file, folders), pixels ? pixels : &own};
  ImportedScene scene = read_mesh_file(source);
  scene.files = source.assets.files();
  scene.files.insert(scene.files.begin(), file);
  return scene;
}

ImportedScene import_bytes(std::string bytes, const std::string& name, const ImportOptions& options,
                           image::PixelBudget* pixels) {
  image::PixelBudget own;
  MeshFile source{name, std::move(bytes), options, {}, pixels ? pixels : &own};
  return read_mesh_file(source);
}

std::unique_ptr<Material> plain_material(bool colored) {
  auto material = materials::make_phong({.diffuse = textures::make_constant(Vec3(colored ? 1.0 : 0.75))});
  material->name = colored ? "colored" : "plain";
  return material;
}

}  // namespace eyeray::engine::importers
