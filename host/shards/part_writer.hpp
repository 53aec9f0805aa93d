// Writes a part as its rows are finished.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/core/atomic_file.hpp"
#include "host/image/image.hpp"
#include "host/shards/part.hpp"

namespace eyeray::engine::shards {

// Nothing of it is seen before finish(); Error (file_io) when the file cannot be written.
class PartWriter {
 public:
  // `tiles` must outlive it.
  PartWriter(std::filesystem::path file, const PartHeader& header, const render::ShardTiles& tiles);

  // The next rows of the shard's stack, of the picture (plane 0) or of an AOV (1 + its index).
  void write(size_t plane, const image::Image& rows);
  // The next tile of such a plane, without the pixels beside or below it in the stack.
  void write_tile(size_t plane, const image::Image& tile);
  // After the last rows of all planes.
  void finish(const PartTotals& totals);

 private:
  struct Plane {
    size_t channels = 0;
    uint64_t end = 0;  // in the file, of the bytes written
    int row = 0;       // the next of the stack
    uint32_t checksum = 0;
    std::string waiting;  // to be written
  };
  void write_row(Plane& plane, const float* row);
  void flush(Plane& plane);

  const render::ShardTiles& tiles_;
  AtomicFile file_;
  std::vector<Plane> planes_;
  uint64_t end_ = 0;  // of the planes
};

}  // namespace eyeray::engine::shards
