#include "host/generate/octasphere.hpp"

#include <algorithm>

#include "host/core/error.hpp"

namespace eyeray::engine::generate {
namespace {

// The octahedron |x| + |y| + |z| = divisions has its vertices at whole numbers: rings around z, from pole to
// pole, each a square of 4 · (distance to the nearer pole) steps.
struct Rings {
  int divisions;

  int size(int ring) const { return std::max(1, 4 * std::min(ring, 2 * divisions - ring)); }
  // The index of a ring's vertex, counted on around the ring.
  uint32_t index(int ring, int step) const { return first(ring) + uint32_t(step % size(ring)); }
  uint32_t first(int ring) const {
    const int n = divisions, south = 2 * n - ring;
    if (ring == 0) return 0;
    if (ring <= n) return uint32_t(1 + 2 * ring * (ring - 1));
    return uint32_t(4 * n * n + 1 - 2 * south * (south + 1));
  }
  Vec3 position(int ring, int step) const {
    const int reach = size(ring) / 4, z = divisions - ring;
    if (reach == 0) return {0, 0, z};
    const int side = step / reach, along = step % reach;
    const int a = reach - along, b = along;
    const Vec2 corner[4] = {{a, b}, {-b, a}, {-a, -b}, {b, -a}};
    return {corner[side], z};
  }
};

}  // namespace

Mesh octasphere(int divisions) {
  CHECK_LE(1, divisions);
  const Rings rings{divisions};
  Mesh mesh;
  for (int ring = 0; ring <= 2 * divisions; ++ring) {
    CHECK_EQ(rings.first(ring), mesh.positions.size());
    for (int step = 0; step < rings.size(ring); ++step)
      mesh.positions.push_back(glm::normalize(rings.position(ring, step)));
  }
  mesh.normals = mesh.positions;

  // Between two rings, one quadrant at a time: the longer ring has one edge more.
  for (int ring = 0; ring < 2 * divisions; ++ring) {
    const bool north = ring < divisions;
    const int wide = north ? ring + 1 : ring, narrow = north ? ring : ring + 1;
    const int edges = std::min(wide, 2 * divisions - wide);
    for (int side = 0; side < 4; ++side) {
      for (int i = 0; i < edges; ++i) {
        const uint32_t w0 = rings.index(wide, side * edges + i);
        const uint32_t w1 = rings.index(wide, side * edges + i + 1);
        const uint32_t n0 = rings.index(narrow, side * (edges - 1) + i);
        north ? mesh.triangles.push_back({w0, w1, n0}) : mesh.triangles.push_back({w1, w0, n0});
        if (i + 1 == edges) continue;
        const uint32_t n1 = rings.index(narrow, side * (edges - 1) + i + 1);
        north ? mesh.triangles.push_back({w1, n1, n0}) : mesh.triangles.push_back({n1, w1, n0});
      }
    }
  }
  return mesh;
}

}  // namespace eyeray::engine::generate
