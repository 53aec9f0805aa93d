// Reads a part, in which nothing is trusted.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "host/shards/part.hpp"

namespace eyeray::engine::shards {

class PartReader {
 public:
  // Reads all but the planes. Error (file_io) if the file cannot be read, is no part, or is damaged. Its text
  // is the reason, without the file's name.
  explicit PartReader(std::filesystem::path file);
  ~PartReader();
  PartReader(PartReader&& other) noexcept;
  PartReader(const PartReader&) = delete;
  PartReader& operator=(const PartReader&) = delete;
  PartReader& operator=(PartReader&&) = delete;

  const std::filesystem::path& file() const { return file_; }
  const PartHeader& header() const { return header_; }
  PartTotals totals() const { return totals_of(totals_); }
  // Reads the pixels of the plane's next tile, row by row. Error as above.
  void read_tile(size_t plane, std::vector<float>& pixels);
  // Reads all planes to check their checksums. read_tile() then begins with the first tiles again. Error as
  // above.
  void check();

 private:
  struct Plane {
    uint64_t end = 0;  // offset in the file behind the bytes read
    size_t tile = 0;   // the next one to read
    uint32_t checksum = 0;
  };
  void read_at(uint64_t offset, std::span<std::byte> bytes) const;
  void read_header();
  void begin_planes();

  std::filesystem::path file_;
  int descriptor_ = -1;
  uint64_t bytes_ = 0;
  PartHeader header_;
  std::string totals_;  // as text: the counts of thousands of parts would take most of the memory
  uint64_t planes_begin_ = 0;
  uint32_t header_checksum_ = 0;
  std::vector<int64_t> tile_pixels_;  // tile pixels of each tile of the shard
  std::vector<Plane> planes_;
};

}  // namespace eyeray::engine::shards
