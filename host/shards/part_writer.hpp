// Writes a part as its rows are finished.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/core/atomic_file.hpp"
#include "host/image/image.hpp"
#include "host/shards/part.hpp"

namespace eyeray::engine::shards {

// The part's file appears with finish(). Error (file_io) if it cannot be written.
class PartWriter {
 public:
  // `tiles` must outlive it.
  PartWriter(std::filesystem::path file, const PartHeader& header, const render::ShardTiles& tiles);

  // Writes the next rows of the shard's stack: of the picture (plane 0) or of an AOV (1 + its index).
  void write(size_t plane, const image::Image& rows);
  // Writes the next tile of such a plane, without the pixels beside or below it in the stack.
  void write_tile(size_t plane, const image::Image& tile);
  // Must be called after the last rows of all planes.
  void finish(const PartTotals& totals);

 private:
  struct Plane {
    size_t channels = 0;
    uint64_t end = 0;  // offset in the file behind the bytes written
    int row = 0;       // the next row of the stack
    uint32_t checksum = 0;
    std::string waiting;  // bytes to be written
  };
  void write_row(Plane& plane, const float* row);
  void flush(Plane& plane);

  const render::ShardTiles& tiles_;
  AtomicFile file_;
  std::vector<Plane> planes_;
  uint64_t end_ = 0;  // offset in the file behind the planes
};

}  // namespace eyeray::engine::shards
