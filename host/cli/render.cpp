// eyeray render: a scene becomes picture files.
#include <nlohmann/json.hpp>

#include "host/cli/picture.hpp"
#include "host/cli/within.hpp"
#include "host/core/readable.hpp"
#include "host/render/flags.hpp"

namespace eyeray::cli {
namespace {

struct RenderCommand {
  PictureRequest request;
  bool stats = false;
  bool quiet = false;
  bool json = false;

  ExitCode run();
};

void print_stages(const Picture& picture) {
  for (const auto& [stage, seconds] : picture.times.stages())
    fmt::print(stderr, "  {:<16} {:>10}\n", stage, format_seconds(seconds));
  fmt::print(stderr, "  {:<16} {:>10}\n", "all in all", format_seconds(picture.seconds));
}

void print_rays(const RayCounts& kinds, double seconds) {
  const auto line = [](std::string_view kind, uint64_t rays, const std::string& more = "") {
    fmt::print(stderr, "  {:<16} {:>10}{}\n", kind, rays, more);
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

// Of a picture that was interrupted.
std::string what_was_kept(const Picture& picture, bool aovs) {
  const std::string file = picture.checkpoint.string();
  std::string text;
  if (!picture.files.empty()) {
    text = fmt::format("interrupted; {} of {} samples a pixel were kept{}", picture.samples_done,
                       picture.samples, aovs ? ", and no AOVs" : "");
  } else if (!file.empty()) {
    text = "interrupted before the picture was whole";
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
                     file, 100 * picture.share, file);
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

ExitCode RenderCommand::run() {
  request.check_outputs();
  request.ray_kinds = stats;
  const Picture picture = make_picture(request, progress_reporter(quiet));

  const uint64_t flagged = std::max(picture.flagged_pixels, picture.flagged_hits);
  if (const std::string warning = render::flag_warning(picture.flags, flagged); !warning.empty())
    fmt::print(stderr, "eyeray: warning: {}\n", warning);
  if (picture.interrupted && picture.files.empty())
    throw Error(ExitCode::interrupted, "{}", what_was_kept(picture, false));
  if (const std::string warning = noise_warning(picture); !warning.empty())
    fmt::print(stderr, "eyeray: warning: {}\n", warning);
  for (const std::string& warning : {clamp_warning(picture), firefly_warning(picture)})
    if (!warning.empty()) fmt::print(stderr, "eyeray: warning: {}\n", warning);
  if (!quiet) fmt::print(stderr, "{}\n", summary(picture));
  if (stats) print_stages(picture);
  if (picture.ray_kinds) print_rays(*picture.ray_kinds, picture.sampling_seconds);
  if (json) print_json(to_json(picture));
  if (!picture.interrupted) return ExitCode::ok;
  fmt::print(stderr, "eyeray: {}\n", what_was_kept(picture, !request.aovs.empty()));
  return ExitCode::interrupted;
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand("render", "Render a scene to picture files.");
  const auto options = std::make_shared<RenderCommand>();
  options->request.add_to(*command);
  add_long_render_options(*command, options->request.long_render);
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
      "  eyeray render scenes/whitted.toml --spp 10000 --checkpoint long.part    and, after Ctrl-C, --resume "
      "long.part\n"
      "Ctrl-C keeps what was rendered so far, if every pixel has a sample.");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::cli
