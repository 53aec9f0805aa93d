#include "host/render/render.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"
#include "host/core/processor_time.hpp"
#include "host/core/termination.hpp"
#include "host/render/adaptive.hpp"
#include "host/render/checkpoint.hpp"
#include "host/render/first_hits.hpp"
#include "host/render/rows_at_a_time.hpp"

namespace eyeray::engine::render {
namespace {

// The number of pixels passed on at a time: their results stay in the caches, and in memory that was used
// before.
constexpr int most_handed_on = 1 << 16;

// The least samples a pixel from which its noise is judged. Noise that is left in a denoised picture is
// judged earlier, since it follows from many pixels together.
constexpr uint64_t first_judgement = 64, first_judgement_of_noise_left = 16;

// The requested channels, and those that Driver needs.
film::Channels channels_of(const RenderOptions& options) {
  const film::Channels channels = film::with(options.channels, {"samples"});
  return options.noise > 0 ? film::with(channels, {"noise"}) : channels;
}

class Driver {
 public:
  Driver(const Scene& scene, executors::Executor& executor, const RenderOptions& options, const RowSink& sink)
      : executor_(executor),
        options_(options),
        sink_(sink),
        tiles_(options.tiles),
        crop_(tiles_                  ? Rect{0, 0, tiles_->width(), tiles_->height()}
              : options.crop.pixels() ? options.crop
                                      : Rect{0, 0, scene.image.width, scene.image.height}),
        pixels_(tiles_ ? tiles_->pixels() : crop_.pixels()),
        samples_(scene.image.samples),
        channels_(channels_of(options)),
        has_auxiliaries_(film::any_needs(channels_, film::Needs::auxiliary)),
        shown_as_one_(std::exp2(-options.exposure.value_or(scene.image.tone.exposure))),
        least_samples_(samples_),
        at_a_time_(crop_.width) {
    CHECK(pixels_ > 0 && !(tiles_ && (options.noise > 0 || options.reject_outliers)));
    const size_t rows = options.band_bytes / (size_t(crop_.width) * sizeof(film::PixelTotals));
    // Bands must hold whole blocks of noise, and whole tiles.
    const bool blocks = film::contains(channels_, film::channel_named("noise")) || options.reject_outliers;
    const size_t unit = blocks || tiles_ ? film::noise_block : 1;
    const auto height = size_t(crop_.height);
    band_rows_ = int(rows < height ? std::min(height, std::max<size_t>(rows / unit, 1) * unit) : height);
    progress_.samples_total = uint64_t(pixels_) * uint64_t(samples_);
    CHECK(bands() == 1 || !options.noise_left);
    progress_.bands = bands();
    progress_.samples = samples_;
    begin_band(0);
  }

  RenderTotals run() {
    if (options_.checkpoint && options_.checkpoint->resumes() && !take_up()) return interrupted_totals(0);
    while (true) {
      if (!sample_band()) {
        save();
        const bool whole = bands() == 1 && position_.samples > 0;
        if (whole) hand_on();
        return interrupted_totals(whole ? least_samples_ : 0);
      }
      const int next = int(position_.finished_rows) + film_.height();
      if (next == crop_.height) break;
      hand_on();
      begin_band(next);
    }
    save();
    hand_on();
    totals_.samples_done = least_samples_;
    return totals();
  }

 private:
  int bands() const { return (crop_.height + band_rows_ - 1) / band_rows_; }

  void begin_band(int row) {
    position_.finished_rows = uint64_t(row);
    position_.samples = 0;
    position_.extra_rows = 0;
    progress_.band = row / band_rows_;
    film_.reset(crop_.width, std::min(band_rows_, crop_.height - row), channels_, shown_as_one_,
                options_.reject_outliers);
    look_for_what_is_left();
  }

