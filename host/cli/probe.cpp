// eyeray probe: the rays of one pixel, by every executor (docs/report.md, the probe).
#include "host/probe/probe.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "host/cli/command.hpp"
#include "host/core/option_text.hpp"
#include "host/program/option_values.hpp"

namespace eyeray::engine::cli {
namespace {

struct ProbeCommand {
  SceneOptions scene_options;
  probe::Options options;
  std::string pixel;
  bool json = false;

  ExitCode run();
};

ExitCode ProbeCommand::run() {
  const OptionBackends backends;
  std::tie(options.x, options.y) = parse_pixel(pixel);
  const Scene scene = scene_options.load();
  std::shared_ptr<void> compiling = show_compiling();
  const probe::Findings findings = probe::probe_pixel(scene, options);
  compiling.reset();
  const bool colored = isatty(STDOUT_FILENO) && !std::getenv("NO_COLOR");
  fmt::print("{}", json ? to_json(findings) : to_text(findings, colored));
  return findings.first_difference() ? ExitCode::comparison_failed : ExitCode::ok;
}

}  // namespace

void add_probe(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand(
      "probe",
      "Show all rays of one pixel, as GPU, twin and reference trace them, and their first difference.");
  const auto options = std::make_shared<ProbeCommand>();
  options->scene_options.add_to(*command);
  command
      ->add_option("PIXEL", options->pixel,
                   "The pixel as X,Y from the picture's top left, as verify reports it.")
      ->required();
  add_executor_options(*command, options->options.executor);
  const auto parse = [options](const std::string& list) { options->options.backends = parse_backends(list); };
  command->add_option_function<std::string>("--backends", parse, "The executors whose rays are shown.")
      ->option_text("LIST=gpu,twin,reference")
      ->group("Device");
  command
      ->add_option("--sample", options->options.sample,
                   "The sample of the pixel, from 0. Default: the first that differs.")
      ->option_text("N")
      ->check(whole_within(0, 65535));
  command->add_flag("--json", options->json, "Answer as JSON.");
  command->footer(
      "Examples:\n"
      "  eyeray probe scenes/whitted.toml 320,240\n"
      "  eyeray probe scenes/whitted.toml -s 96x72 48,45 --shaders my-shaders --backends gpu,reference\n"
      "PROBE(name, value); in a shader adds a line.\n"
      "Exit code 0 when nothing differs, 1 when something does.");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::engine::cli
