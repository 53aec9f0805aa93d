// Meshes and their instances.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/core/vec.hpp"
#include "host/scene/bounds.hpp"
#include "host/scene/names.hpp"

namespace eyeray::engine {

// Triangles that share their vertices, in object space. The code that makes a mesh must ensure that indices
// are in range, every value is finite, and no triangle is without area. It must also ensure that the normal
// at each corner points to the side from which the triangle's corners run counter-clockwise.
struct Mesh {
  std::string name;  // for messages: the file, and its name there
  std::vector<Vec3> positions;
  std::vector<std::array<uint32_t, 3>> triangles;  // corners as indices of vertices
  std::vector<Vec3> normals;                       // unit shading normals, one a vertex; empty: flat
  std::vector<Vec2> uv;           // one a vertex; empty: the weights of the second and third corner
  std::vector<Vec3> colors = {};  // linear RGB from 0 to 1, one a vertex; empty: white
  // Unit vectors along u, one a vertex. w is 1 if v is to the left of the vector, seen from outside, and −1
  // if it is to the right. Empty: uv determine the tangents.
  std::vector<Vec4> tangents = {};
  std::vector<double> alphas = {};   // from 0 to 1, one a vertex, only beside colours; empty: 1
  std::vector<Vec2> second_uv = {};  // for images that read a second set, one a vertex; empty: as uv
  bool second_tangents = false;      // whether `tangents` are along the u of second_uv
};

// A mesh in the world. Under a transform that mirrors, the outside stays outside.
struct Instance {
  int mesh = 0;         // index in Scene::meshes
  Mat4 transform{1.0};  // mesh to world: affine and invertible
  int material = 0;     // index in Scene::materials
  SourcePosition position;
  NameRef name = {};  // in Scene::names
};

Bounds bounds(const Mesh& mesh);

}  // namespace eyeray::engine
