// From a file's contents to a Mesh that keeps the promises of scene/mesh.hpp. Private to the importers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/scene/mesh.hpp"

namespace eyeray::engine::importers {

// A corner without a normal or without uv.
inline constexpr uint32_t no_index = 0xffffffff;

using IndexTriangle = std::array<uint32_t, 3>;

// The parts left out or repaired, over all meshes of a file.
struct MeshCounts {
  size_t not_finite = 0;    // faces
  size_t without_area = 0;  // faces
  size_t bad_normals = 0;   // corners
  size_t bad_uv = 0;        // corners
  size_t fans = 0;          // faces

  // "12 faces without area were left out", …
  void report(std::vector<std::string>& warnings) const;
};

// The vertices of a file, from which several meshes may take theirs.
struct VertexPool {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  // of any length
  std::vector<Vec2> uv;
  std::vector<Vec3> colors;     // linear RGB, one a position or as RawTriangles::colors has it, or none
  std::vector<double> alphas;   // likewise, and only with colours
  std::vector<Vec4> tangents;   // one a position, or none: of any length, and the side of v
  std::vector<Vec2> second_uv;  // one a position, or none
};

// Within 0 to 1; 0 for NaN.
Vec3 sound_color(const Vec3& rgb);
// From values that are shown as they are, which is how PLY and OBJ have colours.
Vec3 color_from_display(const Vec3& rgb);

// Triangles as indices of a pool, in range.
struct RawTriangles {
  std::string name;
  bool has_normals = false;
  bool has_uv = false;
  std::vector<IndexTriangle> positions;
  std::vector<IndexTriangle> normals;  // empty, where they have some: with the same indices as the positions
  std::vector<IndexTriangle> uv;       // the same
  std::vector<uint32_t> colors;        // one for all corners of a triangle; empty: as the positions
};

class MeshBuilder {
 public:
  // `pool` is changed: its normals are made unit, those that have no direction 0.
  MeshBuilder(VertexPool& pool, MeshCounts& counts);

  // Leaves out triangles that no ray can hit. A corner with a wrong normal gets the normal of its face. If
  // there are no normals and `smooth` (degrees) is above 0, makes them. Vertices that no face has are
  // dropped.
  Mesh build(const RawTriangles& raw, double smooth);

 private:
  // A vertex of the mesh in the making, made from these of the pool.
  struct Source {
    uint32_t position;
    uint32_t normal;
    uint32_t uv;
    uint32_t color;
  };

  std::vector<Vec3> face_normals(const RawTriangles& raw);
  bool is_same(const Source& a, const Source& b) const;
  uint32_t find_vertex(const Source& source);
  void append(Mesh& mesh, const RawTriangles& raw, const Source& source, const Vec3& normal);

  VertexPool& pool_;
  MeshCounts& counts_;
  std::vector<Source> sources_;  // one a vertex of the mesh
  std::vector<uint32_t> next_;   // the vertex before it that has the same position
  std::vector<uint32_t> last_;   // the last vertex of each position of the pool …
  std::vector<uint32_t> mesh_;   // … in the mesh of this number
  uint32_t meshes_ = 0;
};

}  // namespace eyeray::engine::importers
