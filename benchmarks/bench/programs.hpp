// Timed runs of whole programs: eyeray itself, and POV-Ray beside it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/bench/spread.hpp"
#include "host/core/process.hpp"

namespace eyeray::engine::bench {

// The cost of one run.
struct TimedRun {
  std::vector<std::pair<std::string, double>> seconds;  // by stage, "whole process" first
  uint64_t rays = 0;
  uint64_t peak_memory = 0;      // bytes; 0 where unknown
  double tracing = 0;            // seconds spent on tracing alone, as the program itself reports
  double tracing_processor = 0;  // processor seconds of all threads in that time; 0 where unknown
  double whole_processor = 0;    // processor seconds of the whole process
  std::string device;
};

// The runs of one program on one scene.
struct Series {
  std::string name;
  std::vector<TimedRun> runs;
};

// The spread of a stage's time over a series. A run without the stage counts as 0.
Spread stage_spread(const Series& series, const std::string& stage);
Spread tracing_spread(const Series& series);
Spread memory_spread(const Series& series);

// The eyeray that is measured, which lies beside this program. Error (file_io) where there is none.
std::string eyeray_program();
// Runs eyeray ARGUMENTS… Error when it fails.
ProcessResult run_eyeray(std::vector<std::string> arguments, const Environment& environment = {});
// Runs eyeray render ARGUMENTS… -o OUTPUT. Error when it fails.
TimedRun run_render(const std::vector<std::string>& arguments, const std::filesystem::path& output,
                    const Environment& environment = {});

// True if POV-Ray is installed.
bool have_povray();
// Error (file_io) if POV-Ray, or Blender, is not installed; its message states that.
void check_povray();
void check_blender();
// Runs POV-Ray with two threads; `tracing` is the trace time that it reports. Error when it fails.
TimedRun run_povray(const std::filesystem::path& scene, int width, int height,
                    const std::filesystem::path& output);

// Renders the scene by POV-Ray's radiosity, to an .hdr.
TimedRun run_povray_radiosity(const std::filesystem::path& scene, int width, int height,
                              const std::filesystem::path& output);
// Runs Blender on a script of contenders/cycles_scene.hpp. Error when it fails.
TimedRun run_cycles(const std::filesystem::path& script, int samples, int seed,
                    const std::filesystem::path& output);

}  // namespace eyeray::engine::bench
