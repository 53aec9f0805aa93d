// eyeray-bench: rays a second and whole pictures, as tables and JSON. It measures; it never judges.
#include "benchmarks/bench/bench.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <tuple>

#include "benchmarks/bench/dev_loop.hpp"
#include "benchmarks/bench/processes.hpp"
#include "benchmarks/bench/standard_scenes.hpp"
#include "host/core/standard_streams.hpp"
#include "host/core/termination.hpp"
#include "host/executors/executor.hpp"
#include "host/image/image_file.hpp"
#include "host/program/bar.hpp"
#include "host/program/integers.hpp"
#include "host/program/json.hpp"
#include "host/program/main.hpp"
#include "host/program/option_values.hpp"
#include "host/program/usage.hpp"

namespace eyeray::engine::bench_cli {
namespace {

using namespace program;

struct BenchCommand {
  bool dev = false;
  int frames = 0, shards = 0;  // unless 0: measure only this many frames or shards
  bool with_paths = false;
  bench::PathOptions paths;
  bench::Options options;
  std::string older;
  bool json = false;
  bool sized = false;    // whether the user set the size
  bool sampled = false;  // whether the user set the number of samples

  ExitCode run() const;
  bench::PathOptions path_options() const;
  bench::ProcessReport process_report() const;
};

// Options given for pictures hold for paths too. Paths have their own values for options that are not given.
bench::PathOptions BenchCommand::path_options() const {
  const bench::PictureOptions& pictures = options.pictures;
  bench::PathOptions result = paths;
  result.defines = pictures.defines;
  result.device = pictures.device;
  result.runs = std::max(2, pictures.runs);
  if (sized) result.width = pictures.width, result.height = pictures.height;
  if (sampled) result.most_samples = pictures.samples;
  return result;
}

bench::ProcessReport BenchCommand::process_report() const {
  if (options.scenes.size() > 1)
    throw Error(ExitCode::bad_input, "{} is of one scene", frames > 0 ? "--frames" : "--shards");
  const bench::PictureOptions& pictures = options.pictures;
  const auto scene = [&](std::string_view otherwise) {
    return options.scenes.empty() ? std::string(otherwise) : options.scenes[0];
  };
  if (frames > 0) return bench::measure_frames(scene("scenes/animation.toml"), frames, pictures.defines);
  return bench::measure_shards(scene(bench::default_scene), shards, pictures.width, pictures.height,
                               pictures.samples, pictures.defines);
}

ExitCode BenchCommand::run() const {
  // The bar is shown until there is something to print.
  const auto wait = [] { return show_compiling(", then measuring"); };
  std::shared_ptr<void> waiting = wait();
  const auto say = [&](const auto& report) {
    waiting.reset();
    if (json)
      print_json(bench::to_json(report));
    else
      print_lines(stdout, "{}", bench::to_text(report));
    return ExitCode::ok;
  };
  if (dev) return say(bench::measure_dev_loop(options.pictures.runs));
  if (frames > 0 || shards > 0) return say(process_report());
  // Check everything that may be wrong before measuring for minutes.
  for (const std::string& backend : options.pictures.backends) executors::parse_backend(backend);
  const bench::Report old = older.empty() ? bench::Report() : bench::read_report(older);

  const auto print = [&](const std::string& text) {
    if (json) return;
    waiting.reset();
    print_lines(stdout, "{}", text);
    std::fflush(stdout);
    waiting = wait();
  };
  bench::Options what = options;
  if (with_paths || paths.cycles || paths.povray) what.paths = path_options();
  const bench::Report report = bench::measure(
      what, {.rays = [&](const bench::SceneReport& scene) { print(bench::to_text({scene})); },
             .picture = [&](const bench::PictureReport& picture) { print(bench::to_text(picture)); },
             .paths = [&](const bench::PathReport& each) { print(bench::to_text(each)); },
             .remark =
                 [&](const std::string& text) {
                   waiting.reset();
                   print_lines(stderr, "eyeray-bench: {}\n", text);
                   waiting = wait();
                 }});
  waiting.reset();

  if (!older.empty() && !json) {
    const std::string changed = bench::changes(old, report);
    print_lines(stdout, "since {}:\n{}", older, changed.empty() ? "nothing in common\n" : changed);
  }
  if (json) print_json(bench::to_json(report));
  return ExitCode::ok;
}

constexpr const char* footer =
    "Rays: from the eye, to the light, and bounced once, on the same rays as Embree's, in turns.\n"
    "Pictures: every run is a process of its own, and contenders take turns. A cold start has empty "
    "caches;\n"
    "both starts go from nothing to a written 640x480 picture. bench/whitted.pov is that scene for "
    "POV-Ray;\n"
    "standard scenes and meshes are written out for it. What takes long is run once.\n"
    "Example: eyeray-bench scenes/whitted.toml -n 9 --backends gpu,twin,reference\n"
    "         eyeray-bench --no-pictures --json > rays.json; scripts/plot-bench rays.json rays.svg";

void add_options(CLI::App& app, BenchCommand& command) {
  bench::Options& what = command.options;
  bench::PictureOptions& pictures = what.pictures;
  std::string names;
  for (const bench::StandardScene& standard : bench::standard_scenes())
    names += (names.empty() ? "" : ", ") + std::string(standard.name);
  app.add_option(
         "SCENE", what.scenes,
         fmt::format("Scene files, or out of {}; all of these and {} when none is given, of --paths {}.",
                     names, bench::default_scene, bench::path_scene))
      ->option_text(" ");
  app.add_option("-n,--runs", pictures.runs, "The number of measured runs of each.")
      ->option_text("N=5")
      ->check(whole_within(1, 1000));
  app.add_option("--backends", pictures.backends, "The executors: gpu, twin, reference.")
      ->option_text("LIST=gpu")
      ->delimiter(',')
      ->allow_extra_args(false);
  const auto set_size = [&command](const std::string& text) {
    std::tie(command.options.pictures.width, command.options.pictures.height) = parse_size(text);
    command.sized = true;
    if (!image::image_size_allowed(command.options.pictures.width, command.options.pictures.height))
      throw Error(ExitCode::bad_input, "--size {}: a picture has 1 to 65536 pixels a side, 2^28 in all",
                  text);
  };
  app.add_option_function<std::string>("-s,--size", set_size, "Picture size in pixels.")
      ->option_text("WxH=1024x1024");
  app.add_option_function<int>(
         "--spp",
         [&command](int samples) {
           command.options.pictures.samples = samples;
           command.sampled = true;
         },
         "Samples a pixel of whole pictures; for --paths the maximum, 64 by default.")
      ->option_text("N=1")
      ->check(whole_within(1, 65536));
  app.add_option("-D,--define", pictures.defines, "Lay a value over the scene files, as for render.")
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false)
      ->take_all();
  app.add_option("--device", pictures.device, "As for render.")->option_text("WHICH");
  app.add_option("--incoherent", what.incoherent,
                 "The ways in which gpu traces incoherent rays: cooperative (four lanes a ray), lanes, "
                 "packets. Each is measured by itself.")
      ->option_text("LIST")
      ->check(one_of({"cooperative", "lanes", "packets"}))
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_flag_callback(
      "--no-rays", [&command] { command.options.with_rays = false; }, "Whole pictures only.");
  app.add_flag_callback("--no-pictures", [&command] { command.options.with_pictures = false; }, "Rays only.");
  app.add_flag_callback(
      "--no-povray", [&command] { command.options.pictures.povray = false; },
      "Leave POV-Ray out. By default it runs if it is installed, on SCENE.pov or on a scene written for it.");
  app.add_flag_callback(
      "--no-start", [&command] { command.options.pictures.start = false; },
      "Leave cold and warm starts out.");
  app.add_option("--compare", command.older, "Report what changed since an older answer of --json.")
      ->option_text("OLD.json");
  app.add_flag("--paths", command.with_paths,
               "Measure only how fast path-traced pictures of 256x256 lose noise, with 4, 16, ... samples "
               "and another seed for each run.");
  app.add_option("--clamp", command.paths.clamp, "Cut every sample of --paths, as render does.")
      ->option_text("X")
      ->check(within(1e-6, 1e15));
  app.add_flag("--cycles", command.paths.cycles,
               "Measure --paths beside Blender's Cycles, and whether both show the same light.");
  app.add_flag("--radiosity", command.paths.povray, "Measure --paths beside POV-Ray's radiosity.");
  app.add_flag("--dev", command.dev,
               "Measure only the time of eyeray dev from a save to new pixels, over -n edits of each kind.");
  app.add_option("--frames", command.frames,
                 "Measure only the first N frames of SCENE, or of scenes/animation.toml, in one process and "
                 "in one process each.")
      ->option_text("N")
      ->check(whole_within(1, 100000));
  app.add_option("--shards", command.shards,
                 "Measure only SCENE, with --size and --spp, as N shards and their merge, one after the "
                 "other, beside one process.")
      ->option_text("N")
      ->check(whole_within(1, 10000))
      ->excludes("--frames");
  app.add_flag("--json", command.json, "Answer as JSON on standard output.");
}

int run_command_line(int argc, char** argv) {
  CLI::App app;
  describe(app, "eyeray-bench", "eyeray-bench: measures eyeray's rays a second and whole pictures.", footer);
  BenchCommand command;
  add_options(app, command);
  if (const std::optional<int> code = parse(app, argc, argv)) return *code;
  warn_of_caches();
  return exit_status(command.run());
}

}  // namespace
}  // namespace eyeray::engine::bench_cli

int main(int argc, char** argv) {
  return eyeray::engine::program::run_main(argc, argv, "eyeray-bench",
                                           eyeray::engine::bench_cli::run_command_line);
}