  // Resumes at the checkpoint's position. Returns false if interrupted.
  bool take_up() {
    Checkpoint& checkpoint = *options_.checkpoint;
    const RenderPosition position = checkpoint.position();
    const auto damaged = [&] { checkpoint.damaged("its position is outside the picture"); };
    if (position.finished_rows >= uint64_t(crop_.height) || position.samples > uint64_t(samples_) ||
        (position.samples == uint64_t(samples_) && position.extra_rows > 0))
      damaged();
    begin_band(int(position.finished_rows));
    if (position.extra_rows >= uint64_t(film_.height())) damaged();
    checkpoint.read_sums(film_);
    look_for_what_is_left();
    position_ = position;
    totals_.rays_resumed = position.rays;

    // Pass the finished rows again to the sink, for the files of this run.
    for (int row = 0; row < int(position.finished_rows);) {
      if (interrupted()) return false;
      const int count = std::min(rows_of(most_handed_on, crop_.width), int(position.finished_rows) - row);
      give(checkpoint.read_rows(row, count, crop_.width, film_.channels()));
      row += count;
    }
    checkpoint.check_rows();
    progress_.samples_done = progress_.samples_resumed = samples_given_ + film_.samples();
    totals_.samples_resumed = progress_.samples_resumed;
    watch_ = {};
    return true;
  }

  // Takes the missing samples of the band. Returns false if interrupted.
  bool sample_band() {
    while (position_.samples < uint64_t(samples_)) {
      if (adaptive_ && position_.extra_rows == 0 && !some_are_left()) break;
      const int row = int(position_.extra_rows);
      const int height = std::min(at_a_time_.rows(), film_.height() - row);
      if (interrupted() || !sample(parts_to_sample(row, height))) return false;
      if (!saving_) saving_.emplace();
      position_.rays += parallel_sum(0, int(tile_samples_.size()),
                                     [&](int i) { return uint64_t{tile_samples_[size_t(i)].rays}; });
      if (options_.ray_kinds) {
        for (const PixelSample& each : tile_samples_) totals_.ray_kinds.add(each);
      }
      position_.extra_rows += uint64_t(height);
      if (position_.extra_rows == uint64_t(film_.height())) {
        position_.extra_rows = 0;
        ++position_.samples;
      }
      report();
      if (options_.checkpoint && options_.checkpoint->due()) save();
    }
    return true;
  }

  // The parts of the band's rows [row, row + height) that are to be sampled.
  std::vector<Rect> parts_to_sample(int row, int height) const {
    if (adaptive_) return adaptive_->left(row, height);
    if (!tiles_) return {Rect{0, row, crop_.width, height}};
    std::vector<Rect> parts = tiles_->parts(int(position_.finished_rows) + row, height);
    for (Rect& part : parts) part.y -= int(position_.finished_rows);
    return parts;
  }

  // The position in the picture of a part of the band.
  Rect in_picture(Rect part) const {
    part.y += int(position_.finished_rows);
    return tiles_ ? tiles_->in_picture(part)
                  : Rect{crop_.x + part.x, crop_.y + part.y, part.width, part.height};
  }

  // Takes one sample of every pixel in `parts` of the band. If interrupted, returns false and adds none.
  bool sample(const std::vector<Rect>& parts) {
    size_t pixels = 0;
    for (const Rect& part : parts) pixels += size_t(part.pixels());
    tile_samples_.resize(pixels);
    const Stopwatch watch;
    const double processor_before = processor_seconds();
    std::span<PixelSample> left = tile_samples_;
    if (has_auxiliaries_) tile_auxiliaries_.resize(pixels);
    std::span<AuxiliarySample> auxiliaries = tile_auxiliaries_;
    try {
      for (const Rect& part : parts) {
        const Rect tile = in_picture(part);
        const std::span<PixelSample> out = left.first(size_t(part.pixels()));
        const std::span<AuxiliarySample> beside = auxiliaries.first(has_auxiliaries_ ? out.size() : 0);
        if (!executor_.sample(tile, uint32_t(position_.samples), out, beside)) return false;
        if (options_.over_white)
          for (PixelSample& each : out) each.color = each.over_white();
        left = left.subspan(out.size());
        auxiliaries = auxiliaries.subspan(beside.size());
        if (options_.witness) options_.witness(tile, uint32_t(position_.samples), out);
      }
    } catch (...) {
      save();
      throw;
    }
    at_a_time_.took(watch.seconds());
    totals_.seconds += watch.seconds();
    totals_.processor_seconds += processor_seconds() - processor_before;
    auxiliaries = tile_auxiliaries_;
    brightness_.add(tile_samples_);
    if (options_.clamp > 0) clamp_samples();
    left = tile_samples_;
    for (const Rect& part : parts) {
      const std::span<const PixelSample> samples = left.first(size_t(part.pixels()));
      const std::span<const AuxiliarySample> beside =
          auxiliaries.first(has_auxiliaries_ ? samples.size() : 0);
      film_.add(part, samples, beside);
      left = left.subspan(samples.size());
      auxiliaries = auxiliaries.subspan(beside.size());
    }
    progress_.samples_done += pixels;
    return true;
  }

