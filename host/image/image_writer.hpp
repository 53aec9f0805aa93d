// A picture file that is written as its rows are finished, so that no caller holds the whole picture.
#pragma once

#include <filesystem>
#include <memory>

#include "host/image/exr_file.hpp"
#include "host/image/image.hpp"

namespace eyeray::engine {
class AtomicFile;
}

namespace eyeray::engine::image {

class RowEncoder;

class ImageWriter {
 public:
  // Begins a file beside `path`, in the format for its ending (image/image_file.hpp). The size must be one
  // that image_size_allowed allows, with 1 or 3 channels, or 4 with alpha. Error (bad_input) for an unknown
  // ending, or for alpha in a format without it. Error (file_io) here and below if the file cannot be
  // written.
  ImageWriter(const std::filesystem::path& path, int width, int height, int channels);
  // Begins an .exr of these channels, of which there must be at least one.
  ImageWriter(const std::filesystem::path& path, int width, int height, std::vector<ExrChannel> channels);
  // Leaves no trace unless finish() has been called.
  ~ImageWriter();
  ImageWriter(ImageWriter&&) noexcept;

  // The next rows, from the top down: any number of them, of the picture's width and channels.
  void write(const Image& rows);
  // To be called after the last row: renames the file to `path`.
  void finish();

 private:
  int width_;
  int channels_;
  int rows_left_;
  std::unique_ptr<AtomicFile> file_;
  std::unique_ptr<RowEncoder> encoder_;
};

}  // namespace eyeray::engine::image
