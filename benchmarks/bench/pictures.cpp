#include "benchmarks/bench/pictures.hpp"

#include <algorithm>
#include <optional>

#include "benchmarks/bench/programs.hpp"
#include "host/core/error.hpp"
#include "host/core/scratch_folder.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::bench {
namespace {

// A series whose first run takes longer is not repeated: POV-Ray parses a million triangles anew each time.
constexpr double longest_repeated_seconds = 6;

bool worth_repeating(const Series& series) {
  return series.runs.empty() || series.runs.front().seconds.front().second < longest_repeated_seconds;
}

// The scene's file for POV-Ray: whitted.pov beside whitted.toml or in a bench folder next to its own, or an
// exported file.
std::optional<fs::path> scene_for_povray(const fs::path& scene, const PictureOptions& options) {
  if (!options.povray || !have_povray()) return std::nullopt;
  const fs::path name = scene.filename().replace_extension(".pov");
  for (const fs::path& folder : {scene.parent_path(), scene.parent_path() / ".." / "bench"}) {
    if (fs::exists(folder / name)) return folder / name;
  }
  if (!options.povray_scene.empty()) return options.povray_scene;
  return std::nullopt;
}

std::vector<std::string> arguments(const fs::path& scene, const PictureOptions& options) {
  std::vector<std::string> words{scene.string(), "--device", options.device};
  words.insert(words.end(), {"--spp", std::to_string(options.samples)});
  for (const std::string& define : options.defines) words.insert(words.end(), {"-D", define});
  return words;
}

std::string size_of(const PictureOptions& options) {
  return fmt::format("{}x{}", options.width, options.height);
}

// The kernels of the pictures, as JSON.
std::string list_kernels(const fs::path& scene, const PictureOptions& options) {
  std::vector<std::string> words = arguments(scene, options);
  words.insert(words.begin(), "kernels");
  words.insert(words.end(), {"-s", size_of(options), "--json"});
  return run_eyeray(words).out;
}

// All contenders take turns, so that a change of the machine's speed affects them all.
std::vector<Series> measure(const fs::path& scene, const PictureOptions& options) {
  const ScratchFolder scratch;
  const std::optional<fs::path> pov = scene_for_povray(scene, options);
  std::vector<Series> all;
  for (const std::string& backend : options.backends) all.push_back({backend, {}});
  if (pov) all.push_back({"povray", {}});

  const auto run_once = [&](const std::string& name) {
    if (name == "povray")
      return run_povray(*pov, options.width, options.height, scratch.path() / "povray.png");
    std::vector<std::string> words = arguments(scene, options);
    words.insert(words.end(), {"--backend", name, "-s", size_of(options)});
    return run_render(words, scratch.path() / "eyeray.png");
  };
  if (options.backends.front() == "gpu") run_once("gpu");  // fills the caches
  for (int i = 0; i < options.runs; ++i) {
    for (Series& series : all)
      if (worth_repeating(series)) series.runs.push_back(run_once(series.name));
  }
  return all;
}

// Measures the time from nothing to a written 640×480 picture, without and with the caches of earlier runs.
std::vector<Series> measure_start(const fs::path& scene, const PictureOptions& options) {
  Series cold{"cold start", {}}, warm{"warm start", {}};
  std::vector<std::string> words = arguments(scene, options);
  words.insert(words.end(), {"-s", "640x480"});
  for (int i = 0; i < options.runs && worth_repeating(cold); ++i) {
    const ScratchFolder caches;
    const Environment environment{{"EYERAY_CACHE_DIR", caches.path() / "eyeray"},
                                  {"MESA_SHADER_CACHE_DIR", caches.path() / "mesa"}};
    cold.runs.push_back(run_render(words, caches.path() / "picture.png", environment));
    warm.runs.push_back(run_render(words, caches.path() / "picture.png", environment));
  }
  return {cold, warm};
}

SeriesReport report_on(const Series& series) {
  const TimedRun& last = series.runs.back();
  SeriesReport report{series.name, last.device, {}, tracing_spread(series), {}, last.rays};
  for (const auto& [stage, seconds] : last.seconds)
    report.stages.emplace_back(stage, stage_spread(series, stage));
  if (const Spread memory = memory_spread(series); memory.median > 0) report.peak_memory = memory;
  return report;
}

std::optional<PictureReport::PovrayRatio> povray_ratio(const std::vector<Series>& all) {
  const auto gpu = std::ranges::find(all, "gpu", &Series::name);
  const auto pov = std::ranges::find(all, "povray", &Series::name);
  if (gpu == all.end() || pov == all.end()) return std::nullopt;
  return PictureReport::PovrayRatio{
      tracing_spread(*pov).median / tracing_spread(*gpu).median,
      stage_spread(*pov, "whole process").median / stage_spread(*gpu, "whole process").median};
}

}  // namespace

PictureReport measure_pictures(const std::string& name, const fs::path& scene,
                               const PictureOptions& options) {
  PictureReport report{.scene = name,
                       .width = options.width,
                       .height = options.height,
                       .samples = options.samples,
                       .runs = options.runs,
                       .primitives = options.primitives,
                       .series = {},
                       .povray = {},
                       .kernels = {}};
  const std::vector<Series> all = measure(scene, options);
  for (const Series& series : all) report.series.push_back(report_on(series));
  if (options.start)
    for (const Series& series : measure_start(scene, options)) report.series.push_back(report_on(series));
  report.povray = povray_ratio(all);
  if (options.backends.front() == "gpu") report.kernels = list_kernels(scene, options);
  return report;
}

}  // namespace eyeray::engine::bench
