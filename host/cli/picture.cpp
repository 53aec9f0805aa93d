#include "host/cli/picture.hpp"

#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "host/cli/picture_files.hpp"
#include "host/cli/prepared_picture.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/peak_memory.hpp"
#include "host/core/readable.hpp"
#include "host/core/termination.hpp"
#include "host/film/values.hpp"
#include "host/image/image_file.hpp"
#include "host/render/corners.hpp"
#include "host/render/flags.hpp"
#include "host/render/legibility.hpp"
#include "host/render/render.hpp"

namespace fs = std::filesystem;

namespace eyeray::cli {
namespace {

double rays_per_second(const Picture& picture) {
  if (picture.sampling_seconds == 0) return 0;
  return double(picture.rays - picture.rays_resumed) / picture.sampling_seconds;
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
  const auto parse = [this](const std::string& list) { aovs = film::parse_channels(list); };
  command
      .add_option_function<std::string>(
          "--aov", parse,
          fmt::format("Also write {}, or all of them: each as data (FILE.NAME.pfm) and in false colour "
                      "(FILE.NAME.png), or of a FILE.exr as its layers; ids with what they stand for "
                      "(FILE.NAME.json).",
                      film::channel_names()))
      ->option_text("LIST");
  command.add_flag("--half", half, "Write the colours of an .exr in 16 bits a channel, not 32.");
  add_crop_option(command, crop);
  add_backend_option(command, backend);
  add_executor_options(command, executor);
}

void PictureRequest::check_outputs() {
  if (classic) check_classic();
  if (shard) check_shard();
  if (fs::is_directory(scene.file()))
    throw Error(ExitCode::file_io, "cannot read the scene {}: it is a folder; name a scene or a mesh in it",
                scene.file());
  if (outputs.empty())
    outputs.push_back(fs::path(scene.file()).filename().replace_extension(".png").string());
  for (const std::string& output : outputs) {
    if (!shard) image::image_format(output);
    check_writable(output);
    // A checkpoint is removed when the picture is there.
    for (const std::string& file : {long_render.checkpoint, long_render.resume}) {
      if (!file.empty() && fs::weakly_canonical(file) == fs::weakly_canonical(output))
        throw Error(ExitCode::bad_input, "{} cannot be the picture and its checkpoint", file);
    }
  }
}

// Its samples are at the corners of pixels.
void PictureRequest::check_classic() const {
  film::Channels has, lacks;
  for (const film::ChannelType& type : film::channel_types())
    if (type.of_corners != film::OfCorners::nothing) has.push_back(&type);
  for (const film::Channel aov : aovs)
    if (!film::contains(has, aov)) lacks.push_back(aov);
  if (!lacks.empty())
    throw Error(ExitCode::bad_input,
                "--classic samples the corners of pixels and so lacks the AOVs {}; it has {}",
                film::channel_names(lacks), film::channel_names(has));
}

// A part is whole pixels of the picture, in a file of its own.
void PictureRequest::check_shard() {
  if (noise > 0)
    throw Error(ExitCode::bad_input,
                "--noise looks at a pixel's neighbours, which other shards have: give all pixels the same "
                "samples with --spp");
  if (classic)
    throw Error(ExitCode::bad_input,
                "--classic makes pixels of corners that shards share: leave out --shard");
  if (half) throw Error(ExitCode::bad_input, "--half is for the picture: give it to eyeray merge");
  if (outputs.size() > 1 || (!outputs.empty() && fs::path(outputs[0]).extension() != ".eyeray"))
    throw Error(ExitCode::bad_input,
                "--shard writes one part, -o NAME.eyeray; pictures are made of all parts, by eyeray merge");
  if (outputs.empty())
    outputs.push_back(fmt::format("{}.{}-of-{}.eyeray", fs::path(scene.file()).stem().string(),
                                  shard->index + 1, shard->count));
}

std::vector<fs::path> PictureRequest::files_to_write() const {
  return shard ? std::vector<fs::path>{outputs[0]} : files_written(outputs, aovs);
}

Picture make_picture(PictureRequest request, const std::function<void(const render::Progress&)>& progress) {
  const Stopwatch watch;
  Picture picture;
  const auto prepared = prepare(request, picture.times, progress);
  const Scene& scene = prepared->scene;
  const Rect crop = prepared->crop;

  // Render the picture. Files are begun with the first rows: of a picture of one band, when it is done.
  std::optional<PictureFiles> files;
  film::ChannelValues values(request.aovs, scene);
  const film::ChannelValues::Sink write_aov = [&](size_t aov, const image::Image& rows) {
    files->write(aov, rows);
  };
  render::CornerMean corners;
  render::Legibility legibility(scene.render.background, scene.image.tone.exposure);
  StageTimes encoding;
  const auto write = [&](const film::Rows& rows) {
    if (!files)
      files.emplace(request.outputs, request.aovs, crop.width, crop.height, request.half, scene.image.tone);
    files->write(rows.color);
    if (scene.is_mesh_alone && !scene.environment) legibility.see(rows.color);
    values.give(rows, write_aov);
  };
  const render::RenderTotals totals =
      render::render_rows(scene, *prepared->executor, prepared->options, [&](const film::Rows& rows) {
        encoding.measure("encode", [&] { write(request.classic ? corners.add(rows) : rows); });
      });
  picture.interrupted = totals.interrupted;

  // A picture in which every pixel has a sample is worth keeping; a part of one is not.
  if (totals.samples_done > 0) {
    const Saving saving;
    encoding.measure("encode", [&] { files->finish_picture(picture.files); });
  }
  if (!picture.interrupted && film::any_of_first_hits(request.aovs)) {
    picture.interrupted =
        !render::trace_first_hits(*prepared->executor, crop, [&](int, std::span<const FirstHit> hits) {
          for (const FirstHit& hit : hits) {
            picture.flags |= hit.flags;
            picture.flagged_hits += hit.flags != 0;
          }
          encoding.measure("encode", [&] { values.give(hits, crop.width, write_aov); });
        });
  }
  encoding.measure("encode", [&] {
    const auto write_legend = [&](size_t aov, const fs::path& file) {
      return values.legend(aov)->write(file);
    };
    if (!picture.interrupted) files->finish_aovs(picture.files, write_legend);
    if (picture.interrupted && totals.samples_done > 0) files->finish_without_aovs(picture.files);
  });
  if (prepared->checkpoint && !picture.interrupted) prepared->checkpoint->remove();

  describe(request, *prepared, totals, picture,
           scene.is_mesh_alone && !scene.environment ? legibility.warning() : "");
  for (const StageTimes& times : {prepared->executor->times(), encoding}) {
    for (const auto& [stage, seconds] : times.stages()) picture.times.add(stage, seconds);
  }
  picture.seconds = watch.seconds();
  return picture;
}

namespace {

// "640×480", or "3/64 of 640×480, 4800 pixels".
std::string size_of(const Picture& picture) {
  const std::string whole = fmt::format("{}×{}", picture.crop.width, picture.crop.height);
  if (!picture.shard) return whole;
  return fmt::format("{}/{} of {}, {} pixels", picture.shard->index + 1, picture.shard->count, whole,
                     picture.pixels);
}

std::string samples_of(const Picture& picture) {
  if (picture.shard && picture.pixels == 0) return "nothing to do";
  const int least = picture.samples_done, most = picture.most_samples;
  if (least == most) return fmt::format("{} sample{} a pixel", least, least == 1 ? "" : "s");
  return fmt::format("{} to {} samples a pixel (mean {:.0f})", least, most, picture.mean_samples);
}

}  // namespace

std::string summary(const Picture& picture) {
  std::vector<std::string> names;
  for (const fs::path& file : picture.files) names.push_back(file.string());
  if (picture.parts > 0)
    return fmt::format("{}: {}, {}, {} rays, of {} part{} in {}", fmt::join(names, ", "), size_of(picture),
                       samples_of(picture), picture.rays, picture.parts, picture.parts == 1 ? "" : "s",
                       format_seconds(picture.seconds));
  return fmt::format(
      "{}: {}, {}, {}{} rays in {} ({}), {} in all, on {}", fmt::join(names, ", "), size_of(picture),
      samples_of(picture),
      picture.samples_resumed ? fmt::format("resumed with {} rays, then ", picture.rays_resumed) : "",
      picture.rays - picture.rays_resumed, format_seconds(picture.sampling_seconds),
      format_rate(rays_per_second(picture)), format_seconds(picture.seconds), picture.device);
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
            {"stages", program::to_json(picture.times)},
            {"peak_memory", peak_memory()},
            {"flagged_pixels", picture.flagged_pixels},
            {"flagged_hits", picture.flagged_hits},
            {"flags", Json::array()},
            {"interrupted", picture.interrupted},
            {"bands", picture.bands}};
  if (picture.parts > 0) json["parts"] = picture.parts;
  if (const auto& shard = picture.shard)
    json["shard"] = {{"index", shard->index + 1}, {"count", shard->count}, {"pixels", picture.pixels}};
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
