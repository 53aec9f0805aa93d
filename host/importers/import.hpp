// Reads mesh files as parts of a scene: Wavefront OBJ, PLY, STL, glTF 2.0, and points as PLY, XYZ and PCD.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "host/scene/point_cloud.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::image {
struct PixelBudget;  // image/coded_image.hpp
}

namespace eyeray::engine::importers {

// The animation to play, and the moment to show.
struct Playing {
  double seconds = 0;
  // The animation's name, or else its number, from 0; absent: the first. A file without such an animation is
  // shown at rest.
  std::optional<std::string> animation = {};
  bool loop = false;  // true: it begins again at 0 after its last key; false: it stays at that key

  auto operator<=>(const Playing&) const = default;
};

struct ImportOptions {
  // For a file without normals: the greatest angle, in degrees, between faces that are shaded as one smooth
  // surface; 0: flat. Absent: 40 for OBJ, PLY and STL; 0 for glTF, by its specification.
  std::optional<double> smooth = {};
  // Folders, beside the file's own folder tree, that may contain the files it names (materials, buffers,
  // pictures).
  std::vector<std::filesystem::path> allowed_folders = {};
  // The pixel budget of the scene that imports the file; null if there is no scene.
  image::PixelBudget* pixels = nullptr;
  Playing playing = {};
  // Diameter of the spheres that show points, in the file's units. Absent: it follows from their spacing.
  std::optional<double> point_size = {};
};

// An animation of a file, with its start and end in seconds.
struct PlayedAnimation {
  int values = 0;
  double first = 0, last = 0;
};

struct ImportedCamera {
  std::string name;  // empty if it has none
  Vec3 eye{0.0};
  Vec3 target{0.0};
  Vec3 up{0, 1, 0};
  std::variant<PerspectiveCamera, OrthographicCamera> form;
};

struct ImportedScene {
  std::vector<Mesh> meshes;         // keep the promises of scene/mesh.hpp
  std::vector<Instance> instances;  // `material` is an index of `materials`, or −1: the file names none
  std::vector<std::shared_ptr<const PointCloud>> clouds;  // points that no faces connect
  std::vector<std::unique_ptr<Material>> materials;
  std::vector<std::variant<PointLight, DirectionalLight, SpotLight>> lights;
  std::vector<ImportedCamera> cameras;  // in the order of the scene's nodes
  std::vector<std::string> animations;  // names of glTF's animations; "" for one without a name
  std::optional<PlayedAnimation> played;
  std::vector<std::string> warnings;         // among them the features left out, once each, with counts
  std::vector<std::filesystem::path> files;  // every file that was read, the mesh file first
};

// The endings of mesh files, for messages.
inline constexpr std::string_view mesh_endings = ".obj, .ply, .stl, .gltf, .glb, .xyz or .pcd";

// True if the name has a mesh file's ending, in upper or lower case.
bool is_mesh_file(const std::filesystem::path& file);

// Reads a mesh file by its ending, and the files it refers to. Error (file_io) if a file cannot be read.
// InputError, with the position if there is one, if its contents are wrong or nothing in it could be seen. An
// animated file may have nothing to see at its moment. The size of the files bounds the memory needed.
ImportedScene import_file(const std::filesystem::path& file, const ImportOptions& options = {});

// Imports a mesh file from memory, for scenes in memory and for tests. Messages contain `name`, whose ending
// determines the format of `bytes`. References to other files are refused.
ImportedScene import_bytes(std::string bytes, const std::string& name, const ImportOptions& options = {});

// The material of meshes whose file names none: a light grey, or white if vertices have colours.
std::unique_ptr<Material> plain_material(bool colored);

}  // namespace eyeray::engine::importers
