// Turns a file's contents into a Mesh that keeps the promises of scene/mesh.hpp. Private to the importers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/scene/mesh.hpp"

namespace eyeray::engine::importers {

// The index of a corner's normal or uv if it has none.
inline constexpr uint32_t no_index = 0xffffffff;

using IndexTriangle = std::array<uint32_t, 3>;

// The numbers of parts that were left out or repaired, in all meshes of a file.
struct MeshCounts {
  size_t not_finite = 0;    // faces
  size_t without_area = 0;  // faces
  size_t bad_normals = 0;   // corners
  size_t bad_uv = 0;        // corners
  size_t fans = 0;          // faces

  // Adds warnings such as "12 faces without area were left out".
  void report(std::vector<std::string>& warnings) const;
};

// The vertices of a file, from which several meshes may take theirs.
struct VertexPool {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  // vectors of any length
  std::vector<Vec2> uv;
  std::vector<Vec3> colors;     // linear RGB, one a position or one a face (RawTriangles::colors), or none
  std::vector<double> alphas;   // one a position, or none; only with colours
  std::vector<Vec4> tangents;   // one a position, or none: along u, of any length, and in w the side of v
  std::vector<Vec2> second_uv;  // one a position, or none
};

// The colour with each component clamped to 0 to 1; NaN becomes 0.
Vec3 sound_color(const Vec3& rgb);
// The linear colour for sRGB values, which are shown as they are: PLY and OBJ contain such colours.
Vec3 color_from_display(const Vec3& rgb);

// Triangles as indices into a pool, all in range.
struct RawTriangles {
  std::string name;
  bool has_normals = false;
  bool has_uv = false;
  std::vector<IndexTriangle> positions;
  std::vector<IndexTriangle> normals;  // empty: if has_normals, they have the indices of the positions
  std::vector<IndexTriangle> uv;       // empty: if has_uv, they have the indices of the positions
  std::vector<uint32_t> colors;        // one a triangle; empty: colours have the indices of the positions
  std::vector<IndexTriangle> corner_colors = {};  // one a corner; empty: by `colors`
};

class MeshBuilder {
 public:
  // Changes `pool`: its normals become unit vectors, or 0 if they have no direction.
  MeshBuilder(VertexPool& pool, MeshCounts& counts);

  // Makes a mesh. Leaves out triangles that no ray can hit, and vertices that no face has. A corner with a
  // wrong normal gets the normal of its face. If there are no normals and `smooth` (degrees) is above 0,
  // makes smooth normals.
  Mesh build(const RawTriangles& raw, double smooth);

 private:
  // The indices in the pool from which a vertex of the current mesh is made.
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
  std::vector<uint32_t> next_;   // for each vertex, the previous one at the same position
  std::vector<uint32_t> last_;   // for each position of the pool, its last vertex …
  std::vector<uint32_t> mesh_;   // … and the number of the mesh that has this vertex
  uint32_t meshes_ = 0;
};

}  // namespace eyeray::engine::importers
