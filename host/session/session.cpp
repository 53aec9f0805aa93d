#include "host/session/session.hpp"

#include <algorithm>
#include <limits>

#include "host/core/error.hpp"
#include "host/core/termination.hpp"
#include "host/denoise_kernels/device_stages.hpp"
#include "host/render/checkpoint.hpp"
#include "host/render/corners.hpp"
#include "host/render/first_hits.hpp"
#include "host/render/legibility.hpp"
#include "host/render/light_meter.hpp"
#include "host/render/shutter.hpp"
#include "host/session/denoised_output.hpp"
#include "host/session/identity.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::session {
namespace {

// Throws if an output, links followed, would replace a file that the scene reads.
void spare_sources(const std::vector<fs::path>& outputs, const Scene& scene) {
  for (const fs::path& output : outputs) {
    for (const fs::path& source : scene.files) {
      std::error_code absent;
      if (fs::equivalent(output, source, absent))
        throw Error(ExitCode::bad_input,
                    "{} would be overwritten, but the scene reads it{}: name another file", output.string(),
                    output == source ? "" : " as " + source.string());
    }
  }
}

std::optional<render::Checkpoint> checkpoint_of(const Plan& plan) {
  const CheckpointFile& wanted = plan.request.checkpoint;
  if (wanted.begin.empty() && wanted.resume.empty()) return std::nullopt;
  std::vector<render::IdentityPart> identity = identity_of_checkpoint(plan);
  if (wanted.resume.empty())
    return render::Checkpoint::begin(wanted.begin, std::move(identity), wanted.seconds);
  return render::Checkpoint::resume(wanted.resume, std::move(identity), wanted.seconds);
}

// One request while it is rendered.
class Rendering {
 public:
  // `denoised`: the output if it is denoised, else null.
  Rendering(const Plan& plan, executors::Executor& executor, Output& output, DenoisedOutput* denoised)
      : plan_(plan),
        request_(plan.request),
        executor_(executor),
        output_(output),
        denoised_(denoised),
        values_(plan.channels, plan.scene),
        legibility_(render::legibility_of(plan.scene, plan.tone.exposure)),
        checkpoint_(checkpoint_of(plan)) {
    if (denoised_ && request_.progress)
      denoised_->report_to([this](double share) { return report_denoised(share); });
  }

  Result run() {
    output_.begin(plan_);
    take_samples();
    // A picture in which every pixel has a sample is worth keeping, with or without the first hits.
    if (result_.totals.samples_done > 0) {
      const Saving saving;
      output_times_.measure("encode", [&] { output_.finish_color(); });
    }
    if (!result_.interrupted() && film::any_of_first_hits(plan_.channels))
      result_.totals.interrupted = !take_first_hits();
    describe();
    {
      const Saving saving;
      output_times_.measure("encode", [&] { output_.finish(values_, result_); });
    }
    if (checkpoint_ && !result_.interrupted()) checkpoint_->remove();
    for (const StageTimes& times : {executor_.times(), output_times_})
      for (const auto& [stage, seconds] : times.stages()) result_.times.add(stage, seconds);
    if (denoised_) denoised_->add_times(result_.times);
    return std::move(result_);
  }

 private:
  render::RenderOptions driver_options() {
    render::RenderOptions options;
    options.crop = request_.classic ? render::corners_of(plan_.crop) : plan_.crop;
    options.tiles = plan_.tiles;
    options.ray_kinds = request_.ray_kinds;
    options.channels = plan_.channels;
    if (plan_.transparent()) options.channels = film::with(options.channels, {"coverage"});
    options.band_bytes = request_.band_bytes;
    options.noise = request_.noise;
    if (denoised_ && denoised_->estimates() && request_.noise > 0) {
      options.noise_left = [this](const film::Rows& all) { return denoised_->noise_left(all); };
      options.band_bytes = std::numeric_limits<size_t>::max();  // denoising keeps the whole picture, too
    }
    options.clamp = request_.clamp;
    options.reject_outliers = request_.reject_fireflies;
    options.exposure = plan_.tone.exposure;
    options.checkpoint = checkpoint_ ? &*checkpoint_ : nullptr;
    options.progress = [this](const render::Progress& now) { report(now); };
    return options;
  }

  void report(const render::Progress& now) {
    last_ = now;
    since_last_ = {};
    if (request_.progress) request_.progress(now);
    if (failure_is_known_ || !checkpoint_ || checkpoint_->failure().empty()) return;
    failure_is_known_ = true;
    if (request_.warn) request_.warn("no more checkpoints are written: " + checkpoint_->failure());
  }

  bool report_denoised(double share) {
    render::Progress now = last_;
    now.seconds += since_last_.seconds();
    now.denoised = share;
    request_.progress(now);
    return true;
  }

  void take_samples() {
    const render::RenderOptions options = driver_options();
    result_.pixels = plan_.tiles ? plan_.tiles->pixels() : options.crop.pixels();
    if (result_.pixels == 0) return;  // more shards than tiles
    render::CornerMean corners;
    result_.totals = render::render_rows(plan_.scene, executor_, options, [&](const film::Rows& rows) {
      output_times_.measure("encode", [&] { write(request_.classic ? corners.add(rows) : rows); });
    });
    // A part must be whole: an interrupted share gives no picture.
    if (request_.shard && result_.interrupted()) result_.totals.samples_done = 0;
  }

