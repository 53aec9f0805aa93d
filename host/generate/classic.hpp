// What the scenes of Haines' Standard Procedural Databases have in common (A Proposal for Standard Graphics
// Environments, IEEE CG&A 7(11), 1987; package 3.14, CC0), and the list of them.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/generate/mesh_sink.hpp"

namespace eyeray::generate {

struct ClassicView {
  Vec3 eye;
  Vec3 target;
  Vec3 up{0, 0, 1};
  std::vector<Vec3> lights;
};

// A surface in the databases' terms, but for those that transmit light.
struct ClassicSurface {
  std::string_view name;
  Vec3 color;
  double diffuse = 1;           // kd
  double reflectance = 0;       // ks
  double specular = 0;          // kh
  double shininess = shine_37;  // of a highlight that has faded to half at an angle
  // ka. Most scenes have none, and leave a common weight open: this is that of the one surface that has one.
  double ambient = 0.2;

  static constexpr double shine_37 = 3.0827007755568205, shine_30 = 4.81884167930642,
                          shine_7 = 101.1483608391674;
};

// The TOML of picture, camera and lights: 512 × 512 pixels, the field of view that reaches 45° from the
// middle of the first to that of the last, and lights as bright as the package suggests.
std::string classic_stage(const ClassicView& view);
std::string classic_material(const ClassicSurface& surface);
// A flat surface of four corners, as two triangles.
std::string classic_square(std::string_view material, const std::array<Vec3, 4>& corners);

struct Count {
  std::string_view what;
  uint64_t number;
};

inline constexpr std::string_view most_text = "a scene file may have 256 MiB";
inline constexpr std::string_view most_triangles = "a mesh may have 2^29 triangles";

// A scene that is its name and its size factor.
struct Classic {
  std::string_view name;
  std::string_view doc;    // what it shows
  std::string_view sizes;  // what the size factor means
  int size_factor;         // that of the published statistics
  int largest;
  std::string_view limit;             // why it is, such as most_text
  std::vector<Count> (*counts)(int);  // of what it consists, but for a mesh
  std::string (*scene)(int);          // TOML of all but the mesh
  void (*mesh)(int, MeshSink&) = nullptr;
  std::string_view mesh_keys = "";  // of its [[mesh]], beside `file`
  // TOML of what stands in the mesh's place where it is a smooth surface that the mesh only comes near to.
  std::string (*patches)() = nullptr;
};

std::span<const Classic> classics();

}  // namespace eyeray::generate
