#include "host/cli/picture.hpp"

#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "host/cli/identity.hpp"
#include "host/cli/picture_files.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/peak_memory.hpp"
#include "host/core/readable.hpp"
#include "host/core/termination.hpp"
#include "host/image/image_file.hpp"
#include "host/render/corners.hpp"
#include "host/render/flags.hpp"
#include "host/render/render.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/sampler.hpp"

namespace fs = std::filesystem;

namespace eyeray::cli {
namespace {

double rays_per_second(const Picture& picture) {
  return double(picture.rays - picture.rays_resumed) / picture.sampling_seconds;
}

// Corners, a depth of five with the eye rays, and nothing left out because it counts for little.
void make_classic(Scene& scene) {
  render::sample_corners(scene);
  scene.render.max_depth = 4;
  scene.render.min_throughput = 0;
}

// What `noise` needs of a scene: that samples may end anywhere. Without --spp the scene's samples, which are
// chosen for pictures that all have the same, are no limit.
void prepare_for_noise(const PictureRequest& request, Scene& scene) {
  if (sample_count_of(scene.image.pattern) != SampleCount::any)
    throw Error(ExitCode::bad_input,
                "--noise stops after any number of samples, and of the pattern '{}' all are needed: "
                "-D image.pattern=sobol or random",
                sample_patterns[uint32_t(scene.image.pattern)]);
  if (!request.scene.gives_samples()) scene.image.samples = most_samples_by_default;
}

// What a denoiser asks for is of paths alone: an error, or where all AOVs are wanted left out.
void check_auxiliary(std::vector<aov::Aov>& aovs, const Scene& scene) {
  if (walks_at_random(scene.render.integrator) || !aov::any_needs(aovs, aov::AovNeeds::auxiliary)) return;
  if (aovs.size() != aov::aov_types().size())
    throw Error(ExitCode::bad_input,
                "the AOVs albedo and shading_normal are of paths: -D render.integrator=path, or see normal");
  std::erase_if(aovs, [](aov::Aov each) { return each->needs == aov::AovNeeds::auxiliary; });
}

// Throws where what is to be written would take the place of what was read, links followed.
void spare_sources(const PictureRequest& request, const Scene& scene) {
  for (const fs::path& output : files_written(request.outputs, request.aovs)) {
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

void PictureRequest::add_to(CLI::App& command) {
  scene.add_to(command);
  command
      .add_option(
          "-o,--output", outputs,
          "Where the picture goes: .png, .pfm, .hdr or .exr. May be repeated. Default: SCENE.png here.")
      ->option_text("FILE")
      ->allow_extra_args(false)
      ->take_all();
  const auto parse = [this](const std::string& list) { aovs = aov::parse_aovs(list); };
  command
      .add_option_function<std::string>(
          "--aov", parse,
          fmt::format("Also write {}, or all of them: each as data (FILE.NAME.pfm) and in false colour "
                      "(FILE.NAME.png), or of a FILE.exr as its layers; ids with what they stand for "
                      "(FILE.NAME.json).",
                      aov::aov_names()))
      ->option_text("LIST");
  command.add_flag("--half", half, "Write the colours of an .exr in 16 bits a channel, not 32.");
  add_crop_option(command, crop);
  add_backend_option(command, backend);
  add_executor_options(command, executor);
}

void PictureRequest::check_outputs() {
  if (classic && aov::need_first_hits(aovs))
    throw Error(ExitCode::bad_input,
                "--classic sends no rays through the centres of pixels, of which AOVs but hits, bounces, "
                "rays, ray_kinds, samples and flags are made");
  if (classic && aov::any_needs(aovs, aov::AovNeeds::noise))
    throw Error(ExitCode::bad_input, "--classic samples have no noise that could be measured");
  for (const aov::AovNeeds needs : {aov::AovNeeds::brightest, aov::AovNeeds::auxiliary})
    if (classic && aov::any_needs(aovs, needs))
      throw Error(ExitCode::bad_input, "--classic has not the AOVs brightest, albedo and shading_normal");
  if (outputs.empty())
    outputs.push_back(fs::path(scene.file()).filename().replace_extension(".png").string());
  for (const std::string& output : outputs) {
    image::image_format(output);
    check_writable(output);
    // A checkpoint is removed when the picture is there.
    for (const std::string& file : {long_render.checkpoint, long_render.resume}) {
      if (!file.empty() && fs::weakly_canonical(file) == fs::weakly_canonical(output))
        throw Error(ExitCode::bad_input, "{} cannot be the picture and its checkpoint", file);
    }
  }
}

Picture make_picture(PictureRequest request, const std::function<void(const render::Progress&)>& progress) {
  const Stopwatch watch;
  Picture picture;
  Scene scene = picture.times.measure("load", [&] { return request.scene.load(); });
  check_auxiliary(request.aovs, scene);
  spare_sources(request, scene);
  check_crop(request.crop, scene.image);
  const Rect crop = request.crop == Rect{} ? Rect{0, 0, scene.image.width, scene.image.height} : request.crop;
  if (request.classic) make_classic(scene);
  if (request.noise > 0) prepare_for_noise(request, scene);
  executors::ExecutorOptions executor_options = request.executor;
  const bool pixel_kinds = aov::any_needs(request.aovs, aov::AovNeeds::ray_kinds);
  executor_options.ray_kinds = request.ray_kinds || pixel_kinds;
  if (!executor_options.shader_folder.empty()) executor_options.compile_twin = true;
  executor_options.search_cost = aov::any_needs(request.aovs, aov::AovNeeds::search_cost);
  const std::unique_ptr<executors::Executor> executor =
      executors::make_executor(request.backend, scene, executor_options);
  std::optional<render::Checkpoint> checkpoint = checkpoint_of(request, scene, *executor);

  // Render the picture. Files are begun with the first rows: of a picture of one band, when it is done.
  render::RenderOptions options;
  options.crop = request.classic ? render::corners_of(crop) : crop;
  options.ray_kinds = request.ray_kinds;
  options.pixel_kinds = pixel_kinds;
  options.pixel_noise = aov::any_needs(request.aovs, aov::AovNeeds::noise);
  options.pixel_brightest = aov::any_needs(request.aovs, aov::AovNeeds::brightest);
  options.pixel_auxiliary = aov::any_needs(request.aovs, aov::AovNeeds::auxiliary);
  options.noise = request.noise;
  options.clamp = request.clamp;
  options.band_bytes = size_t(request.long_render.band_mebibytes) << 20;
  options.checkpoint = checkpoint ? &*checkpoint : nullptr;
  options.progress = [&, warned = false](const render::Progress& now) mutable {
    if (progress) progress(now);
    if (!warned && checkpoint && !checkpoint->failure().empty()) {
      fmt::print(stderr, "eyeray: warning: no more checkpoints are written: {}\n", checkpoint->failure());
      warned = true;
    }
  };
  std::optional<PictureFiles> files;
  render::CornerMean corners;
  StageTimes encoding;
  const render::RenderTotals totals =
      render::render_rows(scene, *executor, options, [&](const render::FinishedRows& rows) {
        encoding.measure("encode", [&] {
          if (!files)
            files.emplace(request.outputs, request.aovs, crop.width, crop.height, request.half, scene);
          files->write(request.classic ? corners.add(rows) : rows);
        });
      });
  picture.interrupted = totals.interrupted;

  // A picture in which every pixel has a sample is worth keeping; a part of one is not.
  if (totals.samples_done > 0) {
    const Saving saving;
    encoding.measure("encode", [&] { files->finish_picture(picture.files); });
  }
  if (!picture.interrupted && aov::need_first_hits(request.aovs)) {
    picture.interrupted =
        !render::trace_first_hits(*executor, crop, [&](int, std::span<const FirstHit> hits) {
          for (const FirstHit& hit : hits) {
            picture.flags |= hit.flags;
            picture.flagged_hits += hit.flags != 0;
          }
          encoding.measure("encode", [&] { files->write(hits); });
        });
  }
  encoding.measure("encode", [&] {
    if (!picture.interrupted) files->finish_aovs(picture.files);
    if (picture.interrupted && totals.samples_done > 0) files->finish_without_aovs(picture.files);
  });
  if (checkpoint && !picture.interrupted) checkpoint->remove();
  if (checkpoint && picture.interrupted && checkpoint->on_disk()) picture.checkpoint = checkpoint->file();

  picture.sources = scene.files;
  for (const fs::path& file : executor->source_files()) picture.sources.push_back(file);
  picture.device = executor->description();
  picture.crop = crop;
  picture.samples = scene.image.samples;
  picture.samples_done = totals.samples_done;
  picture.rays = totals.rays;
  picture.sampling_seconds = totals.seconds;
  picture.sampling_processor_seconds = totals.processor_seconds;
  picture.flagged_pixels = totals.flagged_pixels;
  picture.flags |= totals.flags;
  picture.bands = totals.bands;
  picture.share = double(totals.samples_taken) / double(totals.samples_total);
  const double pixels = double(options.crop.pixels());
  picture.most_samples = totals.most_samples;
  picture.mean_samples = double(totals.samples_taken) / pixels;
  if (request.noise > 0)
    picture.noise = Noise{request.noise, totals.greatest_noise, double(totals.quiet_pixels) / pixels};
  picture.clamp = request.clamp;
  picture.clamped = totals.clamped;
  if (walks_at_random(scene.render.integrator)) picture.fireflies = totals.fireflies.samples;
  picture.samples_resumed = totals.samples_resumed;
  picture.rays_resumed = totals.rays_resumed;
  if (request.ray_kinds) picture.ray_kinds = totals.ray_kinds;
  for (const StageTimes& times : {executor->times(), encoding}) {
    for (const auto& [stage, seconds] : times.stages()) picture.times.add(stage, seconds);
  }
  picture.seconds = watch.seconds();
  return picture;
}

namespace {

std::string samples_of(const Picture& picture) {
  const int least = picture.samples_done, most = picture.most_samples;
  if (least == most) return fmt::format("{} sample{} a pixel", least, least == 1 ? "" : "s");
  return fmt::format("{} to {} samples a pixel (mean {:.0f})", least, most, picture.mean_samples);
}

}  // namespace

std::string summary(const Picture& picture) {
  std::vector<std::string> names;
  for (const fs::path& file : picture.files) names.push_back(file.string());
  return fmt::format(
      "{}: {}×{}, {}, {}{} rays in {} ({}) on {}", fmt::join(names, ", "), picture.crop.width,
      picture.crop.height, samples_of(picture),
      picture.samples_resumed ? fmt::format("resumed with {} rays, then ", picture.rays_resumed) : "",
      picture.rays - picture.rays_resumed, format_seconds(picture.seconds),
      format_rate(rays_per_second(picture)), picture.device);
}

std::string firefly_warning(const Picture& picture) {
  if (picture.fireflies == 0 || picture.clamp > 0) return "";
  return fmt::format(
      "{} sample{} more than {:g} times as bright as the picture is on the mean, and {} in full; the AOV "
      "brightest shows where",
      picture.fireflies, picture.fireflies == 1 ? " is" : "s are", render::Fireflies::times,
      picture.fireflies == 1 ? "counts" : "count");
}

std::string clamp_warning(const Picture& picture) {
  if (picture.clamp == 0) return "";
  return fmt::format("--clamp makes a biased picture: {} sample{} cut to {:g}", picture.clamped,
                     picture.clamped == 1 ? " was" : "s were", picture.clamp);
}

std::string noise_warning(const Picture& picture) {
  if (!picture.noise || picture.noise->share == 1) return "";
  return fmt::format(
      "{:.3g} % of the pixels have more noise than {}, up to {:.2g}: {} samples a pixel were too "
      "few{}",
      100 * (1 - picture.noise->share), picture.noise->wanted, picture.noise->greatest, picture.most_samples,
      picture.interrupted ? "" : "; --spp N allows more");
}

std::string stages(const StageTimes& times) {
  std::vector<std::string> parts;
  for (const auto& [stage, seconds] : times.stages())
    parts.push_back(fmt::format("{} {}", stage, format_seconds(seconds)));
  return fmt::format("{}", fmt::join(parts, ", "));
}

Json to_json(const Picture& picture) {
  Json json{{"files", Json::array()},
            {"device", picture.device},
            {"width", picture.crop.width},
            {"height", picture.crop.height},
            {"samples", picture.samples},
            {"samples_done", picture.samples_done},
            {"rays", picture.rays},
            {"seconds", picture.seconds},
            {"sampling_seconds", picture.sampling_seconds},
            {"sampling_processor_seconds", picture.sampling_processor_seconds},
            {"rays_per_second", rays_per_second(picture)},
            {"stages", to_json(picture.times)},
            {"peak_memory", peak_memory()},
            {"flagged_pixels", picture.flagged_pixels},
            {"flagged_hits", picture.flagged_hits},
            {"flags", Json::array()},
            {"interrupted", picture.interrupted},
            {"bands", picture.bands}};
  if (const auto& noise = picture.noise)
    json["noise"] = {{"wanted", noise->wanted},
                     {"greatest", noise->greatest},
                     {"share", noise->share},
                     {"most_samples", picture.most_samples},
                     {"mean_samples", picture.mean_samples}};
  if (picture.fireflies > 0) json["fireflies"] = picture.fireflies;
  if (picture.clamp > 0) json["clamp"] = {{"at", picture.clamp}, {"samples", picture.clamped}};
  if (const auto& kinds = picture.ray_kinds)
    json["ray_kinds"] = {{"eye", kinds->eye},
                         {"eye_hits", kinds->eye_hits},
                         {"reflected", kinds->reflected},
                         {"refracted", kinds->refracted},
                         {"total_reflections", kinds->total_reflections},
                         {"cut_off", kinds->cut_off},
                         {"shadow", kinds->shadow}};
  if (picture.samples_resumed > 0)
    json["resumed"] = {{"samples", picture.samples_resumed}, {"rays", picture.rays_resumed}};
  if (!picture.checkpoint.empty()) json["checkpoint"] = picture.checkpoint.string();
  for (const fs::path& file : picture.files) json["files"].push_back(file.string());
  for (const render::FlagText& each : render::flag_texts()) {
    if (picture.flags & each.flag) json["flags"].push_back(each.name);
  }
  return json;
}

}  // namespace eyeray::cli