  // Clamps samples by scaling them, which keeps their hues.
  void clamp_samples() {
    totals_.clamped += parallel_sum(0, int(tile_samples_.size()), [&](int i) {
      Vec3& color = tile_samples_[size_t(i)].color;
      const double most = std::max({color.x, color.y, color.z});
      if (!(most > options_.clamp)) return uint64_t{0};
      color *= options_.clamp / most;
      return uint64_t{1};
    });
  }

  void look_for_what_is_left() {
    const uint64_t first = options_.noise_left ? first_judgement_of_noise_left : first_judgement;
    const bool resumes = bool(options_.noise_left);
    if (options_.noise > 0) adaptive_.emplace(options_.noise, first, resumes, film_);
  }

  // To be called between two samples of the band: returns whether it needs another one, and estimates the
  // total number.
  bool some_are_left() {
    const uint64_t samples = position_.samples;
    const bool judges = adaptive_->judges_after(samples);
    const bool estimates = samples >= 8 && std::has_single_bit(samples) && !options_.noise_left;
    if (judges || estimates) {
      const std::vector<double> noise = noise_of_blocks();
      if (judges) adaptive_->judge(film_, noise);
      // Assume that the bands to come need as many samples as those so far.
      const double until_now =
          double(progress_.samples_done) + adaptive_->samples_to_go(noise, samples, samples_);
      const double pixels = double(crop_.width) * double(position_.finished_rows + uint64_t(film_.height()));
      progress_.samples_total = uint64_t(until_now / pixels * double(crop_.pixels()));
    }
    return !adaptive_->finished();
  }

  std::vector<double> noise_of_blocks() const {
    film::Film without_outliers;
    if (options_.reject_outliers) {
      without_outliers = film_;
      without_outliers.leave_out_outliers();
    }
    const film::Film& film = options_.reject_outliers ? without_outliers : film_;
    if (options_.noise_left) return options_.noise_left(film.rows(0, film.height()));
    return film::NoiseBlocks(film.width(), film.height()).map([&](const Rect& block) {
      return film.noise(block);
    });
  }

  void report() {
    progress_.rays = position_.rays - totals_.rays_resumed;
    progress_.seconds = watch_.seconds();
    progress_.sample = int(std::min(position_.samples, uint64_t(samples_ - 1)));
    if (options_.progress) options_.progress(progress_);
  }

  // Passes the band's rows to the sink, and, unless the band is the last, to the checkpoint.
  void hand_on() {
    const bool last = int(position_.finished_rows) + film_.height() == crop_.height;
    if (options_.reject_outliers) totals_.outliers += film_.leave_out_outliers();
    for (int row = 0; row < film_.height();) {
      const int count = std::min(rows_of(most_handed_on, crop_.width), film_.height() - row);
      film::Rows rows = film_.rows(row, count);
      rows.first += int(position_.finished_rows);
      position_.flags |= rows.flags;
      position_.flagged_pixels += rows.flagged_pixels;
      if (options_.checkpoint && !last) options_.checkpoint->append_rows(rows);
      give(rows);
      row += count;
    }
  }

  void give(const film::Rows& rows) {
    luminances_given_ += sum_of_luminances(rows.color);
    const float* const noise = options_.noise > 0 && !options_.noise_left
                                   ? rows[film::channel_named("noise")].samples().data()
                                   : nullptr;
    const std::vector<float>& counts = rows[film::channel_named("samples")].samples();
    for (size_t i = 0; i < counts.size(); ++i) {
      const int samples = int(counts[i]);
      if (samples == 0) continue;  // beside or below a tile
      samples_given_ += uint64_t(samples);
      least_samples_ = std::min(least_samples_, samples);
      totals_.most_samples = std::max(totals_.most_samples, samples);
      if (!noise) continue;
      totals_.quiet_pixels += noise[i] <= float(options_.noise);
      totals_.greatest_noise = std::max(totals_.greatest_noise, double(noise[i]));
    }
    sink_(rows);
  }

