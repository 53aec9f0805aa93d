#include "host/importers/import.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/input_file.hpp"
#include "host/image/coded_image.hpp"
#include "host/importers/formats.hpp"
#include "host/importers/malformed.hpp"
#include "host/materials/make.hpp"

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

ImportedScene read_mesh_file(MeshFile& file) {
  const Reader read = find_reader(file.name);
  if (!read) throw malformed(file.name, fmt::format("a mesh file's name must end in {}", mesh_endings));
  if (is_utf16(file.bytes)) throw malformed(file.name, "it is text in UTF-16: save it as UTF-8");
  drop_byte_order_mark(file.bytes);
  ImportedScene scene;
  try {
    scene = read(file);
  } catch (const image::TooManyPixels& error) {
    throw malformed(file.name, error.what());
  }
  drop_empty(scene);
  if (scene.instances.empty() && scene.clouds.empty() && !scene.played) {
    std::string why = "it has no visible triangles or points";
    for (const std::string& warning : scene.warnings) why += "; " + warning;
    throw malformed(file.name, why);
  }
  return scene;
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& file) {
  return find_reader(file) != nullptr;
}

ImportedScene import_file(const std::filesystem::path& file, const ImportOptions& options) {
  image::PixelBudget own;
  MeshFile source{file.string(),
                  read_input_file(file, "the mesh", most_mesh_bytes),
                  options.smooth,
                  AssetFiles(file, options.allowed_folders),
                  options.pixels ? options.pixels : &own,
                  options.playing,
                  options.point_size};
  ImportedScene scene = read_mesh_file(source);
  scene.files = source.assets.files();
  scene.files.insert(scene.files.begin(), file);
  return scene;
}

ImportedScene import_bytes(std::string bytes, const std::string& name, const ImportOptions& options) {
  image::PixelBudget own;
  MeshFile source{name,
                  std::move(bytes),
                  options.smooth,
                  {},
                  options.pixels ? options.pixels : &own,
                  options.playing,
                  options.point_size};
  return read_mesh_file(source);
}

std::unique_ptr<Material> plain_material(bool colored) {
  auto material = materials::make_phong({.diffuse = textures::make_constant(Vec3(colored ? 1.0 : 0.75))});
  material->name = colored ? "colored" : "plain";
  return material;
}

}  // namespace eyeray::engine::importers
