#include <algorithm>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "render/executors.hpp"

namespace eyeray {
namespace {

// The sums over the samples of every pixel of the crop, and how many samples they hold.
class Accumulator {
 public:
  explicit Accumulator(const Rect& crop) : crop_(crop), pixels_(size_t(crop.pixels())) {}

  void add(int first_row, std::span<const PixelSample> samples) {
    Pixel* pixel = &pixels_[size_t(first_row) * size_t(crop_.width)];
    for (const PixelSample& sample : samples) {
      pixel->color += sample.color;
      pixel->hits += sample.hits;
      pixel->flags |= sample.flags;
      rays_ += sample.rays;
      ++pixel;
    }
  }
  uint64_t rays() const { return rays_; }

  // Fills in `result` after `samples` whole samples and the first `rows` rows of one more.
  void finish(int samples, int rows, Rendering& result) const {
    result.samples_done = samples;
    result.rays = rays_;
    if (samples == 0) return;
    result.color = Image(crop_.width, crop_.height, 3);
    result.hits = Image(crop_.width, crop_.height, 1);
    for (int y = 0; y < crop_.height; ++y) {
      const double count = y < rows ? samples + 1 : samples;
      for (int x = 0; x < crop_.width; ++x) {
        const Pixel& pixel = pixels_[size_t(y) * size_t(crop_.width) + size_t(x)];
        for (int c = 0; c < 3; ++c) result.color.pixel(x, y)[c] = float(pixel.color[c] / count);
        *result.hits.pixel(x, y) = float(double(pixel.hits) / count);
        result.flags |= pixel.flags;
        result.flagged_pixels += pixel.flags != 0;
      }
    }
  }

 private:
  struct Pixel {
    Vec3 color{0.0};
    uint32_t hits = 0;
    uint32_t flags = 0;
  };
  Rect crop_;
  std::vector<Pixel> pixels_;
  uint64_t rays_ = 0;
};

// How many rows to ask for at a time: as many as take about a fifth of a second, so that progress shows and
// Ctrl-C works.
class RowsAtATime {
 public:
  explicit RowsAtATime(int width) : rows_(std::max(1, (1 << 20) / width)) {}
  int rows() const { return rows_; }
  void took(double seconds) {
    if (seconds > 0.4) rows_ = std::max(1, rows_ / 2);
    if (seconds < 0.1) rows_ = std::min(1 << 16, rows_ * 2);
  }

 private:
  int rows_;
};

}  // namespace

std::unique_ptr<Executor> make_executor(Backend backend, const Scene& scene, const ExecutorOptions& options) {
  if (backend == Backend::gpu) return make_gpu_executor(scene, options);
  if (backend == Backend::twin) return make_twin_executor(scene, options);
  return make_reference_executor(scene, options);
}

Rendering render(const Scene& scene, Executor& executor, const RenderOptions& options) {
  Rect crop = options.crop;
  if (crop.pixels() == 0) crop = {0, 0, scene.image.width, scene.image.height};
  Rendering result;
  Accumulator accumulator(crop);

  // Take one sample of the whole picture after the other, so that an interrupted one is whole and only
  // noisier.
  std::vector<PixelSample> samples;
  RowsAtATime at_a_time(crop.width);
  Progress progress;
  progress.samples_total = uint64_t(crop.pixels()) * uint64_t(scene.image.samples);
  const Stopwatch watch;
  int done = 0;
  int row = 0;
  while (done < scene.image.samples) {
    const Rect tile{crop.x, crop.y + row, crop.width, std::min(at_a_time.rows(), crop.height - row)};
    samples.resize(size_t(tile.pixels()));
    const Stopwatch tile_watch;
    result.interrupted = interrupted() || !executor.sample(tile, uint32_t(done), samples);
    if (result.interrupted) break;
    at_a_time.took(tile_watch.seconds());
    accumulator.add(row, samples);
    row += tile.height;
    if (row == crop.height) {
      row = 0;
      ++done;
    }
    progress.samples_done += uint64_t(tile.pixels());
    progress.rays = accumulator.rays();
    progress.seconds = watch.seconds();
    if (options.progress) options.progress(progress);
  }
  result.seconds = watch.seconds();
  accumulator.finish(done, row, result);

  if (options.first_hits && !result.interrupted) {
    result.first_hits.resize(size_t(crop.pixels()));
    executor.first_hits(crop, result.first_hits);
  }
  return result;
}

}  // namespace eyeray
