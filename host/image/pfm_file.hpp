// Portable float maps (Paul Debevec's PFM): "PF" or "Pf", width, height, a scale whose sign is the byte
// order, then raw float32 with the BOTTOM row first.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "host/image/image.hpp"

namespace eyeray::engine::image {

// Strict: exact header, both byte orders, no byte too few or too many. Error (file_io), with `name` in it,
// otherwise.
Image decode_pfm(std::string_view bytes, const std::string& name);

// A file that ImageWriter has just written, read again a few rows at a time.
class PfmRows {
 public:
  // `width`, `height` and `channels` are known, since the file is our own; Error (file_io) here and below
  // when it cannot be read.
  PfmRows(std::filesystem::path path, int width, int height, int channels);

  // Rows [first, first + count), counted from the top.
  Image read(int first, int count);

 private:
  std::filesystem::path path_;
  int width_, height_, channels_;
  std::ifstream file_;
};

}  // namespace eyeray::engine::image
