#include "host/generate/tetra.hpp"

namespace eyeray::generate {
namespace {

constexpr Vec3 corners[4] = {{-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}, {1, 1, 1}};
constexpr uint32_t faces[4][3] = {{0, 1, 2}, {3, 2, 1}, {2, 3, 0}, {1, 0, 3}};

void grow(const Vec3& center, double size, int levels, MeshSink& sink) {
  for (const Vec3& corner : corners) {
    if (levels > 1) {
      grow(center + size / 2 * corner, size / 2, levels - 1, sink);
    } else {
      sink.vertex(center + size * corner, {});
    }
  }
}

std::string scene(int) {
  return classic_stage({.eye = {1.022846, -3.177154, -2.174512},
                        .target = {-0.004103, -0.004103, 0.216539},
                        .up = {-0.816497, -0.816497, 0.816497},
                        .lights = {{2, -18, -5}}}) +
         classic_material({.name = "tetra", .color = {1, 0.2, 0.2}});
}

}  // namespace

void tetra_mesh(int size_factor, MeshSink& sink) {
  const uint64_t tetrahedra = uint64_t{1} << (2 * (size_factor - 1));
  sink.begin(4 * tetrahedra, 4 * tetrahedra, Shading::flat);
  grow(Vec3(0.0), 1, size_factor, sink);
  for (uint64_t i = 0; i < tetrahedra; ++i) {
    const uint32_t first = uint32_t(4 * i);
    for (const auto& [a, b, c] : faces) sink.triangle(first + a, first + b, first + c);
  }
}

const Classic tetra_classic = {
    .name = "tetra",
    .doc = "A tetrahedron of tetrahedra, after Sierpinski.",
    .sizes = "4^N triangles: 6 has 4096.",
    .size_factor = 6,
    .largest = 14,
    .limit = most_triangles,
    .counts = [](int) { return std::vector<Count>(); },
    .scene = scene,
    .mesh = tetra_mesh,
    .mesh_keys = "material = \"tetra\"\nsmooth = 0\n",
};

}  // namespace eyeray::generate
