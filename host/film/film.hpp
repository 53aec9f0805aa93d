// A picture while it is rendered: the sums over the samples of its pixels.
#pragma once

#include <span>
#include <vector>

#include "host/core/rect.hpp"
#include "host/film/channel.hpp"
#include "host/film/noise.hpp"

namespace eyeray::engine::film {

// Finished rows of a picture; sinks get them from the top down, none twice.
struct Rows {
  Rows() = default;
  // All values are 0.
  Rows(int from, int width, int count, Channels channels);

  // The values of one of `channels`.
  const image::Image& operator[](Channel channel) const;

  int first = 0;                     // counted from the top of the rendered rows
  image::Image color;                // linear RGB, the mean of the samples
  Channels channels;                 // channels of samples
  std::vector<image::Image> values;  // the means of each channel
  uint64_t flagged_pixels = 0;
  uint32_t flags = 0;
};

// The colours of the rows in 4 channels: the last is their alpha, the channel `coverage`, which they must
// have.
image::Image with_alpha(const Rows& rows);

// The effect of Film::leave_out_outliers.
struct Outliers {
  uint64_t pixels = 0;   // the number of pixels that have some
  double luminance = 0;  // the luminance that pixels lost, summed over all

  Outliers& operator+=(const Outliers& other) {
    pixels += other.pixels;
    luminance += other.luminance;
    return *this;
  }
};

class Film {
 public:
  // Sets all sums to 0. The film sums only those of `channels` whose values come from samples.
  // `shown_as_one`: the luminance that the picture shows as 1; noise in the dark is measured relative to it.
  // `finds_outliers`: whether the film sums groups of samples, too, 192 bytes a pixel.
  void reset(int width, int height, const Channels& channels, double shown_as_one = 1,
             bool finds_outliers = false);
  int width() const { return width_; }
  int height() const { return height_; }
  const Channels& channels() const { return channels_; }

  // Adds one sample to every pixel of `part`; `samples` are row by row. `auxiliaries`: one for each sample,
  // or none if no channel needs them.
  void add(const Rect& part, std::span<const PixelSample> samples,
           std::span<const AuxiliarySample> auxiliaries = {});
  // The means of rows [first, first + count).
  Rows rows(int first, int count) const;
  // Marks the pixels of `part`: whether they take no more samples.
  void set_finished(const Rect& part, bool finished);
  bool finished(int x, int y) const { return pixel(x, y).finished; }
  uint64_t samples() const;  // summed over all pixels
  // Leaves out groups of samples that are outliers (film/outliers.hpp) among those of 4 × 4 pixels. Their
  // mean becomes that of the pixel's other samples. Requires `finds_outliers`. To be called once, after all
  // samples.
  Outliers leave_out_outliers();
  // The noise of a block (noise_of), where a pixel's variance is s²/n. Pixels without samples do not count.
  // The result is NaN if a pixel has only one sample. Evenly spread samples of a pixel, such as Sobol's,
  // usually have a smaller error than this. The film must have the channel `noise`.
  double noise(const Rect& block) const;

  // The memory of the sums in the order of a checkpoint (render/checkpoint.hpp): the pixels' totals, then the
  // sums of each channel, each row by row.
  std::vector<std::span<std::byte>> parts();
  std::vector<std::span<const std::byte>> parts() const;

 private:
  size_t index(int x, int y) const { return size_t(y) * size_t(width_) + size_t(x); }
  const PixelTotals& pixel(int x, int y) const { return pixels_[index(x, y)]; }
  void fill_noise(int first, image::Image& rows) const;
  Outliers leave_out_outliers(const Rect& block);

  int width_ = 0;
  int height_ = 0;
  Channels channels_;
  std::vector<PixelTotals> pixels_;
  std::vector<std::vector<double>> sums_;  // for each channel, OfSamples::sums values a pixel
  std::vector<float> groups_;              // the colours of a pixel's groups; empty unless they are summed
  double shown_as_one_ = 1;
};

}  // namespace eyeray::engine::film
