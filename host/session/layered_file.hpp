// A picture and its AOVs as the layers of one .exr.
#pragma once

#include <filesystem>
#include <vector>

#include "host/core/atomic_file.hpp"
#include "host/film/channel.hpp"
#include "host/image/exr_file.hpp"
#include "host/image/image.hpp"

namespace eyeray::engine::session {

// A row of the .exr holds all layers, but the layers arrive one after the other. Until the last one has
// arrived they wait in a hidden file beside the .exr.
class LayeredFile {
 public:
  // `color`: the channels of the picture. AOVs are never half floats.
  LayeredFile(std::filesystem::path path, const film::Channels& aovs, int width, int height,
              std::vector<image::ExrChannel> color);

  // The next rows, from the top down, of the picture (plane 0) or of an AOV (1 + its index).
  void write(size_t plane, const image::Image& rows) { write(layers_[plane], rows); }
  // Makes the .exr of all layers, or of the picture alone if an interrupted render leaves out the AOVs. Adds
  // its name to `files`.
  void finish(std::vector<std::filesystem::path>& files, bool with_aovs);

 private:
  struct Layer {
    std::vector<image::ExrChannel> channels;
    uint64_t begin;  // the offset of its rows in the waiting file
    int rows = 0;    // the number of rows written so far
  };
  uint64_t row_bytes(const Layer& layer) const;
  void add(std::vector<image::ExrChannel> channels);
  void write(Layer& layer, const image::Image& rows);
  void read(const Layer& layer, int first, image::Image& rows, size_t channel) const;

  std::filesystem::path path_;
  int width_;
  int height_;
  std::vector<Layer> layers_;
  AtomicFile waiting_;  // never committed
};

}  // namespace eyeray::engine::session
