// Portable float maps (Paul Debevec's PFM): "PF" or "Pf", width, height, a scale whose sign is the byte
// order, then raw float32 with the BOTTOM row first.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "host/image/image.hpp"

namespace eyeray::engine::image {

// Decodes a PFM of either byte order. Error (file_io), with `name` in it, unless the header is exact and no
// byte is missing or left over.
Image decode_pfm(std::string_view bytes, const std::string& name);

// A file that ImageWriter has just written, read again a few rows at a time.
class PfmRows {
 public:
  // `width`, `height` and `channels` are those with which the file was written. Error (file_io) here and
  // below if it cannot be read.
  PfmRows(std::filesystem::path path, int width, int height, int channels);

  // Rows [first, first + count), counted from the top.
  Image read(int first, int count);

 private:
  std::filesystem::path path_;
  int width_, height_, channels_;
  std::ifstream file_;
};

}  // namespace eyeray::engine::image
