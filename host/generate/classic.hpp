// Common parts of the scenes of Haines' Standard Procedural Databases (A Proposal for Standard Graphics
// Environments, IEEE CG&A 7(11), 1987; package 3.14, CC0).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/vec.hpp"

namespace eyeray::engine::generate {

struct ClassicView {
  Vec3 eye;
  Vec3 target;
  Vec3 up{0, 0, 1};
  std::vector<Vec3> lights;
};

// A surface in the databases' terms, without the terms for transmitted light.
struct ClassicSurface {
  std::string_view name;
  Vec3 color;
  double diffuse = 1;           // kd
  double reflectance = 0;       // ks
  double specular = 0;          // kh
  double shininess = shine_37;  // exponent of the highlight, named by the angle at which it is half as bright
  // ka. Most scenes leave it open; this is the value of the one surface that has one.
  double ambient = 0.2;

  static constexpr double shine_37 = 3.0827007755568205, shine_30 = 4.81884167930642,
                          shine_7 = 101.1483608391674;
};

// The TOML of picture, camera and lights: 512 × 512 pixels, and lights as bright as the package suggests. The
// field of view is 45° from the middle of the first pixel to the middle of the last.
std::string classic_stage(const ClassicView& view);
std::string classic_material(const ClassicSurface& surface);
// A flat surface of four corners, as two triangles.
std::string classic_square(std::string_view material, const std::array<Vec3, 4>& corners);

}  // namespace eyeray::engine::generate
