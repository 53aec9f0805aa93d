// eyeray run: a compute kernel of the user's, on a device or by the emulator (docs/kernel-files.md).
#include "host/compute/run.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "host/cli/command.hpp"
#include "host/compute/summary.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/standard_streams.hpp"
#include "host/executors/executors.hpp"
#include "host/executors/open_device.hpp"
#include "host/program/json.hpp"
#include "host/program/option_values.hpp"

namespace eyeray::engine::cli {
namespace {

struct RunCommand {
  std::string file;
  std::string groups;
  std::string entry;
  std::vector<std::string> defines;
  std::vector<std::string> outputs;
  std::string backend = "gpu";
  executors::ExecutorOptions executor;
  bool json = false;

  ExitCode run() const;
  std::vector<std::string> overrides() const;
  void set_outputs(compute::Job& job) const;
};

// All options that change the kernel file, as values of its keys.
std::vector<std::string> RunCommand::overrides() const {
  std::vector<std::string> all = defines;
  if (!groups.empty()) all.push_back(fmt::format("groups=[{}]", groups));
  if (!entry.empty()) all.push_back("entry=" + toml_string(entry));
  return all;
}

void RunCommand::set_outputs(compute::Job& job) const {
  for (const std::string& output : outputs) {
    const size_t equals = output.find('=');
    if (equals == std::string::npos || equals + 1 == output.size())
      throw Error(ExitCode::bad_input, "-o must be NAME=FILE, such as Target=out.npy, not '{}'", output);
    compute::set_output(job, output.substr(0, equals), output.substr(equals + 1));
  }
}

Json to_json(const compute::Job& job, const compute::Outcome& outcome) {
  Json buffers = Json::array();
  for (size_t i = 0; i < job.buffers.size(); ++i) {
    const compute::JobBuffer& buffer = job.buffers[i];
    const compute::Summary summary = compute::summarise(*buffer.type, outcome.buffers[i]);
    const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
    buffers.push_back({{"name", buffer.slot.name},
                       {"set", buffer.slot.set},
                       {"binding", buffer.slot.binding},
                       {"type", summary.type},
                       {"numbers", summary.numbers},
                       {"min", number(summary.min)},
                       {"max", number(summary.max)},
                       {"mean", number(summary.mean)},
                       {"nan", summary.nan},
                       {"first", summary.first},
                       {"output", buffer.output.string()}});
  }
  Json findings = Json::array();
  for (const emulator::Finding& each : outcome.findings) findings.push_back(emulator::describe(each));
  return {{"kernel", job.kernel},         {"executor", outcome.description}, {"groups", job.groups},
          {"local_size", job.local_size}, {"seconds", outcome.seconds},      {"buffers", buffers},
          {"findings", findings}};
}

void print_text(const compute::Job& job, const compute::Outcome& outcome) {
  print_lines(stdout, "{}, {}\n  {} ({:.3g} s)\n", job.kernel, compute::describe_dispatch(job),
              outcome.description, outcome.seconds);
  for (size_t i = 0; i < job.buffers.size(); ++i) {
    const compute::JobBuffer& buffer = job.buffers[i];
    print_lines(stdout, "  {} (set {}, binding {}), {}{}\n", buffer.slot.name, buffer.slot.set,
                buffer.slot.binding, compute::to_text(compute::summarise(*buffer.type, outcome.buffers[i])),
                buffer.output.empty() ? "" : " → " + buffer.output.string());
  }
  for (const emulator::Finding& each : outcome.findings)
    print_lines(stdout, "  {}\n", emulator::describe(each));
}

ExitCode RunCommand::run() const {
  compute::Job job = compute::load_job(file, overrides());
  set_outputs(job);
  for (const Diagnostic& warning : job.warnings) print_lines(stderr, "{}\n", format_diagnostic(warning));
  compute::RunOptions how{executors::device_options(executor.gpu, false), executor.gpu.fast_math};
  how.device.emulate = backend == "emulator";
  const compute::Outcome outcome = compute::run(job, how);
  compute::write_outputs(job, outcome);
  for (const std::string& message : outcome.validation_messages) print_lines(stderr, "{}\n", message);
  if (json)
    print_json(to_json(job, outcome));
  else
    print_text(job, outcome);
  return ExitCode::ok;
}

}  // namespace

void add_run(CLI::App& app, Run& run) {
  CLI::App* const command =
      app.add_subcommand("run", "Run a compute kernel of your own, on a device or by the emulator.");
  const auto options = std::make_shared<RunCommand>();
  command
      ->add_option("KERNEL", options->file,
                   "The kernel: GLSL (.comp, .glsl), HLSL (.hlsl) or SPIR-V (.spv); or a kernel file (.toml, "
                   "docs/kernel-files.md), which sets its data, too.")
      ->required();
  const auto add = [&](const char* name, auto& value, const char* text, const char* description) {
    return command->add_option(name, value, description)->option_text(text);
  };
  add("--groups", options->groups, "X,Y,Z", "Work groups along each axis.")
      ->check([](const std::string& text) {
        const bool numbers = !text.empty() && text.find_first_not_of("0123456789,") == std::string::npos;
        return numbers ? "" : fmt::format("must be whole numbers X,Y,Z, such as 8,8,1, not '{}'", text);
      });
  add("-D,--define", options->defines, "KEY=VALUE",
      "Set a key of the kernel file: push.scale=2, constants.N=16, buffer.Source.file=in.npy. May be "
      "repeated.")
      ->allow_extra_args(false)
      ->take_all();
  add("-o,--output", options->outputs, "NAME=FILE",
      "Write a buffer or an image after the run: .npy, .bin, .csv, .png, .pfm, .hdr or .exr. May be "
      "repeated.")
      ->allow_extra_args(false)
      ->take_all();
  add("--entry", options->entry, "NAME", "The entry point, if the kernel has several.");
  command
      ->add_option("--backend", options->backend,
                   "The executor: gpu, or emulator, which finds faults in the kernel.")
      ->option_text("NAME=gpu")
      ->group("Device")
      ->check(one_of({"gpu", "emulator"}));
  add_device_options(*command, options->executor);
  command->add_flag("--json", options->json, "Answer as JSON on standard output.");
  command->footer(
      "Buffers that nothing sets get seeded noise, and one element for each invocation.\n"
      "Examples:\n"
      "  eyeray run examples/kernels/blur.comp --groups 8,8 --backend emulator\n"
      "  eyeray run examples/kernels/blur.toml -o Target=blurred.png");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::engine::cli
