#include "classics.hpp"

#include "host/core/atomic_file.hpp"

namespace eyeray::engine::classics {
namespace {

// The mesh as OBJ text. Its numbers are float32, as renderers keep them.
std::string as_obj(const Mesh& mesh) {
  std::string text;
  for (const Vec3& p : mesh.positions)
    text += fmt::format("v {} {} {}\n", float(p.x), float(p.y), float(p.z));
  for (const Vec3& n : mesh.normals) text += fmt::format("vn {} {} {}\n", float(n.x), float(n.y), float(n.z));
  for (const auto& [a, b, c] : mesh.triangles)
    text += mesh.normals.empty() ? fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1)
                                 : fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", a + 1, b + 1, c + 1);
  return text;
}

}  // namespace

std::span<const Classic> all_classics() {
  static const Classic all[] = {tetra_classic, tree_classic,  rings_classic,
                                gears_classic, mount_classic, teapot_classic};
  return all;
}

void write(const Classic& classic, int size_factor, const std::filesystem::path& folder) {
  std::string scene = classic.scene(size_factor);
  if (classic.mesh) {
    write_file_atomically(folder / "mesh.obj", as_obj(classic.mesh(size_factor)));
    scene += fmt::format("\n[[mesh]]\nfile = \"mesh.obj\"\nmaterial = \"{}\"\nsmooth = 0\n",
                         classic.mesh_material);
  }
  write_file_atomically(folder / "scene.toml", scene);
}

}  // namespace eyeray::engine::classics
