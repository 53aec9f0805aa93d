// The finished rows of a picture that is rendered in bands, kept beside its checkpoint: a file that only
// grows.
#pragma once

#include <cstdint>
#include <filesystem>

#include "host/film/film.hpp"

namespace eyeray::engine::film {

// The file holds rows from the top down, and the pixels of a row from left to right. A pixel has three
// float32 values of the colour, then those of each channel; little-endian. Every failure is an Error
// (file_io).
class RowStore {
 public:
  // Does not open the file yet.
  explicit RowStore(std::filesystem::path file) : file_(std::move(file)) {}
  ~RowStore();
  RowStore(const RowStore&) = delete;
  RowStore& operator=(const RowStore&) = delete;

  // Rows [first, first + count) of a picture that is `width` wide. Read all rows from 0 on before appending:
  // new rows follow the last one read, and all data behind it are dropped.
  Rows read(int first, int count, int width, const Channels& channels);
  // Adds rows at the end. Without an earlier read(), the first append() begins the file anew.
  void append(const Rows& rows);
  // Waits until the appended rows are on the disk.
  void sync();
  // The checksum of all bytes read or appended.
  uint32_t checksum() const { return checksum_; }
  void remove();

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  uint64_t end_ = 0;
  uint32_t checksum_ = 0;
  bool dropped_rest_ = false;
};

}  // namespace eyeray::engine::film
