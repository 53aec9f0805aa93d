// A picture file that is written as its rows are finished, so that nobody needs to hold all of it.
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
  // Begins a file of the format that the ending of `path` asks for (image/image_file.hpp), beside that path.
  // Size as image_size_allowed, 1 or 3 channels; Error (bad_input) for an unknown ending, Error (file_io)
  // here and below when it cannot be written.
  ImageWriter(const std::filesystem::path& path, int width, int height, int channels);
  // An .exr of those channels, at least one.
  ImageWriter(const std::filesystem::path& path, int width, int height, std::vector<ExrChannel> channels);
  // Leaves no trace unless finish() has been called.
  ~ImageWriter();
  ImageWriter(ImageWriter&&) noexcept;

  // The next rows, from the top down: any number of them, of the picture's width and channels.
  void write(const Image& rows);
  // After the last row: the file takes its place.
  void finish();

 private:
  int width_;
  int channels_;
  int rows_left_;
  std::unique_ptr<AtomicFile> file_;
  std::unique_ptr<RowEncoder> encoder_;
};

}  // namespace eyeray::engine::image
