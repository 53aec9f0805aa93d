#include "host/dev/painter.hpp"

#include <algorithm>

#include "host/core/stopwatch.hpp"
#include "host/film/film.hpp"
#include "host/render/brightness.hpp"
#include "host/render/legibility.hpp"
#include "host/scene/integrator.hpp"

namespace eyeray::engine::dev {
namespace {

// The wanted time for a band of rows: short enough for a picture that grows smoothly, and for edits, which
// wait for the end of a band.
constexpr double wanted_seconds = 0.04;
constexpr int first_pixels = 4096;  // the size of the first band
constexpr int coarse_stride = 8;

// Calls work(row, rows) for each band of a picture's rows, until it returns false.
template <typename Work>
bool for_bands(const ImageSettings& image, int& band, const Work& work) {
  for (int row = 0; row < image.height;) {
    const Stopwatch watch;
    const int rows = std::min(band, image.height - row);
    if (!work(row, rows)) return false;
    row += rows;
    const double factor = wanted_seconds / std::max(watch.seconds(), 1e-4);
    band = std::clamp(int(rows * std::min(factor, 4.0)), 1, image.height);
  }
  return true;
}

image::Image shown(const View& view, const film::Rows& rows) {
  if (view.aov) return rows[view.aov];
  const bool has_alpha = film::contains(rows.channels, film::channel_named("coverage"));
  return has_alpha ? film::with_alpha(rows) : rows.color;
}

// A view that is denoised later needs no more than colours here.
bool paint_coarsely(View view, const Scene& scene, executors::Executor& executor, const RowsSink& sink) {
  view.denoised = false;
  const ImageSettings& image = scene.image;
  const Grid grid({0, 0, image.width, image.height}, coarse_stride);
  std::vector<PixelSample> samples(size_t(grid.pixels()));
  std::vector<AuxiliarySample> auxiliaries(view.needs() == film::Needs::auxiliary ? samples.size() : 0);
  if (!executor.sample(grid, 0, samples, auxiliaries)) return false;
  film::Film film;
  film.reset(grid.width(), grid.height(), view.film_channels(scene));
  film.add({0, 0, grid.width(), grid.height()}, samples, auxiliaries);
  return sink({shown(view, film.rows(0, grid.height())), 0, coarse_stride});
}

std::optional<Painted> paint_samples(const View& view, const Scene& scene, executors::Executor& executor,
                                     const RowsSink& sink) {
  const ImageSettings& image = scene.image;
  if (!paint_coarsely(view, scene, executor, sink)) return std::nullopt;
  Painted painted;
  session::PictureQuality& quality = painted.quality;
  render::Brightness brightness;
  double luminances = 0;
  std::optional<render::Legibility> legibility = render::legibility_of(scene, scene.image.tone.exposure);
  film::Film film;
  film.reset(image.width, image.height, view.film_channels(scene));
  const bool needs_auxiliaries = film::any_needs(film.channels(), film::Needs::auxiliary);
  std::vector<PixelSample> samples;
  std::vector<AuxiliarySample> auxiliaries;
  int band = std::clamp(first_pixels / image.width, 1, image.height);
  for (int sample = 0; sample < image.samples; ++sample) {
    const bool whole = for_bands(image, band, [&](int row, int rows) {
      const Rect tile{0, row, image.width, rows};
      samples.resize(size_t(tile.pixels()));
      if (needs_auxiliaries) auxiliaries.resize(samples.size());
      if (!executor.sample(tile, uint32_t(sample), samples, auxiliaries)) return false;
      film.add(tile, samples, auxiliaries);
      brightness.add(samples);
      for (const PixelSample& each : samples) painted.rays += each.rays;
      const film::Rows finished = film.rows(row, rows);
      if (sample + 1 == image.samples) {
        quality.flags |= finished.flags;
        quality.flagged += finished.flagged_pixels;
        luminances += render::sum_of_luminances(finished.color);
        if (legibility) legibility->see(finished.color);
      }
      return sink({shown(view, finished), row, 1, sample});
    });
    if (!whole) return std::nullopt;
  }
  if (walks_at_random(scene.render.integrator))
    quality.fireflies = brightness.fireflies(luminances, int64_t{image.width} * image.height);
  if (legibility) quality.illegible = legibility->warning();
  if (view.denoised) painted.noisy = film::noisy_picture(film.rows(0, image.height), scene.image.transparent);
  return painted;
}

std::optional<Painted> paint_first_hits(const View& view, const Scene& scene, executors::Executor& executor,
                                        const RowsSink& sink) {
  const ImageSettings& image = scene.image;
  const auto entries = view.aov->legend ? view.aov->legend(scene) : nullptr;
  Painted painted;
  std::vector<FirstHit> hits;
  int band = std::clamp(first_pixels / image.width, 1, image.height);
  const bool whole = for_bands(image, band, [&](int row, int rows) {
    hits.resize(size_t(rows) * size_t(image.width));
    executor.first_hits({0, row, image.width, rows}, hits);
    for (const FirstHit& hit : hits) {
      painted.quality.flags |= hit.flags;
      painted.quality.flagged += hit.flags != 0;
    }
    painted.rays += hits.size();
    return sink({film::channel_image(view.aov, hits, image.width, entries.get()), row});
  });
  return whole ? std::optional(painted) : std::nullopt;
}

}  // namespace

View parse_view(const std::string& name) {
  const std::span<const film::ChannelType> types = film::channel_types();
  const auto found = std::ranges::find(types, name, &film::ChannelType::name);
  if (found != types.end()) return {executors::Backend::gpu, &*found};
  return {executors::parse_backend(name)};
}

std::optional<Painted> paint(const View& view, const Scene& scene, executors::Executor& executor,
                             const RowsSink& sink) {
  if (view.aov && !view.aov->of_samples()) return paint_first_hits(view, scene, executor, sink);
  return paint_samples(view, scene, executor, sink);
}

}  // namespace eyeray::engine::dev
