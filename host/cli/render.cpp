// eyeray render: a scene becomes picture files.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "host/cli/frames.hpp"
#include "host/cli/picture.hpp"
#include "host/cli/picture_files.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/readable.hpp"
#include "host/core/standard_streams.hpp"
#include "host/program/within.hpp"
#include "host/shards/part.hpp"

namespace eyeray::cli {
namespace {

struct RenderCommand {
  PictureRequest request;
  bool stats = false;
  bool quiet = false;
  bool json = false;
  std::string frames;      // FIRST:LAST[:STEP]; empty: the one that the scene shows
  std::string video;       // of them; empty: none
  bool overwrite = false;  // frames that are there

  ExitCode run();

 private:
  ExitCode run_picture(PictureRequest picture, Json& said);
  ExitCode run_frames();
};

void print_stages(const Picture& picture) {
  for (const auto& [stage, seconds] : picture.times.stages())
    print_lines(stderr, "  {:<16} {:>10}\n", stage, format_seconds(seconds));
  print_lines(stderr, "  {:<16} {:>10}\n", "all in all", format_seconds(picture.seconds));
}

void print_rays(const RayCounts& kinds, double seconds) {
  const auto line = [](std::string_view kind, uint64_t rays, const std::string& more = "") {
    print_lines(stderr, "  {:<16} {:>10}{}\n", kind, rays, more);
  };
  line("eye rays", kinds.eye, fmt::format(", {} of them hit", kinds.eye_hits));
  line("reflected rays", kinds.reflected);
  line("refracted rays", kinds.refracted,
       kinds.total_reflections ? fmt::format(", and {} total reflections", kinds.total_reflections) : "");
  line("shadow rays", kinds.shadow);
  if (kinds.cut_off > 0)
    line("cut-off paths", kinds.cut_off,
         fmt::format(", {:.2g} % of all, by max_depth", 100 * double(kinds.cut_off) / double(kinds.eye)));
  line("rays", kinds.total(), fmt::format(", {}", format_rate(double(kinds.total()) / seconds)));
}

// A sentence on a picture that was interrupted.
std::string what_was_kept(const Picture& picture, bool aovs) {
  const std::string file = picture.checkpoint.string();
  std::string text;
  if (!picture.files.empty()) {
    text = fmt::format("interrupted; {} of {} samples a pixel were kept{}", picture.samples_done,
                       picture.samples, aovs ? ", and no AOVs" : "");
  } else if (!file.empty()) {
    text = "interrupted before the picture was whole";
  } else if (picture.shard) {
    text = "interrupted, and a part is whole or nothing; nothing was kept (--checkpoint FILE would)";
  } else if (picture.bands == 1) {
    text = "interrupted before every pixel had a sample; nothing was kept";
  } else {
    text = fmt::format(
        "interrupted, and a picture of {} bands is whole only at its end; nothing was kept "
        "(--checkpoint FILE would)",
        picture.bands);
  }
  if (file.empty()) return text;
  return fmt::format("{}; {} has {:.1f} % of the work: to go on, give the same options and --resume {}", text,
                     file, 100 * picture.share, shell_word(file));
}

void add_frame_options(CLI::App& command, RenderCommand& options) {
  const std::string group = "Animation";
  command
      .add_option("--frames", options.frames,
                  "These frames of a scene that moves, to files with the number in their names: -o "
                  "out.%04d.png. What is there is kept.")
      ->option_text("FIRST:LAST[:STEP]")
      ->group(group)
      ->excludes("--checkpoint")
      ->excludes("--resume");
  command.add_option("--video", options.video, "A video of them, too, by ffmpeg: .mp4, .mkv, .mov or .webm.")
      ->option_text("FILE")
      ->group(group);
  command.add_flag("--overwrite", options.overwrite, "Render frames that are there anew.")->group(group);
}

void add_long_render_options(CLI::App& command, LongRender& options) {
  const std::string group = "Long renders";
  const auto add = [&](const char* name, auto& value, const char* text, const char* description) {
    return command.add_option(name, value, description)->option_text(text)->group(group);
  };
  CLI::Option* const checkpoint =
      add("--checkpoint", options.checkpoint, "FILE",
          "Keep what is done in this file, now and then and on Ctrl-C, until the picture is written.");
  add("--resume", options.resume, "FILE",
      "Go on from a checkpoint, and keep it as --checkpoint does. All else must be as it was.")
      ->excludes(checkpoint);
  add("--checkpoint-every", options.checkpoint_seconds, "SECONDS=30", "How often the checkpoint is written.")
      ->check(within(0.01, 1e6));
  add("--band-memory", options.band_mebibytes, "MIB=256",
      "A picture whose sums (40 bytes a pixel) need more is rendered in bands of rows.")
      ->check(CLI::Range(1, 1 << 20));
}

// One picture. `said`: what is said of it as JSON.
ExitCode RenderCommand::run_picture(PictureRequest wanted, Json& said) {
  wanted.check_outputs();
  wanted.ray_kinds = stats;
  const bool aovs = !wanted.aovs.empty();
  const bool share = wanted.shard.has_value();
  const Picture picture = share ? make_part(std::move(wanted), progress_reporter(quiet))
                                : make_picture(std::move(wanted), progress_reporter(quiet));
  request.executor.open_device = picture.open_device;

  for (const std::string& warning : picture.warnings) print_lines(stderr, "eyeray: warning: {}\n", warning);
  if (picture.interrupted && picture.files.empty())
    throw Error(ExitCode::interrupted, "{}", what_was_kept(picture, false));
  if (!quiet) print_lines(stderr, "{}\n", summary(picture));
  if (stats) print_stages(picture);
  if (picture.ray_kinds) print_rays(*picture.ray_kinds, picture.sampling_seconds);
  said = to_json(picture);
  if (!picture.interrupted) return ExitCode::ok;
  print_lines(stderr, "eyeray: {}\n", what_was_kept(picture, aovs));
  return ExitCode::interrupted;
}

// The frames one after the other; as a share of N every N-th of them, whole. Those whose files are there are
// kept as they are.
ExitCode RenderCommand::run_frames() {
  std::vector<int> wanted = parse_frames(frames);
  if (const auto shard = std::exchange(request.shard, std::nullopt)) {
    if (!video.empty())
      throw Error(ExitCode::bad_input,
                  "--video takes all frames, and --shard renders a share of them: the video "
                  "comes last, without --shard");
    std::vector<int> share;
    for (size_t i = size_t(shard->index); i < wanted.size(); i += size_t(shard->count))
      share.push_back(wanted[i]);
    wanted = std::move(share);
  }
  if (request.outputs.empty())
    request.outputs.push_back(std::filesystem::path(request.scene.file()).stem().string() + ".%04d.png");
  for (const std::string& output : request.outputs) frame_name(output, 0);
  const bool shown = request.outputs[0].ends_with(".png");
  if (!video.empty()) {
    if (!shown)
      throw Error(ExitCode::bad_input, "--video is made of the first output, which is to be a .png then");
    check_video(video);
  }
  const Scene scene = request.scene.load();
  const Animation& animation = scene.animation;
  if (animation.tracks == 0)
    throw Error(ExitCode::bad_input,
                "{} has no [[track]] and shows no animation of a glTF file: nothing moves, and all its "
                "frames would be the same",
                request.scene.file());

  request.executor = executors::for_frames(request.executor, scene.image.all_samples());

  Json said{{"frames", Json::array()}};
  std::vector<std::filesystem::path> pictures;
  int kept = 0;
  for (const int frame : wanted) {
    PictureRequest one = request;
    one.scene = request.scene.with_defines({fmt::format("animation.frame={}", frame)});
    for (std::string& output : one.outputs) output = frame_name(output, frame);
    pictures.emplace_back(one.outputs[0]);
    const auto files = files_written(one.outputs, one.aovs);
    const bool there =
        std::ranges::all_of(files, [](const auto& file) { return std::filesystem::exists(file); });
    if (there && !overwrite) {
      ++kept;
      continue;
    }
    Json of_frame;
    const ExitCode code = run_picture(std::move(one), of_frame);
    of_frame["frame"] = frame;
    said["frames"].push_back(std::move(of_frame));
    if (code == ExitCode::ok) continue;
    if (json) print_json(said);
    return code;
  }
  if (kept > 0 && !quiet)
    print_lines(stderr, "{} of {} frames were there and are kept; --overwrite renders them anew\n", kept,
                wanted.size());
  if (!video.empty()) make_video(pictures, animation.frames_per_second, video);
  said["kept"] = kept;
  if (json) print_json(said);
  return ExitCode::ok;
}

ExitCode RenderCommand::run() {
  if (!frames.empty()) return run_frames();
  if (!video.empty() || overwrite)
    throw Error(ExitCode::bad_input, "--{} is about --frames", video.empty() ? "overwrite" : "video");
  Json said;
  const ExitCode code = run_picture(request, said);
  if (json) print_json(said);
  return code;
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand("render", "Render a scene to picture files.");
  const auto options = std::make_shared<RenderCommand>();
  options->request.add_to(*command);
  add_long_render_options(*command, options->request.long_render);
  add_frame_options(*command, *options);
  CLI::Option* const noise =
      command
          ->add_option(
              "--noise", options->request.noise,
              fmt::format(
                  "Take samples until pixels are off by no more than this share of their brightness, as "
                  "0.01, each as many as it needs; --spp N (without it {}) is the most.",
                  most_samples_by_default))
          ->option_text("SHARE")
          ->check(within(1e-4, 1));
  command
      ->add_option(
          "--clamp", options->request.clamp,
          "Cut every sample to this in any channel: no more bright dots, but a biased picture, which "
          "is darker than the truth.")
      ->option_text("X")
      ->check(within(1e-6, 1e15));
  command
      ->add_option_function<std::string>(
          "--shard",
          [options](const std::string& text) { options->request.shard = shards::parse_shard(text); },
          "Render the I-th of N shares of the picture, as 3/64, to a part; eyeray merge makes the picture of "
          "all.")
      ->option_text("I/N")
      ->group("Many machines");
  command->add_flag(
      "--stats", options->stats,
      "Print how long each stage took, and how many eye, reflected, refracted and shadow rays there were.");
  command
      ->add_flag(
          "--classic", options->request.classic,
          "Sample as Haines' published statistics do: a ray a pixel corner, at most 5 in a row with the eye "
          "ray, none left out for counting little.")
      ->excludes("--spp")
      ->excludes(noise)
      ->excludes("--max-depth");
  command->add_flag("-q,--quiet", options->quiet, "No progress and no summary; warnings and errors remain.");
  command->add_flag("--json", options->json, "Say what was done as JSON on standard output.");
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
      "Ctrl-C keeps what was rendered so far, if every pixel has a sample.");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::cli
