// eyeray render: renders a scene to picture files.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "host/cli/frames.hpp"
#include "host/cli/picture_options.hpp"
#include "host/cli/picture_text.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/readable.hpp"
#include "host/core/standard_streams.hpp"
#include "host/program/option_values.hpp"
#include "host/session/part_file.hpp"
#include "host/session/picture_files.hpp"
#include "host/session/session.hpp"
#include "host/shards/part.hpp"

namespace eyeray::engine::cli {
namespace {

struct RenderCommand {
  PictureOptions options;
  int band_mebibytes = 256;  // Request::band_bytes
  bool stats = false;
  bool quiet = false;
  bool json = false;
  std::string frames;      // FIRST:LAST[:STEP]; empty: only the frame that the scene shows
  int turntable = 0;       // frames in which a mesh alone turns once; 0: it does not turn
  std::string video;       // video of the frames; empty: none
  bool overwrite = false;  // render frames again whose files exist

  ExitCode run();

 private:
  session::Result render(PictureOptions& wanted);
  ExitCode run_picture(PictureOptions wanted, Json& report);
  ExitCode run_frames();

  session::Session session_;
};

void print_stages(const session::Result& picture) {
  for (const auto& [stage, seconds] : picture.times.stages())
    print_lines(stderr, "  {:<16} {:>10}\n", stage, format_seconds(seconds));
  print_lines(stderr, "  {:<16} {:>10}\n", "total", format_seconds(picture.seconds));
}

void print_rays(const RayCounts& kinds, double seconds) {
  const auto line = [](std::string_view kind, uint64_t rays, const std::string& more = "") {
    print_lines(stderr, "  {:<16} {:>10}{}\n", kind, rays, more);
  };
  line("camera rays", kinds.eye, fmt::format(", {} of them hit", kinds.eye_hits));
  line("reflected rays", kinds.reflected);
  line("refracted rays", kinds.refracted,
       kinds.total_reflections ? fmt::format(", and {} total reflections", kinds.total_reflections) : "");
  line("shadow rays", kinds.shadow);
  if (kinds.cut_off > 0)
    line("cut-off paths", kinds.cut_off,
         fmt::format(", {:.2g} % of all, by max_depth", 100 * double(kinds.cut_off) / double(kinds.eye)));
  line("rays", kinds.total(), fmt::format(", {}", format_rate(double(kinds.total()) / seconds)));
}

// A sentence on the files that an interrupted picture has left.
std::string what_was_kept(const session::Result& picture, bool aovs) {
  const std::string file = picture.checkpoint.string();
  std::string text;
  if (!picture.files.empty()) {
    text = fmt::format("interrupted; {} of {} samples a pixel were kept{}", picture.totals.samples_done,
                       picture.samples, aovs ? ", and no AOVs" : "");
  } else if (!file.empty()) {
    text = "interrupted before the picture was complete";
  } else if (picture.shard) {
    text =
        "interrupted; an unfinished part is not written, so nothing was kept (--checkpoint FILE would keep "
        "the work)";
  } else if (picture.totals.bands == 1) {
    text = "interrupted before every pixel had a sample; nothing was kept";
  } else {
    text = fmt::format(
        "interrupted; a picture of {} bands is complete only at its end, so nothing was kept (--checkpoint "
        "FILE would keep the work)",
        picture.totals.bands);
  }
  if (file.empty()) return text;
  return fmt::format("{}; {} has {:.1f} % of the work: to continue, give the same options and --resume {}",
                     text, file, 100 * picture.share(), shell_word(file));
}

void add_frame_options(CLI::App& command, RenderCommand& options) {
  const std::string group = "Animation";
  command
      .add_option("--frames", options.frames,
                  "Render these frames of an animated scene, to files with the frame's number in their "
                  "names: -o out.%04d.png. Existing files are kept.")
      ->option_text("FIRST:LAST[:STEP]")
      ->group(group)
      ->excludes("--checkpoint")
      ->excludes("--resume");
  command
      .add_option("--turntable", options.turntable,
                  "Render a mesh alone in N frames, counted from 0, in which it turns once.")
      ->option_text("N")
      ->group(group)
      ->check(whole_within(2, int(most_frames)))
      ->excludes("--frames")
      ->excludes("--checkpoint")
      ->excludes("--resume");
  command
      .add_option("--video", options.video,
                  "Make a video of the frames, too, with ffmpeg: .mp4, .mkv, .mov or .webm.")
      ->option_text("FILE")
      ->group(group);
  command.add_flag("--overwrite", options.overwrite, "Render frames again even if their files exist.")
      ->group(group);
}

void add_long_render_options(CLI::App& command, RenderCommand& options) {
  session::CheckpointFile& file = options.options.request.checkpoint;
  const std::string group = "Long renders";
  const auto add = [&](const char* name, auto& value, const char* text, const char* description) {
    return command.add_option(name, value, description)->option_text(text)->group(group);
  };
  CLI::Option* const checkpoint =
      add("--checkpoint", file.begin, "FILE",
          "Store the work so far in this file, at intervals and on Ctrl-C, until the picture is written.");
  add("--resume", file.resume, "FILE",
      "Continue from a checkpoint, and go on storing it as --checkpoint does. All other options must be the "
      "same as before.")
      ->excludes(checkpoint);
  add("--checkpoint-every", file.seconds, "SECONDS=30", "The time between two writes of the checkpoint.")
      ->check(within(0.01, 1e6));
  add("--band-memory", options.band_mebibytes, "MIB=256",
      "The memory for the sums of pixels, 40 bytes each. A larger picture is rendered in bands of rows.")
      ->check(whole_within(1, 1 << 20));
}

session::Result RenderCommand::render(PictureOptions& wanted) {
  const Stopwatch watch;
  StageTimes times;
  const Scene scene = times.measure("load", [&] { return wanted.load(); });
  session::PictureFiles files(wanted.outputs, wanted.request.channels, wanted.half);
  session::PartFile part(wanted.outputs[0], wanted.scene.file());
  session::Output& output = wanted.request.shard ? static_cast<session::Output&>(part) : files;
  session::Result result = session_.render(scene, wanted.request, output);
  for (const auto& [stage, seconds] : result.times.stages()) times.add(stage, seconds);
  result.times = std::move(times);
  result.seconds = watch.seconds();
  return result;
}

// Renders one picture. Sets `report` to its JSON report.
ExitCode RenderCommand::run_picture(PictureOptions wanted, Json& report) {
  wanted.check_outputs();
  session::Request& request = wanted.request;
  request.ray_kinds = stats;
  request.band_bytes = size_t(band_mebibytes) << 20;
  request.overrides = wanted.scene.as_written();
  request.progress = progress_reporter(quiet);
  request.warn = [](const std::string& warning) { print_lines(stderr, "eyeray: warning: {}\n", warning); };
  const session::Result picture = render(wanted);

  print_warnings(picture);
  if (picture.interrupted() && picture.files.empty())
    throw Error(ExitCode::interrupted, "{}", what_was_kept(picture, false));
  if (!quiet) print_lines(stderr, "{}\n", summary(picture));
  if (stats) print_stages(picture);
  if (picture.ray_kinds) print_rays(*picture.ray_kinds, picture.totals.seconds);
  report = json_of(picture);
  if (!picture.interrupted()) return ExitCode::ok;
  print_lines(stderr, "eyeray: {}\n", what_was_kept(picture, !request.channels.empty()));
  return ExitCode::interrupted;
}

// Renders the frames one after the other; a share of N renders every N-th frame, whole. Frames whose files
// exist are kept, unless `overwrite`.
ExitCode RenderCommand::run_frames() {
  std::vector<int> wanted = parse_frames(frames);
  if (const auto shard = std::exchange(options.request.shard, std::nullopt)) {
    if (!video.empty())
      throw Error(ExitCode::bad_input,
                  "--video needs all frames, but --shard renders only a share of them: make the video last, "
                  "without --shard");
    std::vector<int> share;
    for (size_t i = size_t(shard->index); i < wanted.size(); i += size_t(shard->count))
      share.push_back(wanted[i]);
    wanted = std::move(share);
  }
  if (options.outputs.empty())
    options.outputs.push_back(std::filesystem::path(options.scene.file()).stem().string() + ".%04d.png");
  for (const std::string& output : options.outputs) frame_name(output, 0);
  const bool shown = options.outputs[0].ends_with(".png");
  if (!video.empty()) {
    if (!shown)
      throw Error(ExitCode::bad_input, "--video is made from the first output, which must be a .png");
    check_video(video);
  }
  const Scene scene = options.scene.load();
  if (!video.empty() && scene.image.transparent)
    throw Error(ExitCode::bad_input, "a video has no alpha: leave out --video, or the transparency");
  const Animation& animation = scene.animation;
  if (animation.tracks == 0)
    throw Error(ExitCode::bad_input,
                "{} has no [[track]] and shows no animation of a glTF file: nothing moves, so all its frames "
                "would be the same",
                options.scene.file());

  session_.options() = executors::for_frames(options.executor, scene.image.all_samples());
  // Frames that were exposed one by one would flicker.
  if (scene.image.meters) options.request.exposure = session_.exposure(scene, options.request);

  Json report{{"frames", Json::array()}};
  std::vector<std::filesystem::path> pictures;
  int kept = 0;
  for (const int frame : wanted) {
    PictureOptions one = options;
    one.scene = options.scene.with_defines({fmt::format("animation.frame={}", frame)});
    for (std::string& output : one.outputs) output = frame_name(output, frame);
    pictures.emplace_back(one.outputs[0]);
    const auto files = session::files_written(one.outputs, one.request.channels);
    const bool there =
        std::ranges::all_of(files, [](const auto& file) { return std::filesystem::exists(file); });
    if (there && !overwrite) {
      ++kept;
      continue;
    }
    Json of_frame;
    const ExitCode code = run_picture(std::move(one), of_frame);
    of_frame["frame"] = frame;
    report["frames"].push_back(std::move(of_frame));
    if (code == ExitCode::ok) continue;
    if (json) print_json(report);
    return code;
  }
  if (kept > 0 && !quiet)
    print_lines(stderr, "{} of {} frames existed and are kept; --overwrite renders them again\n", kept,
                wanted.size());
  if (!video.empty()) make_video(pictures, animation.frames_per_second, video);
  report["kept"] = kept;
  if (json) print_json(report);
  return ExitCode::ok;
}

ExitCode RenderCommand::run() {
  session_.options() = options.executor;
  if (turntable > 0) {
    options.scene = options.scene.with_turntable(turntable);
    frames = fmt::format("0:{}", turntable - 1);
  }
  if (!frames.empty()) return run_frames();
  if (!video.empty() || overwrite)
    throw Error(ExitCode::bad_input, "--{} needs --frames or --turntable",
                video.empty() ? "overwrite" : "video");
  Json report;
  const ExitCode code = run_picture(options, report);
  if (json) print_json(report);
  return code;
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand("render", "Render a scene to picture files.");
  const auto render = std::make_shared<RenderCommand>();
  session::Request& request = render->options.request;
  render->options.add_to(*command);
  add_long_render_options(*command, *render);
  add_frame_options(*command, *render);
  CLI::Option* const noise =
      command
          ->add_option("--noise", request.noise,
                       fmt::format("Take samples until the error of each pixel is at most this share of its "
                                   "brightness, such as 0.01. --spp N (default {}) is the maximum.",
                                   most_samples_by_default))
          ->option_text("SHARE")
          ->check(within(1e-4, 1));
  command
      ->add_option("--clamp", request.clamp,
                   "Clamp each channel of every sample to this value. This removes bright dots, but the "
                   "picture is biased: darker than the truth.")
      ->option_text("X")
      ->check(within(1e-6, 1e15));
  command->add_flag(
      "--reject-fireflies", request.reject_fireflies,
      "Leave out rare samples that are far brighter than all around. This removes bright dots, but "
      "the picture is biased: a warning states how much light it lost.");
  command->add_flag(
      "--denoise", request.denoise,
      "Remove the noise of random paths from the finished picture. An .exr keeps the noisy one too.");
  command
      ->add_option_function<std::string>(
          "--denoiser",
          [render](const std::string& name) {
            render->options.request.denoise = true;
            render->options.request.denoiser =
                name == "oidn" ? session::Denoiser::open_image_denoise : session::Denoiser::own;
          },
          "Denoise with this one: eyeray's own, or oidn, the library Open Image Denoise if it is installed. "
          "--denoise oidn means the same.")
      ->option_text("own|oidn")
      ->check(one_of({"own", "oidn"}));
  command
      ->add_option_function<std::string>(
          "--shard",
          [render](const std::string& text) { render->options.request.shard = shards::parse_shard(text); },
          "Render the I-th of N shares of the picture, such as 3/64, to a part; eyeray merge makes the "
          "picture of all parts.")
      ->option_text("I/N")
      ->group("Many machines");
  command->add_flag(
      "--stats", render->stats,
      "Print the time of each stage, and the numbers of camera, reflected, refracted and shadow rays.");
  command
      ->add_flag("--classic", render->options.classic,
                 "Sample as Haines' published statistics do: one ray at each pixel corner, at most 5 "
                 "successive rays, and no ray left out for a small contribution.")
      ->excludes("--spp")
      ->excludes(noise)
      ->excludes("--max-depth");
  command->add_flag("-q,--quiet", render->quiet,
                    "Print no progress and no summary; warnings and errors remain.");
  command->add_flag("--json", render->json, "Report as JSON on standard output.");
  command->footer(
      "Examples:\n"
      "  eyeray render scenes/whitted.toml                                   whitted.png\n"
      "  eyeray render scenes/whitted.toml -s 1920x1080 --spp 16 -o big.png -o big.pfm\n"
      "  eyeray render scenes/whitted.toml -D render.max_depth=2 --aov depth,normal\n"
      "  eyeray render scenes/path/cornell_box.toml --noise 0.02             each pixel as many samples as "
      "it needs\n"
      "  eyeray render scenes/animation.toml --frames 0:47 -o frame.%04d.png --video animation.mp4\n"
      "  eyeray render scenes/whitted.toml --spp 10000 --checkpoint long.part    and, after Ctrl-C, --resume "
      "long.part\n"
      "  eyeray render scenes/whitted.toml --shard 3/64                      whitted.3-of-64.eyeray\n"
      "Ctrl-C keeps the picture rendered so far, if every pixel has a sample.");
  command->callback([render, &run] { run = [render] { return render->run(); }; });
}

}  // namespace eyeray::engine::cli
