// The finished rows of a picture that is rendered in bands, kept beside its checkpoint: a file that only
// grows.
#pragma once

#include <cstdint>
#include <filesystem>

#include "host/film/film.hpp"

namespace eyeray::engine::film {

// Rows from the top down; of each its pixels from left to right: three float32 of the colour, then those of
// each of the rows' channels; little-endian. Every failure is an Error (file_io).
class RowStore {
 public:
  // Touches nothing yet.
  explicit RowStore(std::filesystem::path file) : file_(std::move(file)) {}
  ~RowStore();
  RowStore(const RowStore&) = delete;
  RowStore& operator=(const RowStore&) = delete;

  // Rows [first, first + count) of a picture that is `width` wide. Read all from 0 on before appending: new
  // rows follow the last one read, and all data behind it are dropped.
  Rows read(int first, int count, int width, const Channels& channels);
  // Without a read before it, begins the file anew.
  void append(const Rows& rows);
  // Makes the device keep the appended rows.
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
