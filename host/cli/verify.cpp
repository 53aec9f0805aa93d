// eyeray verify: gpu, twin and reference on one scene after the other (docs/verification.md).
#include "host/verify/verify.hpp"

#include <algorithm>

#include "host/cli/command.hpp"
#include "host/cli/within.hpp"
#include "host/loader/scene_edit.hpp"

namespace fs = std::filesystem;

namespace eyeray::cli {
namespace {

constexpr double most_explained = 0.05;

struct Command {
  SceneOptions scene_options;
  std::vector<std::string> more_scenes;
  verify::Options options;
  std::string keep;
  bool quiet = false;
  bool json = false;
  bool record = false;

  void record_allowance(compare::Report& report) const;
  ExitCode run();
  compare::Report report_on(const SceneOptions& scene_file) const;
  fs::path folder_for(const std::string& scene) const;
};

// "gpu,twin".
std::vector<executors::Backend> parse_backends(const std::string& list) {
  std::vector<executors::Backend> backends;
  for (size_t begin = 0; begin <= list.size();) {
    const size_t end = std::min(list.find(',', begin), list.size());
    const executors::Backend backend = executors::parse_backend(list.substr(begin, end - begin));
    begin = end + 1;
    if (backend == executors::Backend::reference) {
      throw Error(ExitCode::bad_input,
                  "--backends names what is compared with the reference: gpu, twin or gpu,twin");
    }
    if (std::find(backends.begin(), backends.end(), backend) == backends.end()) backends.push_back(backend);
  }
  return backends;
}

fs::path Command::folder_for(const std::string& scene) const {
  const std::string stem = fs::path(scene).stem().string();
  if (keep.empty()) return stem + ".verify";
  return more_scenes.empty() ? fs::path(keep) : fs::path(keep) / stem;
}

compare::Report Command::report_on(const SceneOptions& scene_file) const {
  const Scene scene = scene_file.load();
  check_crop(options.crop, scene.image);
  return verify::verify_scene(
      {scene, scene_file.file(), scene_file.as_written(), folder_for(scene_file.file())}, options);
}

void Command::record_allowance(compare::Report& report) const {
  const std::optional<double> allowance = report.healthy_allowance();
  if (!allowance) return;
  const std::string share = *allowance > 0 ? fmt::format("{:.5f}", *allowance) : "0";
  loader::set_value(report.scene, "verify", "max_explained", share);
  fmt::print(stderr, "eyeray: recorded max_explained = {} in {}\n", share, report.scene);
}

ExitCode Command::run() {
  if (record) {
    if (const std::string changed = scene_options.as_written();
        !changed.empty() || options.crop.pixels() > 0 || options.max_explained)
      throw Error(ExitCode::bad_input, "--record takes scenes as their files say: leave out{}",
                  changed.empty() ? " --crop and --max-explained" : changed);
    options.max_explained = most_explained;
  }
  options.progress = [this] { return progress_reporter(quiet); };
  std::vector<std::string> files{scene_options.file()};
  files.insert(files.end(), more_scenes.begin(), more_scenes.end());

  std::vector<compare::Report> reports;
  for (const std::string& file : files) {
    reports.push_back(report_on(scene_options.for_file(file)));
    if (record) record_allowance(reports.back());
    if (!json) fmt::print("{}", to_text(reports.back()));
  }
  if (json) {
    fmt::print("{}", to_json(reports));
  } else if (reports.size() > 1) {
    fmt::print("{}", summary(reports));
  }
  const bool passed =
      std::all_of(reports.begin(), reports.end(), [](const compare::Report& r) { return r.passes(); });
  return passed ? ExitCode::ok : ExitCode::comparison_failed;
}

}  // namespace

void add_verify(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand(
      "verify", "Check the GPU's pixels against the CPU, bit by bit and against the reference.");
  const auto options = std::make_shared<Command>();
  verify::Options& how = options->options;
  options->scene_options.add_to(*command);
  command->add_option("MORE", options->more_scenes, "Further scenes, under the same options.")
      ->option_text(" ");
  add_crop_option(*command, how.crop);
  add_executor_options(*command, how.executor);
  const auto parse = [&how](const std::string& list) { how.backends = parse_backends(list); };
  command->add_option_function<std::string>("--backends", parse, "What is compared with the reference.")
      ->option_text("LIST=gpu,twin")
      ->group("Device");
  command
      ->add_option(
          "--max-explained", how.max_explained,
          "The share of pixels that may differ where the picture itself jumps, each gate's. Default: "
          "what the scene's [verify] says.")
      ->option_text("SHARE")
      ->check(within(0, most_explained));
  command->add_flag("--record", options->record,
                    "Where nothing else fails, write twice the share that is explained into the scene's "
                    "[verify].");
  command
      ->add_option(
          "--ulp", how.ulp,
          "How far GPU and twin may be apart, in units in the last place: for devices whose square root or "
          "division is not exact.")
      ->option_text("N=0")
      ->check(CLI::Range(0, 64));
  command
      ->add_option("--keep", options->keep,
                   "Where pictures are left when a gate fails. Default: SCENE.verify here.")
      ->option_text("DIR");
  command->add_flag("-q,--quiet", options->quiet, "No progress.");
  command->add_flag("--json", options->json, "Report as JSON.");
  command->footer(
      "Examples:\n"
      "  eyeray verify scenes/whitted.toml\n"
      "  eyeray verify scenes/*.toml -s 96x72 --json\n"
      "  eyeray verify scenes/whitted.toml --record     after a change that is meant\n"
      "Exit code 0 when every gate passes, 1 when one fails.");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::cli