  void write(const film::Rows& rows) {
    output_.write(0, plan_.transparent() ? film::with_alpha(rows) : rows.color);
    if (legibility_) legibility_->see(rows.color);
    values_.give(rows, [&](size_t channel, const image::Image& image) { output_.write(1 + channel, image); });
  }

  bool take_first_hits() {
    const std::vector<Rect> areas = plan_.tiles ? plan_.tiles->tiles() : std::vector{plan_.crop};
    return std::ranges::all_of(areas, [&](const Rect& area) {
      return render::trace_first_hits(executor_, area, [&](int, std::span<const FirstHit> hits) {
        for (const FirstHit& hit : hits) {
          first_hit_flags_ |= hit.flags;
          result_.flagged_hits += hit.flags != 0;
        }
        output_times_.measure("encode", [&] {
          values_.give(hits, area.width,
                       [&](size_t channel, const image::Image& image) { output_.write(1 + channel, image); });
        });
      });
    });
  }

  void describe() {
    if (denoised_) denoised_->describe(result_);
    result_.crop = plan_.crop;
    result_.shard = request_.shard;
    result_.samples = plan_.scene.image.samples;
    if (plan_.scene.image.meters) result_.metered = plan_.tone.exposure;
    result_.device = executor_.facts().description;
    result_.longest_dispatch = executor_.facts().longest_dispatch;
    if (checkpoint_ && result_.interrupted() && checkpoint_->on_disk())
      result_.checkpoint = checkpoint_->file();
    // A checkpoint has no kinds of rays: those that were counted before it are lost.
    const bool resumed = checkpoint_ && checkpoint_->resumes();
    if (request_.ray_kinds && !(request_.shard && resumed)) result_.ray_kinds = result_.totals.ray_kinds;

    PictureQuality& quality = result_.quality;
    quality = quality_of(plan_.scene, request_.noise, request_.clamp, result_.pixels, result_.totals);
    quality.flags |= first_hit_flags_;
    quality.flagged = std::max(quality.flagged, result_.flagged_hits);
    if (legibility_) quality.illegible = legibility_->warning();
    // A share warns of its flags only: the other doubts concern the whole picture.
    result_.warnings = warnings_of(
        request_.shard ? PictureQuality{.flags = quality.flags, .flagged = quality.flagged} : quality);
    if (denoised_) denoised_->warn(result_.warnings);
  }

  const Plan& plan_;
  const Request& request_;
  executors::Executor& executor_;
  Output& output_;
  DenoisedOutput* const denoised_;
  film::ChannelValues values_;
  std::optional<render::Legibility> legibility_;
  std::optional<render::Checkpoint> checkpoint_;
  render::Progress last_;  // the last progress of sampling
  Stopwatch since_last_;
  bool failure_is_known_ = false;  // the checkpoint's failure was reported
  uint32_t first_hit_flags_ = 0;
  StageTimes output_times_;
  Result result_;
};

}  // namespace

double Result::share() const {
  return totals.samples_total ? double(totals.samples_taken) / double(totals.samples_total) : 1;
}

double Result::rays_per_second() const {
  return totals.seconds == 0 ? 0 : double(totals.rays - totals.rays_resumed) / totals.seconds;
}

std::unique_ptr<executors::Executor> Session::executor_for(const Scene& scene, const Request& request,
                                                           const film::Channels& channels) {
  executors::ExecutorOptions options = counting(options_, channels);
  options.ray_kinds |= request.ray_kinds;
  if (!options.shader_folder.empty()) options.twin.compile = true;
  if (request.next_is_alike) options.gpu.constants = executors::repay_kernels(scene.image.all_samples());
  auto executor = render::make_picture_executor(request.backend, scene, options);
  if (executor->facts().device) options_.gpu.open_device = executor->facts().device;
  return executor;
}

double Session::exposure(const Scene& scene, const Request& request) {
  if (!scene.image.meters) return scene.image.tone.exposure;
  return render::metered_exposure(scene, *executor_for(scene, request, check(request, scene)));
}

Result Session::render(const Scene& scene, const Request& request, Output& output) {
  const Stopwatch watch;
  film::Channels channels = check(request, scene);
  spare_sources(output.files(), scene);
  std::optional<DenoisedOutput> denoised;
  if (denoises(request, scene))
    channels = denoised.emplace(request.denoiser, output, channels, scene.image.transparent).channels();
  std::optional<render::ShardTiles> tiles;
  const Rect crop = crop_within(request.crop, scene.image);
  if (request.shard) tiles.emplace(crop, *request.shard);
  if (request.progress) request.progress({});
  const auto executor = executor_for(scene, request, channels);
  if (denoised) denoised->use(denoise_kernels::make_stages(executor->facts().device, options_));
  image::Tone tone = scene.image.tone;
  tone.exposure = request.exposure ? *request.exposure : render::metered_exposure(scene, *executor);
  const Plan plan{
      request, scene, *executor, crop, channels, tone, options_.gpu.fast_math, tiles ? &*tiles : nullptr};
  Result result =
      Rendering(plan, *executor, denoised ? *denoised : output, denoised ? &*denoised : nullptr).run();
  result.seconds = watch.seconds();
  return result;
}

}  // namespace eyeray::engine::session
