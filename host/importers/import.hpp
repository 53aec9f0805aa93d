// Reads mesh files as parts of a scene: Wavefront OBJ, PLY, STL, OFF, 3MF, glTF 2.0, and points as PLY, XYZ
// and PCD.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "host/core/diagnostic.hpp"
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

// The axis that points up in a file's coordinates; it becomes +y.
enum class UpAxis { y, z, x, minus_y, minus_z, minus_x };
inline constexpr std::string_view up_names[] = {"y", "z", "x", "-y", "-z", "-x"};

// The shape of a point: a sphere, or a disk perpendicular to its normal.
enum class PointShape { sphere, disk };
inline constexpr std::string_view point_shape_names[] = {"sphere", "disk"};

// The way to read a file.
struct ImportOptions {
  // For a file without normals: the greatest angle, in degrees, between faces that are shaded as one smooth
  // surface; 0: flat. Absent: 40, but 0 for glTF, by its specification.
  std::optional<double> smooth = {};
  PointShape point_shape = PointShape::sphere;
  // Diameter of the spheres or disks that show points, in the file's units. Absent: it follows from their
  // spacing.
  std::optional<double> point_size = {};
  // Diameter of the capsules that show the lines of OBJ and glTF, in the file's units. Absent: lines are left
  // out.
  std::optional<double> line_width = {};
  UpAxis up = UpAxis::y;  // y for glTF, by its specification; that of 3MF is always z
  Playing playing = {};
  // The scene of a glTF file that is shown, and the variant of its materials (KHR_materials_variants). Each
  // by its name, or else by its number from 0. Absent, or if the file has none of that name: its default.
  std::optional<std::string> gltf_scene = {}, variant = {};

  auto operator<=>(const ImportOptions&) const = default;
};

// The index of the name that is `wanted`; of several, the first. If there is none, `wanted` may be an index,
// in digits. Empty if it is neither.
std::optional<size_t> find_named(std::span<const std::string> names, const std::string& wanted);

// The names as a list for messages, the first 16 of them: `"red", 1, "blue"`. One without a name has its
// index.
std::string list_names(std::span<const std::string> names);

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
  std::optional<Diagnostic> fault = {};  // the reason why it cannot be used; then only its name counts
};

// Points that no faces connect. `material`: as in instances.
struct ImportedPoints {
  std::shared_ptr<PointCloud> cloud;
  int material = -1;
};

struct LineSegment {
  Vec3 from, to;
};

// Lines that are shown as capsules of one radius. `material`: as in instances.
struct ImportedLines {
  std::vector<LineSegment> segments;
  double radius;
  int material = -1;
};

struct ImportedScene {
  std::vector<Mesh> meshes;         // keep the promises of scene/mesh.hpp
  std::vector<Instance> instances;  // `material` is an index of `materials`, or −1: the file names none
  std::vector<ImportedPoints> clouds;
  std::vector<ImportedLines> lines;
  std::vector<std::unique_ptr<Material>> materials;
  std::vector<std::variant<PointLight, DirectionalLight, SpotLight>> lights;
  std::vector<ImportedCamera> cameras;  // in the order of the scene's nodes
  // Names of glTF's animations, scenes and variants; "" for one without a name.
  std::vector<std::string> animations, scenes, variants;
  std::optional<PlayedAnimation> played;
  std::vector<std::string> warnings;         // among them the features left out, once each, with counts
  std::vector<std::filesystem::path> files;  // every file that was read, the mesh file first
};

// The endings of mesh files, for messages.
inline constexpr std::string_view mesh_endings = ".obj, .ply, .stl, .off, .3mf, .gltf, .glb, .xyz or .pcd";

// True if the name has a mesh file's ending, in upper or lower case.
bool is_mesh_file(const std::filesystem::path& file);

// Reads a mesh file by its ending, and the files it refers to. Error (file_io) if a file cannot be read.
// InputError, with the position if there is one, if its contents are wrong or nothing in it could be seen. An
// animated file may have nothing to see at its moment. The size of the files bounds the memory needed.
// `folders`: folders, beside the file's own folder tree, that may contain the files it names (materials,
// buffers, pictures). `pixels`: the pixel budget of the scene that imports the file; null if there is no
// scene.
ImportedScene import_file(const std::filesystem::path& file, const ImportOptions& options = {},
                          std::span<const std::filesystem::path> folders = {},
                          image::PixelBudget* pixels = nullptr);

// Imports a mesh file from memory, for scenes in memory and for tests. Messages contain `name`, whose ending
// determines the format of `bytes`. References to other files are refused.
ImportedScene import_bytes(std::string bytes, const std::string& name, const ImportOptions& options = {},
                           image::PixelBudget* pixels = nullptr);

// The material of meshes whose file names none: a light grey, or white if vertices have colours.
std::unique_ptr<Material> plain_material(bool colored);

}  // namespace eyeray::engine::importers
