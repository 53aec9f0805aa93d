#include "host/cli/prepared_picture.hpp"

#include <algorithm>

#include "host/cli/identity.hpp"
#include "host/cli/picture_files.hpp"
#include "host/core/standard_streams.hpp"
#include "host/render/corners.hpp"
#include "host/render/shutter.hpp"
#include "host/render/warnings.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/sampler.hpp"

namespace fs = std::filesystem;

namespace eyeray::cli {
namespace {

// Corners, a depth of five with the eye rays, and nothing left out because it counts for little.
void make_classic(Scene& scene) {
  render::sample_corners(scene);
  scene.render.max_depth = 4;
  scene.render.min_throughput = 0;
}

// `noise` needs a scene whose samples may end anywhere. Without --spp the scene's samples, which are
// chosen for pictures that all have the same, are no limit.
void prepare_for_noise(const PictureRequest& request, Scene& scene) {
  if (sample_count_of(scene.image.pattern) != SampleCount::any)
    throw Error(ExitCode::bad_input,
                "--noise stops after any number of samples, and of the pattern '{}' all are needed: "
                "-D image.pattern=sobol or random",
                sample_patterns[uint32_t(scene.image.pattern)]);
  if (!request.scene.gives_samples()) scene.image.samples = most_samples_by_default;
}

// Throws where what is to be written would take the place of what was read, links followed.
void spare_sources(const PictureRequest& request, const Scene& scene) {
  for (const fs::path& output : request.files_to_write()) {
    for (const fs::path& source : scene.files) {
      std::error_code absent;
      if (fs::equivalent(output, source, absent))
        throw Error(ExitCode::bad_input,
                    "{} would be overwritten, and the scene reads it{}: -o names another file",
                    output.string(), output == source ? "" : " as " + source.string());
    }
  }
}

std::optional<render::Checkpoint> checkpoint_of(const PictureRequest& request, const Scene& scene,
                                                const executors::Executor& executor) {
  const LongRender& wanted = request.long_render;
  if (wanted.checkpoint.empty() && wanted.resume.empty()) return std::nullopt;
  std::vector<render::IdentityPart> identity = identity_of(request, scene, executor);
  if (wanted.resume.empty())
    return render::Checkpoint::begin(wanted.checkpoint, std::move(identity), wanted.checkpoint_seconds);
  return render::Checkpoint::resume(wanted.resume, std::move(identity), wanted.checkpoint_seconds);
}

}  // namespace

std::unique_ptr<PreparedPicture> prepare(PictureRequest& request, StageTimes& times,
                                         const std::function<void(const render::Progress&)>& progress) {
  auto prepared = std::make_unique<PreparedPicture>();
  Scene& scene = prepared->scene;
  scene = times.measure("load", [&] { return request.scene.load(); });
  request.aovs = film::channels_of(scene, std::move(request.aovs));
  spare_sources(request, scene);
  check_crop(request.crop, scene.image);
  const Rect& crop = prepared->crop =
      request.crop == Rect{} ? Rect{0, 0, scene.image.width, scene.image.height} : request.crop;
  if (request.classic) make_classic(scene);
  if (request.noise > 0) prepare_for_noise(request, scene);
  if (request.shard) prepared->tiles.emplace(crop, *request.shard);
  executors::ExecutorOptions executor_options = request.executor;
  executor_options.ray_kinds = request.ray_kinds || film::any_needs(request.aovs, film::Needs::ray_kinds);
  if (!executor_options.shader_folder.empty()) executor_options.compile_twin = true;
  executor_options.search_cost = film::any_needs(request.aovs, film::Needs::search_cost);
  if (progress) progress({});
  prepared->executor = render::make_picture_executor(request.backend, scene, executor_options);
  std::optional<render::Checkpoint>& checkpoint = prepared->checkpoint;
  checkpoint = checkpoint_of(request, scene, *prepared->executor);

  render::RenderOptions& options = prepared->options;
  options.crop = request.classic ? render::corners_of(crop) : crop;
  options.tiles = prepared->tiles ? &*prepared->tiles : nullptr;
  options.ray_kinds = request.ray_kinds;
  options.channels = request.aovs;
  options.noise = request.noise;
  options.clamp = request.clamp;
  options.band_bytes = size_t(request.long_render.band_mebibytes) << 20;
  options.checkpoint = checkpoint ? &*checkpoint : nullptr;
  options.progress = [&checkpoint, progress, warned = false](const render::Progress& now) mutable {
    if (progress) progress(now);
    if (!warned && checkpoint && !checkpoint->failure().empty()) {
      print_lines(stderr, "eyeray: warning: no more checkpoints are written: {}\n", checkpoint->failure());
      warned = true;
    }
  };
  return prepared;
}

void describe(const PictureRequest& request, const PreparedPicture& prepared,
              const render::RenderTotals& totals, Picture& picture, const std::string& illegible) {
  const Scene& scene = prepared.scene;
  if (prepared.checkpoint && picture.interrupted && prepared.checkpoint->on_disk())
    picture.checkpoint = prepared.checkpoint->file();
  picture.sources = scene.files;
  for (const fs::path& file : prepared.executor->source_files()) picture.sources.push_back(file);
  picture.device = prepared.executor->description();
  picture.open_device = prepared.executor->device();
  picture.crop = prepared.crop;
  picture.samples = scene.image.samples;
  picture.samples_done = totals.samples_done;
  picture.rays = totals.rays;
  picture.sampling_seconds = totals.seconds;
  picture.sampling_processor_seconds = totals.processor_seconds;
  picture.flagged_pixels = totals.flagged_pixels;
  picture.flags |= totals.flags;
  picture.bands = totals.bands;
  picture.share = totals.samples_total ? double(totals.samples_taken) / double(totals.samples_total) : 1;
  const double pixels = double(prepared.tiles ? prepared.tiles->pixels() : prepared.options.crop.pixels());
  picture.most_samples = totals.most_samples;
  picture.mean_samples = pixels > 0 ? double(totals.samples_taken) / pixels : 0;
  if (request.noise > 0)
    picture.noise = Noise{request.noise, totals.greatest_noise, double(totals.quiet_pixels) / pixels};
  picture.clamp = request.clamp;
  picture.clamped = totals.clamped;
  if (walks_at_random(scene.render.integrator)) picture.fireflies = totals.fireflies.samples;
  picture.samples_resumed = totals.samples_resumed;
  picture.rays_resumed = totals.rays_resumed;
  if (request.ray_kinds) picture.ray_kinds = totals.ray_kinds;

  render::PictureQuality quality;
  // A part has only its flags: the rest is for the picture to say.
  if (!request.shard) quality = render::quality_of(scene, prepared.options, totals);
  quality.flags = picture.flags;
  quality.flagged = std::max(picture.flagged_pixels, picture.flagged_hits);
  quality.illegible = illegible;
  picture.warnings = render::warnings_of(quality);
}

}  // namespace eyeray::cli
