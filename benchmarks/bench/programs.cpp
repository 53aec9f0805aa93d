#include "benchmarks/bench/programs.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/core/error.hpp"
#include "host/core/termination.hpp"
#include "host/core/text_scanner.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::bench {
namespace {

constexpr double longest_run_seconds = 3600;

ProcessResult run_or_throw(const std::vector<std::string>& argv, const Environment& environment = {}) {
  ProcessResult result = run_process(argv, environment, longest_run_seconds);
  if (interrupted() || result.code == int(ExitCode::interrupted))
    throw Error(ExitCode::interrupted, "interrupted");
  if (result.code > 0 && result.code < 6)
    throw Error(ExitCode(result.code), "{} failed:\n{}", argv[0], result.err);
  if (result.code != 0)
    throw Error(ExitCode::file_io, "{} ended with code {}:\n{}", argv[0], result.code, result.err);
  return result;
}

bool can_run(const std::vector<std::string>& argv) {
  try {
    return run_process(argv).code == 0;
  } catch (const Error&) {
    return false;
  }
}

TimedRun run_povray(const fs::path& scene, int width, int height, const fs::path& output,
                    const char* format) {
  const ProcessResult result =
      run_or_throw({"povray", "+I" + scene.string(), fmt::format("+W{}", width), fmt::format("+H{}", height),
                    "+WT2", "-D", "-V", format, "-A", "+O" + output.string()});
  TimedRun run;
  run.seconds.emplace_back("whole process", result.seconds);
  run.whole_processor = run.tracing_processor = result.processor_seconds;
  TextScanner log(result.err);
  const bool has_time = log.before("Trace Time:") && log.before("(");
  const std::optional<double> seconds = has_time ? log.number() : std::nullopt;
  if (!seconds) throw Error(ExitCode::file_io, "povray did not say its trace time:\n{}", result.err);
  run.tracing = *seconds;
  run.seconds.emplace_back("trace", run.tracing);
  run.device = "POV-Ray, two threads";
  return run;
}

}  // namespace

Spread stage_spread(const Series& series, const std::string& stage) {
  std::vector<double> values;
  for (const TimedRun& run : series.runs) {
    const auto found = std::find_if(run.seconds.begin(), run.seconds.end(),
                                    [&](const auto& each) { return each.first == stage; });
    values.push_back(found == run.seconds.end() ? 0 : found->second);
  }
  return spread(values);
}

Spread tracing_spread(const Series& series) {
  std::vector<double> values;
  for (const TimedRun& run : series.runs) values.push_back(run.tracing);
  return spread(values);
}

Spread memory_spread(const Series& series) {
  std::vector<double> values;
  for (const TimedRun& run : series.runs) values.push_back(double(run.peak_memory));
  return spread(values);
}

std::string eyeray_program() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  if (!fs::exists(folder / "eyeray"))
    throw Error(ExitCode::file_io, "there is no eyeray in {}, beside eyeray-bench, to be measured",
                folder.string());
  return folder / "eyeray";
}

ProcessResult run_eyeray(std::vector<std::string> arguments, const Environment& environment) {
  arguments.insert(arguments.begin(), eyeray_program());
  return run_or_throw(arguments, environment);
}

TimedRun run_render(const std::vector<std::string>& arguments, const fs::path& output,
                    const Environment& environment) {
  std::vector<std::string> words{"render", "-o", output.string(), "--json", "--quiet"};
  words.insert(words.begin() + 1, arguments.begin(), arguments.end());
  const ProcessResult result = run_eyeray(words, environment);

  TimedRun run;
  run.seconds.emplace_back("whole process", result.seconds);
  const auto report = nlohmann::ordered_json::parse(result.out);
  for (const auto& [stage, seconds] : report.at("stages").items())
    run.seconds.emplace_back(stage, seconds.get<double>());
  run.rays = report.at("rays");
  run.peak_memory = report.at("peak_memory");
  run.tracing = report.at("sampling_seconds");
  run.tracing_processor = report.at("sampling_processor_seconds");
  run.whole_processor = result.processor_seconds;
  run.device = report.at("device");
  return run;
}

bool have_povray() {
  return can_run({"povray", "--version"});
}

void check_povray() {
  if (!have_povray())
    throw Error(ExitCode::file_io, "there is no povray to run beside: install POV-Ray (Debian: povray)");
}

void check_blender() {
  if (!can_run({"blender", "--version"}))
    throw Error(ExitCode::file_io, "there is no blender to run beside: install Blender (Debian: blender)");
}

TimedRun run_povray(const fs::path& scene, int width, int height, const fs::path& output) {
  return run_povray(scene, width, height, output, "+FN");
}

TimedRun run_povray_radiosity(const fs::path& scene, int width, int height, const fs::path& output) {
  TimedRun run = run_povray(scene, width, height, output, "+FH");
  run.device = "radiosity, two threads";
  return run;
}

TimedRun run_cycles(const fs::path& script, int samples, int seed, const fs::path& output) {
  const ProcessResult result =
      run_or_throw({"blender", "-b", "--factory-startup", "--python-exit-code", "1", "-P", script.string(),
                    "--", output.string(), std::to_string(samples), std::to_string(seed)});
  TimedRun run;
  run.seconds.emplace_back("whole process", result.seconds);
  run.whole_processor = result.processor_seconds;
  TextScanner log(result.out);
  if (log.before("eyeray: cpu ")) {
    run.tracing_processor = log.number().value_or(0);
    if (log.skip(" wall ")) run.tracing = log.number().value_or(0);
  }
  if (run.tracing == 0 || !fs::exists(output))
    throw Error(ExitCode::file_io, "blender rendered nothing:\n{}{}", result.out, result.err);
  TextScanner name(result.out);
  run.device = name.skip("Blender ") ? "Blender " + std::string(name.word(".")) : "Blender";
  return run;
}

}  // namespace eyeray::engine::bench
