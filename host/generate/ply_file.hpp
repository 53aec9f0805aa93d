// Meshes as binary little-endian PLY (Turk: The PLY Polygon File Format, 1994), written in pieces.
#pragma once

#include <filesystem>
#include <vector>

#include "host/core/atomic_file.hpp"
#include "host/generate/mesh_sink.hpp"

namespace eyeray::engine::generate {

// Float32 positions and normals, 24 bytes a vertex, and 13 bytes a triangle. The file
// appears with commit(). Error: file_io if it cannot be written, interrupted after Ctrl-C.
class PlyFile final : public MeshSink {
 public:
  // `comment` stands in the header, on one line.
  PlyFile(const std::filesystem::path& path, std::string comment);

  void begin(uint64_t vertices, uint64_t triangles) override;
  void vertex(const Vec3& position, const Vec3& normal) override;
  void triangle(uint32_t a, uint32_t b, uint32_t c) override;
  // Call it after all vertices and triangles that begin() announced.
  void commit();

  uint64_t vertices() const { return vertices_; }
  uint64_t triangles() const { return triangles_; }
  uint64_t bytes() const { return bytes_ + buffer_.size(); }

 private:
  template <typename Value>
  void append(Value value);
  void flush();

  AtomicFile file_;
  std::string comment_;
  std::vector<std::byte> buffer_;
  uint64_t bytes_ = 0;  // written before the buffer's bytes
  uint64_t vertices_ = 0;
  uint64_t triangles_ = 0;
  uint64_t vertices_left_ = 0;
  uint64_t triangles_left_ = 0;
};

}  // namespace eyeray::engine::generate
