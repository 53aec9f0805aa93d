// eyeray: reads the command line and runs one command.
#include <CLI/CLI.hpp>
#include <string_view>

#include "host/cli/command.hpp"
#include "host/core/termination.hpp"
#include "host/program/main.hpp"
#include "host/program/usage.hpp"

namespace eyeray::engine::cli {
namespace {

constexpr const char* footer =
    "First picture:   eyeray render scenes/whitted.toml -o whitted.png\n"
    "Proof:           eyeray verify scenes/whitted.toml\n"
    "Exit codes: 0 ok, 1 a comparison failed, 2 bad usage, scene or shader,\n"
    "            3 no usable Vulkan device, 4 file input or output, 5 time-out,\n"
    "            6 a checkpoint that cannot be resumed, 70 a bug in eyeray,\n"
    "            128 + N ended by signal N.\n"
    "Data goes to standard output, messages to standard error. With --json, a failure\n"
    "is JSON, too: {\"error\": ...}.";

// Refuses `bench`, a command of former versions that users may still type, and names its successor. No list
// shows it.
void name_bench(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("bench")->group("")->allow_extras();
  command->set_help_flag();
  command->parse_complete_callback([] {
    throw Error(ExitCode::bad_input,
                "eyeray bench is now a separate program, eyeray-bench, which is not installed: build it from "
                "source with scripts/build release eyeray-bench");
  });
}

// True for commands with --device, except for dev's worker: it belongs to a command that warns already.
bool warns_of_caches(const CLI::App& command) {
  const CLI::Option* const worker = command.get_option_no_throw("--worker-socket");
  return command.get_option_no_throw("--device") && (!worker || worker->count() == 0);
}

// The words after -- of `eyeray slurm`, which are for sbatch; removes them from argc.
std::vector<std::string> take_sbatch_words(int& argc, char** argv) {
  std::vector<std::string> words;
  if (argc < 2 || std::string_view(argv[1]) != "slurm") return words;
  for (int i = 2; i < argc; ++i) {
    if (std::string_view(argv[i]) != "--") continue;
    words.assign(argv + i + 1, argv + argc);
    argc = i;
  }
  return words;
}

// `--denoise oidn` names the denoiser. CLI11 gives no words to an option that needs none.
void name_denoiser(int argc, char** argv) {
  static char option[] = "--denoiser";
  for (int i = 1; i + 1 < argc; ++i)
    if (argv[i] == std::string_view("--denoise") && argv[i + 1] == std::string_view("oidn")) argv[i] = option;
}

int run_command_line(int argc, char** argv) {
  const std::vector<std::string> sbatch_words = take_sbatch_words(argc, argv);
  name_denoiser(argc, argv);
  CLI::App app;
  program::describe(app, "eyeray",
                    "eyeray: a ray tracer on Vulkan compute shaders, checked pixel by pixel against the CPU.",
                    footer);
  app.set_help_flag("-h,--help", "Print this help; every command has its own.");
  Run run;
  add_render(app, run);
  add_merge(app, run);
  add_verify(app, run);
  add_run(app, run);
  add_compare(app, run);
  add_probe(app, run);
  add_check(app, run);
  add_dev(app, run);
  add_devices(app, run);
  add_generate(app, run);
  add_shaders(app, run);
  add_kernels(app, run);
  add_slurm(app, run, sbatch_words);
  add_new(app, run);
  add_completion(app, run);
  add_manual(app, run);
  name_bench(app);

  if (const std::optional<int> code = program::parse(app, argc, argv)) return *code;
  if (!run) {
    fmt::print(stderr, "{}", app.help());
    return int(ExitCode::bad_input);
  }
  if (warns_of_caches(named_command(app))) warn_of_caches();
  return exit_status(run());
}

}  // namespace
}  // namespace eyeray::engine::cli

int main(int argc, char** argv) {
  return eyeray::engine::program::run_main(argc, argv, "eyeray", eyeray::engine::cli::run_command_line);
}
