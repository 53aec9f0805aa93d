// eyeray probe: the rays of one pixel, by every executor (docs/report.md, the probe), or one invocation of a
// kernel, line by line (docs/kernel-files.md).
#include "host/probe/probe.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "host/cli/command.hpp"
#include "host/cli/probe_kernel.hpp"
#include "host/compute/job.hpp"
#include "host/core/option_text.hpp"
#include "host/program/option_values.hpp"

namespace eyeray::engine::cli {
namespace {

struct ProbeCommand {
  SceneOptions scene_options;
  probe::Options options;
  std::string pixel;   // or the invocation of a kernel
  std::string follow;  // a kernel's variable
  bool backends_given = false;
  bool json = false;

  ExitCode run();
};

ExitCode ProbeCommand::run() {
  if (compute::is_job(scene_options.file())) {
    if (options.sample)
      throw Error(ExitCode::bad_input, "--sample {}: a kernel has no samples", *options.sample);
    return probe_kernel({.file = scene_options.file(),
                         .defines = scene_options.defines(),
                         .invocation = pixel,
                         .follow = follow,
                         .backends = backends_given ? options.backends : std::vector<executors::Backend>(),
                         .json = json},
                        options.executor);
  }
  if (!follow.empty())
    throw Error(ExitCode::bad_input, "--follow {}: it follows a variable of a kernel, and {} is a scene",
                follow, scene_options.file());
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
      "Show all rays of one pixel, as GPU, twin and reference trace them, and their first difference; or of "
      "a kernel each line that one invocation runs, with its values.");
  const auto options = std::make_shared<ProbeCommand>();
  options->scene_options.add_to(*command);
  command
      ->add_option("PIXEL", options->pixel,
                   "The pixel as X,Y from the picture's top left, as verify reports it; of a kernel the "
                   "invocation as X,Y,Z, its gl_GlobalInvocationID.")
      ->required();
  add_executor_options(*command, options->options.executor);
  const auto parse = [options](const std::string& list) {
    options->options.backends = parse_backends(list);
    options->backends_given = true;
  };
  command
      ->add_option_function<std::string>(
          "--backends", parse,
          "The executors whose rays are shown; of a kernel gpu,emulator, or emulator alone.")
      ->option_text("LIST=gpu,twin,reference")
      ->group("Device");
  command
      ->add_option("--sample", options->options.sample,
                   "The sample of the pixel, from 0. Default: the first that differs.")
      ->option_text("N")
      ->check(whole_within(0, 65535));
  command
      ->add_option("--follow", options->follow,
                   "Show only the lines of a kernel that access this variable, buffer or element, such as "
                   "list[3].")
      ->option_text("NAME");
  command->add_flag("--json", options->json, "Answer as JSON.");
  command->footer(
      "Examples:\n"
      "  eyeray probe scenes/whitted.toml 320,240\n"
      "  eyeray probe scenes/whitted.toml -s 96x72 48,45 --shaders my-shaders --backends gpu,reference\n"
      "  eyeray probe examples/kernels/prefix_sum.toml 5,0,0 --follow list\n"
      "PROBE(name, value); in a shader adds a line.\n"
      "Exit code 0 when nothing differs, 1 when something does.");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::engine::cli
