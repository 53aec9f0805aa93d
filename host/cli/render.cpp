// eyeray render: a scene becomes picture files.
#include <nlohmann/json.hpp>

#include "cli/picture.hpp"

namespace eyeray::cli {
namespace {

struct Command {
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

ExitCode Command::run() {
  request.check_outputs();
  const Picture picture = make_picture(request, progress_reporter(quiet));

  if (const std::string warning = flag_warning(picture); !warning.empty())
    fmt::print(stderr, "eyeray: warning: {}\n", warning);
  if (picture.interrupted && picture.files.empty())
    throw Error(ExitCode::interrupted, "interrupted before every pixel had a sample; nothing was kept");
  if (!quiet) fmt::print(stderr, "{}\n", summary(picture));
  if (stats) print_stages(picture);
  if (json) print_json(to_json(picture));
  if (!picture.interrupted) return ExitCode::ok;
  fmt::print(stderr, "eyeray: interrupted; {} of {} samples a pixel were kept{}\n", picture.samples_done,
             picture.samples, request.aovs.empty() ? "" : ", and no AOVs");
  return ExitCode::interrupted;
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand("render", "Render a scene to picture files.");
  const auto options = std::make_shared<Command>();
  options->request.add_to(*command);
  command->add_flag("--stats", options->stats, "Print how long each stage took.");
  command->add_flag("-q,--quiet", options->quiet, "No progress and no summary; warnings and errors remain.");
  command->add_flag("--json", options->json, "Say what was done as JSON on standard output.");
  command->footer(
      "Examples:\n"
      "  eyeray render scenes/whitted.toml                                   whitted.png\n"
      "  eyeray render scenes/whitted.toml -s 1920x1080 --spp 16 -o big.png -o big.pfm\n"
      "  eyeray render scenes/whitted.toml -D render.max_depth=2 --aov depth,normal\n"
      "Ctrl-C keeps what was rendered so far, if every pixel has a sample.");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::cli
