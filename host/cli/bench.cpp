// eyeray bench: how long whole runs and their stages take, and how many rays a second that is. It measures;
// it never judges.
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "cli/bench_runs.hpp"
#include "cli/command.hpp"
#include "cli/json.hpp"

namespace fs = std::filesystem;

namespace eyeray::cli {
namespace {

constexpr std::string_view default_scene = "scenes/whitted.toml";

// A folder that is gone at the end.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "eyeray-bench-XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw Error(ExitCode::file_io, "cannot make a folder in {}: {}", fs::temp_directory_path().string(),
                  strerror(errno));
    path_ = name;
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

struct Command {
  std::vector<std::string> scenes;
  std::vector<std::string> backends{"gpu"};
  std::vector<std::string> defines;
  std::string device = "auto";
  int width = 1024;
  int height = 1024;
  int samples = 1;
  int runs = 5;
  bool povray = true;
  bool start = true;
  bool json = false;

  ExitCode run();

 private:
  std::vector<std::string> arguments(const std::string& scene, const std::string& backend) const;
  std::vector<Series> measure(const std::string& scene) const;
  std::vector<Series> measure_start(const std::string& scene) const;
};

// The same scene as POV-Ray reads it: whitted.pov beside whitted.toml or in a bench folder next to its own.
std::optional<fs::path> povray_scene(const fs::path& scene) {
  const fs::path name = scene.filename().replace_extension(".pov");
  for (const fs::path& folder : {scene.parent_path(), scene.parent_path() / ".." / "bench"}) {
    if (fs::exists(folder / name)) return folder / name;
  }
  return std::nullopt;
}

std::vector<std::string> Command::arguments(const std::string& scene, const std::string& backend) const {
  std::vector<std::string> words{
      scene, "--backend", backend, "--device", device, "--spp", std::to_string(samples)};
  for (const std::string& define : defines) words.insert(words.end(), {"-D", define});
  return words;
}

// All contenders take turns, so that a change of the machine's mood meets them all.
std::vector<Series> Command::measure(const std::string& scene) const {
  const Scratch scratch;
  const std::optional<fs::path> pov = povray && have_povray() ? povray_scene(scene) : std::nullopt;
  std::vector<Series> all;
  for (const std::string& backend : backends) all.push_back({backend, {}});
  if (pov) all.push_back({"povray", {}});

  const std::string size = fmt::format("{}x{}", width, height);
  const auto run_once = [&](const std::string& name) {
    if (name == "povray") return run_povray(*pov, width, height, scratch.path() / "povray.png");
    std::vector<std::string> words = arguments(scene, name);
    words.insert(words.end(), {"-s", size});
    return run_eyeray(words, scratch.path() / "eyeray.png");
  };
  if (backends.front() == "gpu") run_once("gpu");  // fills the caches
  for (int i = 0; i < runs; ++i) {
    for (Series& series : all) series.runs.push_back(run_once(series.name));
  }
  return all;
}

// From nothing to a written 640×480 picture, without and with what earlier runs left in the caches.
std::vector<Series> Command::measure_start(const std::string& scene) const {
  Series cold{"cold start", {}}, warm{"warm start", {}};
  std::vector<std::string> words = arguments(scene, "gpu");
  words.insert(words.end(), {"-s", "640x480"});
  for (int i = 0; i < runs; ++i) {
    const Scratch caches;
    const Environment environment{{"EYERAY_CACHE_DIR", caches.path() / "eyeray"},
                                  {"MESA_SHADER_CACHE_DIR", caches.path() / "mesa"}};
    cold.runs.push_back(run_eyeray(words, caches.path() / "picture.png", environment));
    warm.runs.push_back(run_eyeray(words, caches.path() / "picture.png", environment));
  }
  return {cold, warm};
}

std::string format_spread(const Spread& spread) {
  return fmt::format("{:>10}   {} … {}", format_seconds(spread.median), format_seconds(spread.min),
                     format_seconds(spread.max));
}

void print_series(const Series& series) {
  const TimedRun& last = series.runs.back();
  const bool named = last.device.starts_with(series.name + ":");
  fmt::print("\n{}\n", named ? last.device : fmt::format("{} ({})", series.name, last.device));
  for (const auto& [stage, seconds] : last.seconds)
    fmt::print("  {:<16} {}\n", stage, format_spread(stage_spread(series, stage)));
  if (last.rays > 0)
    fmt::print("  {:<16} {:>10}   {}\n", "rays", last.rays,
               format_rate(double(last.rays) / tracing_spread(series).median));
}

// How much less time the gpu takes than POV-Ray: tracing alone, and the whole process.
std::optional<std::pair<double, double>> povray_ratio(const std::vector<Series>& all) {
  const auto named = [&](std::string_view name) {
    return std::find_if(all.begin(), all.end(), [&](const Series& each) { return each.name == name; });
  };
  const auto gpu = named("gpu");
  const auto pov = named("povray");
  if (gpu == all.end() || pov == all.end()) return std::nullopt;
  return std::pair{tracing_spread(*pov).median / tracing_spread(*gpu).median,
                   stage_spread(*pov, "whole process").median / stage_spread(*gpu, "whole process").median};
}

Json to_json(const Spread& spread) {
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

Json to_json(const Series& series) {
  Json stages = Json::object();
  for (const auto& [stage, seconds] : series.runs.back().seconds)
    stages[stage] = to_json(stage_spread(series, stage));
  Json json{{"name", series.name},
            {"device", series.runs.back().device},
            {"seconds", stages},
            {"tracing", to_json(tracing_spread(series))}};
  if (series.runs.back().rays > 0) {
    json["rays"] = series.runs.back().rays;
    json["rays_per_second"] = double(series.runs.back().rays) / tracing_spread(series).median;
  }
  return json;
}

ExitCode Command::run() {
  if (scenes.empty() && fs::exists(default_scene)) scenes.emplace_back(default_scene);
  if (scenes.empty())
    throw Error(ExitCode::bad_input, "no scene given, and there is no {} here", default_scene);
  for (const std::string& backend : backends) parse_backend(backend);

  Json report = Json::array();
  for (const std::string& scene : scenes) {
    std::vector<Series> all = measure(scene);
    const auto ratio = povray_ratio(all);
    if (!json)
      fmt::print("{}: {}×{}, {} sample{} a pixel; median, least … greatest of {} runs\n", scene, width,
                 height, samples, samples == 1 ? "" : "s", runs);
    if (start) {
      for (Series& series : measure_start(scene)) all.push_back(std::move(series));
    }
    Json entry{{"scene", scene},     {"width", width}, {"height", height},
               {"samples", samples}, {"runs", runs},   {"series", Json::array()}};
    for (const Series& series : all) {
      entry["series"].push_back(to_json(series));
      if (!json) print_series(series);
    }
    if (ratio) {
      entry["times_faster_than_povray"] = {{"tracing", ratio->first}, {"whole process", ratio->second}};
      if (!json)
        fmt::print("\nPOV-Ray : gpu = {:.2f} (tracing alone), {:.2f} (whole process)\n", ratio->first,
                   ratio->second);
    }
    report.push_back(std::move(entry));
  }
  if (json) print_json({{"bench", report}});
  return ExitCode::ok;
}

}  // namespace

void add_bench(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand("bench", "Measure whole runs and their stages.");
  const auto options = std::make_shared<Command>();
  command->add_option("SCENE", options->scenes, "Scene files; scenes/whitted.toml when none is given.")
      ->option_text(" ");
  command->add_option("-n,--runs", options->runs, "Measured runs of each.")
      ->option_text("N=5")
      ->check(CLI::Range(1, 1000));
  command->add_option("--backends", options->backends, "Out of gpu, twin and reference.")
      ->option_text("LIST=gpu")
      ->delimiter(',')
      ->allow_extra_args(false);
  const auto parse = [options](const std::string& text) {
    std::tie(options->width, options->height) = parse_size(text);
  };
  command->add_option_function<std::string>("-s,--size", parse, "Picture size in pixels.")
      ->option_text("WxH=1024x1024");
  command->add_option("--spp", options->samples, "Samples a pixel.")
      ->option_text("N=1")
      ->check(CLI::Range(1, 65536));
  command->add_option("-D,--define", options->defines, "Lay a value over the scenes, as for render.")
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--device", options->device, "As for render.")->option_text("WHICH");
  command->add_flag_callback(
      "--no-povray", [options] { options->povray = false; },
      "Leave POV-Ray out, which else runs when installed and SCENE.pov is there.");
  command->add_flag_callback(
      "--no-start", [options] { options->start = false; }, "Leave cold and warm starts out.");
  command->add_flag("--json", options->json, "Answer as JSON on standard output.");
  command->footer(
      "Every run is a process of its own, and contenders take turns. A cold start has empty caches; both "
      "starts go\n"
      "from nothing to a written 640x480 picture. bench/whitted.pov is the same scene written for POV-Ray.\n"
      "Example: eyeray bench scenes/whitted.toml -n 9 --backends gpu,twin,reference");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::cli
