#include "host/cli/bench_pictures.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "host/cli/bench_runs.hpp"
#include "host/cli/command.hpp"
#include "host/cli/scratch_folder.hpp"

namespace fs = std::filesystem;

namespace eyeray::cli {
namespace {

constexpr const char* cold_start = "cold start";
constexpr const char* warm_start = "warm start";

// What takes longer is run once: POV-Ray parses a million triangles anew each time.
constexpr double longest_repeated_seconds = 6;

bool worth_repeating(const Series& series) {
  return series.runs.empty() || series.runs.front().seconds.front().second < longest_repeated_seconds;
}

// The same scene as POV-Ray reads it: whitted.pov beside whitted.toml or in a bench folder next to its own,
// or what was written out.
std::optional<fs::path> povray_scene(const fs::path& scene, const PictureOptions& options) {
  if (!options.povray || !have_povray()) return std::nullopt;
  const fs::path name = scene.filename().replace_extension(".pov");
  for (const fs::path& folder : {scene.parent_path(), scene.parent_path() / ".." / "bench"}) {
    if (fs::exists(folder / name)) return folder / name;
  }
  if (!options.povray_scene.empty()) return options.povray_scene;
  return std::nullopt;
}

std::vector<std::string> arguments(const fs::path& scene, const std::string& backend,
                                   const PictureOptions& options) {
  std::vector<std::string> words{scene.string(),
                                 "--backend",
                                 backend,
                                 "--device",
                                 options.device,
                                 "--spp",
                                 std::to_string(options.samples)};
  for (const std::string& define : options.defines) words.insert(words.end(), {"-D", define});
  return words;
}

// All contenders take turns, so that a change of the machine's mood hits them all.
std::vector<Series> measure(const fs::path& scene, const PictureOptions& options) {
  const ScratchFolder scratch;
  const std::optional<fs::path> pov = povray_scene(scene, options);
  std::vector<Series> all;
  for (const std::string& backend : options.backends) all.push_back({backend, {}});
  if (pov) all.push_back({"povray", {}});

  const std::string size = fmt::format("{}x{}", options.width, options.height);
  const auto run_once = [&](const std::string& name) {
    if (name == "povray")
      return run_povray(*pov, options.width, options.height, scratch.path() / "povray.png");
    std::vector<std::string> words = arguments(scene, name, options);
    words.insert(words.end(), {"-s", size});
    return run_eyeray(words, scratch.path() / "eyeray.png");
  };
  if (options.backends.front() == "gpu") run_once("gpu");  // fills the caches
  for (int i = 0; i < options.runs; ++i) {
    for (Series& series : all)
      if (worth_repeating(series)) series.runs.push_back(run_once(series.name));
  }
  return all;
}

// From nothing to a written 640×480 picture, without and with what earlier runs left in the caches.
std::vector<Series> measure_start(const fs::path& scene, const PictureOptions& options) {
  Series cold{cold_start, {}}, warm{warm_start, {}};
  std::vector<std::string> words = arguments(scene, "gpu", options);
  words.insert(words.end(), {"-s", "640x480"});
  for (int i = 0; i < options.runs && worth_repeating(cold); ++i) {
    const ScratchFolder caches;
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

void print_series(const Series& series, uint64_t primitives) {
  const TimedRun& last = series.runs.back();
  const bool named = last.device.starts_with(series.name + ":");
  fmt::print("\n{}\n", named ? last.device : fmt::format("{} ({})", series.name, last.device));
  for (const auto& [stage, seconds] : last.seconds)
    fmt::print("  {:<16} {}\n", stage, format_spread(stage_spread(series, stage)));
  if (const double memory = memory_spread(series).median; memory > 0)
    fmt::print("  {:<16} {:>6.0f} MiB{}\n", "peak memory", memory / (1 << 20),
               primitives > 0 ? fmt::format("   {:.0f} bytes a primitive", memory / double(primitives)) : "");
  if (last.rays > 0)
    fmt::print("  {:<16} {:>10}   {}\n", "rays", last.rays,
               format_rate(double(last.rays) / tracing_spread(series).median));
}

// From the start of the program to a written picture.
void print_first_pixel(const std::vector<Series>& all) {
  std::string times;
  for (const Series& series : all) {
    if (series.name == cold_start || series.name == warm_start)
      times += fmt::format("{}{} {}", times.empty() ? "" : ", ", series.name,
                           format_seconds(stage_spread(series, "whole process").median));
  }
  fmt::print("\ntime to first pixel: {}\n", times);
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
  if (const Spread memory = memory_spread(series); memory.median > 0) json["peak_memory"] = to_json(memory);
  if (series.runs.back().rays > 0) {
    json["rays"] = series.runs.back().rays;
    json["rays_per_second"] = double(series.runs.back().rays) / tracing_spread(series).median;
  }
  return json;
}

}  // namespace

Json measure_pictures(const std::string& name, const fs::path& scene, const PictureOptions& options,
                      bool print) {
  std::vector<Series> all = measure(scene, options);
  const auto ratio = povray_ratio(all);
  if (print)
    fmt::print("{}: {}×{}, {} sample{} a pixel; median, least … greatest of {} runs\n", name, options.width,
               options.height, options.samples, options.samples == 1 ? "" : "s", options.runs);
  if (options.start) {
    for (Series& series : measure_start(scene, options)) all.push_back(std::move(series));
  }
  Json entry{{"scene", name},
             {"width", options.width},
             {"height", options.height},
             {"samples", options.samples},
             {"runs", options.runs},
             {"primitives", options.primitives},
             {"series", Json::array()}};
  for (const Series& series : all) {
    entry["series"].push_back(to_json(series));
    if (print) print_series(series, options.primitives);
  }
  if (ratio) {
    entry["times_faster_than_povray"] = {{"tracing", ratio->first}, {"whole process", ratio->second}};
    if (print)
      fmt::print("\nPOV-Ray : gpu = {:.2f} (tracing alone), {:.2f} (whole process)\n", ratio->first,
                 ratio->second);
  }
  if (print && options.start) print_first_pixel(all);
  if (print) fmt::print("\n");
  return entry;
}

}  // namespace eyeray::cli
