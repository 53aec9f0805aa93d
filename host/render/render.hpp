// The driver that turns samples into a picture.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "host/core/ray_counts.hpp"
#include "host/executors/executor.hpp"
#include "host/film/film.hpp"
#include "host/render/brightness.hpp"
#include "host/render/tiling.hpp"

namespace eyeray::engine::render {

class Checkpoint;  // render/checkpoint.hpp

struct Progress {
  uint64_t samples_done = 0;     // the samples of all pixels so far, resumed ones included
  uint64_t samples_total = 0;    // with RenderOptions::noise an estimate
  uint64_t samples_resumed = 0;  // the part of samples_done that an earlier run took
  uint64_t rays = 0;             // traced by this run
  double seconds = 0;            // since this run's sampling began
  int band = 0;                  // the present one of `bands`, from 0
  int bands = 1;
  int sample = 0;  // the present one of the band's `samples` a pixel, from 0
  int samples = 1;
  std::optional<double> denoised = {};  // the share that is done, while the picture is denoised
};

struct RenderOptions {
  Rect crop;                                      // in pixels of the whole picture; empty: all of it
  bool first_hits = false;                        // for render(): whether to trace first hits
  std::function<void(const Progress&)> progress;  // called between tiles; may be empty
  // The most bytes of sums in memory (40 for each pixel, and those of channels). A larger picture is rendered
  // in bands of rows: all samples of one band, then of the next. A smaller picture is one band: every pixel
  // gets its first sample before any gets its second.
  size_t band_bytes = size_t{256} << 20;
  // The channels of rows, beside `samples` and, with `noise`, the noise. The executor must compute the values
  // that channels need.
  film::Channels channels = {};
  bool ray_kinds = false;  // sum up the counts of rays by kind; the executor must count them
  // If above 0, pixels whose noise is at most this take no more samples (render/adaptive.hpp), and a pixel
  // takes at most scene.image.samples.
  double noise = 0;
  // Returns the noise of each block (film::NoiseBlocks) that will be left in a picture of these rows, which
  // are all. Empty: Film::noise. The picture must be one band.
  std::function<std::vector<double>(const film::Rows& all)> noise_left = {};
  std::optional<double> exposure = {};  // exposure of the shown picture, in stops; absent: the scene's
  // If above 0, samples are clamped to at most this in every channel, which makes means too dark.
  double clamp = 0;
  // Leave out samples that are outliers (Film::leave_out_outliers), which makes means too dark. Not allowed
  // with `tiles`.
  bool reject_outliers = false;
  bool over_white =
      false;  // put the samples of a transparent picture in front of white, to compare both at once
  // Called with sample number `index` of the pixels of a tile, once it is taken; the tile is in pixels of the
  // whole picture. May be empty.
  std::function<void(const Rect& tile, uint32_t index, std::span<const PixelSample>)> witness = {};
  // If not null, only these tiles of `crop` are rendered, and rows are those of their stack. Not allowed with
  // `noise`, which needs neighbours.
  const ShardTiles* tiles = nullptr;
  Checkpoint* checkpoint = nullptr;  // kept and resumed from; see render_rows
};

// The results of a render, except its pixels.
struct RenderTotals {
  uint64_t rays = 0;            // resumed ones included
  uint64_t flagged_pixels = 0;  // pixels with any SampleFlag
  uint32_t flags = 0;           // all SampleFlags seen
  int samples_done = 0;         // the samples that every pixel has; with RenderOptions::noise some have more
  int bands = 1;                // the number of bands
  bool interrupted = false;
  double seconds = 0;            // sampling in this run, nothing else
  double processor_seconds = 0;  // the processor time of these seconds, of all threads together
  uint64_t samples_taken = 0;    // the samples of all pixels, resumed ones included
  uint64_t samples_total = 0;    // as in Progress
  uint64_t samples_resumed = 0;
  uint64_t rays_resumed = 0;
  RayCounts ray_kinds;       // ray kinds of this run, if requested
  int most_samples = 0;      // the most samples of a pixel
  uint64_t fireflies = 0;    // Brightness::fireflies of this run
  Brightness brightness;     // brightness of this run's samples
  uint64_t clamped = 0;      // samples of this run that RenderOptions::clamp changed
  film::Outliers outliers;   // left out by this run
  double outlier_share = 0;  // the share of the light that they had
  // With RenderOptions::noise, and without noise_left: the number of pixels with at most that noise, and the
  // greatest noise of a pixel.
  uint64_t quiet_pixels = 0;
  double greatest_noise = 0;
};

using RowSink = std::function<void(const film::Rows&)>;

// Renders scene.image with `executor` and passes its rows to `sink` as they are finished, some megabytes at a
// time. If interrupted, a picture of one band is passed on as a whole if every pixel has a sample. A picture
// of several bands may then have been passed on in part, and samples_done is 0.
//
// A checkpoint is written every now and then, when interrupted, before an error of the executor goes on to
// the caller, and when the last sample is taken. From then on it states that nothing but handing on is left.
// A failure to write it is no reason to lose the render (Checkpoint::failure). Error (file_io) when the
// checkpoint to resume from is damaged.
RenderTotals render_rows(const Scene& scene, executors::Executor& executor, const RenderOptions& options,
                         const RowSink& sink);

// The whole result of a render.
struct Rendering : RenderTotals {
  image::Image color;                // color of the crop; linear RGB, the mean of the samples
  std::vector<FirstHit> first_hits;  // first hits of the crop; empty unless asked for
  image::Image hits, rays_traced;    // the channels `hits` and `rays`
  std::vector<image::Image> values;  // RenderOptions::channels, one by one
};

// Renders like render_rows. If interrupted, the images are empty unless samples_done > 0, and first_hits is
// empty.
Rendering render(const Scene& scene, executors::Executor& executor, const RenderOptions& options);

}  // namespace eyeray::engine::render
