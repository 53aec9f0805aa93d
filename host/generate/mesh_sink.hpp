// Destinations of generated meshes: a file, written piece by piece, or memory.
#pragma once

#include <cstdint>

#include "host/scene/mesh.hpp"

namespace eyeray::engine::generate {

// Takes a mesh: begin, then every vertex, then every triangle.
class MeshSink {
 public:
  virtual ~MeshSink() = default;
  virtual void begin(uint64_t vertices, uint64_t triangles) = 0;
  // `normal` is unit.
  virtual void vertex(const Vec3& position, const Vec3& normal) = 0;
  // Corners counter-clockwise seen from outside.
  virtual void triangle(uint32_t a, uint32_t b, uint32_t c) = 0;
};

// The most triangles that a generated mesh may have. Any index of a corner then fits 32 bits.
inline constexpr uint64_t max_generated_triangles = uint64_t{1} << 29;

// Keeps the mesh.
class MeshInMemory final : public MeshSink {
 public:
  void begin(uint64_t vertices, uint64_t triangles) override {
    mesh.positions.reserve(vertices);
    mesh.normals.reserve(vertices);
    mesh.triangles.reserve(triangles);
  }
  void vertex(const Vec3& position, const Vec3& normal) override {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
  }
  void triangle(uint32_t a, uint32_t b, uint32_t c) override { mesh.triangles.push_back({a, b, c}); }

  Mesh mesh;
};

}  // namespace eyeray::engine::generate