  void save() {
    if (options_.checkpoint) options_.checkpoint->save(position_, film_);
  }

  RenderTotals totals() const {
    RenderTotals totals = totals_;
    totals.rays = position_.rays;
    totals.flagged_pixels = position_.flagged_pixels;
    totals.flags = uint32_t(position_.flags);
    totals.bands = bands();
    totals.samples_taken = progress_.samples_done;
    totals.fireflies = brightness_.fireflies(luminances_given_, pixels_);
    totals.brightness = brightness_;
    if (totals.outliers.pixels > 0)
      totals.outlier_share = totals.outliers.luminance / (totals.outliers.luminance + luminances_given_);
    totals.samples_total = progress_.samples_total;
    return totals;
  }
  RenderTotals interrupted_totals(int samples_done) {
    totals_.interrupted = true;
    totals_.samples_done = samples_done;
    return totals();
  }

  executors::Executor& executor_;
  const RenderOptions& options_;
  const RowSink& sink_;
  const ShardTiles* const tiles_;
  const Rect crop_;       // the rendered area, or the stack of the tiles
  const int64_t pixels_;  // the number of pixels in crop_, or in the tiles
  const int samples_;
  const film::Channels channels_;
  const bool has_auxiliaries_;
  const double shown_as_one_;
  int band_rows_ = 1;  // the rows of every band but the last, which may have fewer

  RenderPosition position_;
  film::Film film_;                           // the sums of the band
  std::optional<AdaptiveSampling> adaptive_;  // the unfinished blocks of the band, with `noise`
  uint64_t samples_given_ = 0;                // samples of the rows passed to the sink
  int least_samples_;                         // the least that a pixel of these rows has
  double luminances_given_ = 0;               // the sum of the luminances in these rows
  Brightness brightness_;                     // brightness of all samples
  std::vector<PixelSample> tile_samples_;
  std::vector<AuxiliarySample> tile_auxiliaries_;
  RowsAtATime at_a_time_;
  Progress progress_;
  RenderTotals totals_;
  Stopwatch watch_;               // since sampling began
  std::optional<Saving> saving_;  // since the first tile, as there are samples to lose
};

void copy_rows(const image::Image& rows, int first, image::Image& picture) {
  std::copy(rows.samples().begin(), rows.samples().end(), picture.pixel(0, first));
}

}  // namespace

RenderTotals render_rows(const Scene& scene, executors::Executor& executor, const RenderOptions& options,
                         const RowSink& sink) {
  return Driver(scene, executor, options, sink).run();
}

Rendering render(const Scene& scene, executors::Executor& executor, const RenderOptions& options) {
  Rect crop = options.crop;
  if (crop.pixels() == 0) crop = {0, 0, scene.image.width, scene.image.height};
  Rendering result;
  const auto collect = [&](const film::Rows& rows) {
    if (rows.first == 0) {
      result.color = image::Image(crop.width, crop.height, 3);
      result.hits = image::Image(crop.width, crop.height, 1);
      result.rays_traced = image::Image(crop.width, crop.height, 1);
      for (const film::Channel channel : options.channels)
        result.values.emplace_back(crop.width, crop.height, channel->components);
    }
    copy_rows(rows.color, rows.first, result.color);
    copy_rows(rows[film::channel_named("hits")], rows.first, result.hits);
    copy_rows(rows[film::channel_named("rays")], rows.first, result.rays_traced);
    for (size_t i = 0; i < options.channels.size(); ++i)
      copy_rows(rows[options.channels[i]], rows.first, result.values[i]);
  };
  RenderOptions with_counts = options;
  with_counts.channels = film::with(options.channels, {"hits", "rays"});
  static_cast<RenderTotals&>(result) = render_rows(scene, executor, with_counts, collect);
  if (result.samples_done == 0)
    result.color = result.hits = result.rays_traced = image::Image(), result.values.clear();
  if (!options.first_hits || result.interrupted) return result;

  result.first_hits.resize(size_t(crop.pixels()));
  result.interrupted = !trace_first_hits(executor, crop, [&](int first, std::span<const FirstHit> hits) {
    std::copy(hits.begin(), hits.end(), &result.first_hits[size_t(first) * size_t(crop.width)]);
  });
  if (result.interrupted) result.first_hits.clear();
  return result;
}

}  // namespace eyeray::engine::render
