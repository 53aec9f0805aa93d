// A picture and its AOVs as the layers of one .exr.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "host/aov/aov.hpp"
#include "host/aov/legend.hpp"
#include "host/core/atomic_file.hpp"
#include "host/image/exr_file.hpp"
#include "host/render/sums.hpp"

namespace eyeray::cli {

// A row of the file holds all layers, and these come one after the other: until the last has come they wait,
// in a file beside it that nobody sees.
class LayeredFile {
 public:
  // `half`: whether the picture is written so; AOVs never are. `scene` must outlive it.
  LayeredFile(std::filesystem::path path, const std::vector<aov::Aov>& aovs, int width, int height, bool half,
              const Scene& scene);

  // The next rows, from the top down, of the picture and of the AOVs that are made of them.
  void write(const render::FinishedRows& rows);
  // The same of those that are made of first hits.
  void write(std::span<const FirstHit> hits);
  // Makes the file: of all layers, and with it the legends of ids, or of the picture alone, which AOVs are
  // left out of where it was interrupted. Adds the files' names to `files`.
  void finish(std::vector<std::filesystem::path>& files, bool with_aovs);

 private:
  struct Layer {
    aov::Aov aov;  // null of the picture itself
    std::vector<image::ExrChannel> channels;
    uint64_t begin;  // of its rows in the waiting file
    int rows = 0;    // that have come
    std::optional<aov::Legend> legend;
  };
  uint64_t row_bytes(const Layer& layer) const;
  void add(aov::Aov aov, std::vector<image::ExrChannel> channels, const Scene& scene);
  void write(Layer& layer, const image::Image& rows);
  void read(const Layer& layer, int first, image::Image& rows, size_t channel) const;

  std::filesystem::path path_;
  int width_;
  int height_;
  std::vector<Layer> layers_;
  AtomicFile waiting_;  // never committed
};

}  // namespace eyeray::cli
