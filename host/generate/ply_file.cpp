#include "host/generate/ply_file.hpp"

#include <bit>
#include <cstring>

#include "host/core/error.hpp"
#include "host/core/termination.hpp"

namespace eyeray::engine::generate {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

namespace {

constexpr size_t buffer_bytes = size_t{1} << 20;

}  // namespace

PlyFile::PlyFile(const std::filesystem::path& path, std::string comment)
    : file_(path), comment_(std::move(comment)) {
  buffer_.reserve(buffer_bytes);
}

template <typename Value>
void PlyFile::append(Value value) {
  if (buffer_.size() + sizeof value > buffer_bytes) flush();
  const size_t at = buffer_.size();
  buffer_.resize(at + sizeof value);
  std::memcpy(buffer_.data() + at, &value, sizeof value);
}

void PlyFile::flush() {
  if (interrupted()) throw Error(ExitCode::interrupted, "interrupted; nothing was written");
  file_.write(buffer_);
  bytes_ += buffer_.size();
  buffer_.clear();
}

void PlyFile::begin(uint64_t vertices, uint64_t triangles) {
  CHECK_EQ(bytes(), 0u);
  CHECK_LE(triangles, max_generated_triangles);
  vertices_ = vertices_left_ = vertices;
  triangles_ = triangles_left_ = triangles;
  const std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {}\n"
      "element vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "element face {}\n"
      "property list uchar uint vertex_indices\nend_header\n",
      comment_, vertices, triangles);
  for (const char c : header) append(c);
}

void PlyFile::vertex(const Vec3& position, const Vec3& normal) {
  CHECK_LT(0u, vertices_left_);
  --vertices_left_;
  for (int i = 0; i < 3; ++i) append(float(position[i]));
  for (int i = 0; i < 3; ++i) append(float(normal[i]));
}

void PlyFile::triangle(uint32_t a, uint32_t b, uint32_t c) {
  CHECK_EQ(vertices_left_, 0u);
  CHECK_LT(0u, triangles_left_);
  --triangles_left_;
  append(uint8_t{3});
  for (const uint32_t corner : {a, b, c}) append(corner);
}

void PlyFile::commit() {
  CHECK_EQ(vertices_left_ + triangles_left_, 0u);
  flush();
  file_.commit();
}

}  // namespace eyeray::engine::generate
