// Measures whole pictures: every run is a separate process, and contenders, POV-Ray among them, run
// alternately.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/bench/spread.hpp"

namespace eyeray::engine::bench {

struct PictureOptions {
  std::vector<std::string> backends{"gpu"};
  std::vector<std::string> defines;  // -D of render
  std::string device = "auto";
  int width = 1024;
  int height = 1024;
  int samples = 1;
  int runs = 5;
  bool povray = true;                  // if it is installed, and the scene exists as .pov too
  std::filesystem::path povray_scene;  // used if none is beside the scene; may be empty
  bool start = true;                   // also measure cold and warm starts
  uint64_t primitives = 0;  // primitives of the scene, to print the memory per primitive; 0: not printed
};

// The times of one contender's runs.
struct SeriesReport {
  std::string name;                                    // "gpu", "povray", "cold start"
  std::string device;                                  // "gpu: llvmpipe …"
  std::vector<std::pair<std::string, Spread>> stages;  // seconds, "whole process" first
  Spread tracing;                                      // seconds of tracing alone
  std::optional<Spread> peak_memory;                   // bytes; absent where unknown
  uint64_t rays = 0;                                   // rays of a run; 0 where unknown
};

struct PictureReport {
  // The ratio of POV-Ray's time to the gpu's.
  struct PovrayRatio {
    double tracing = 0, whole_process = 0;
  };

  std::string scene;
  int width = 0, height = 0;
  int samples = 0;
  int runs = 0;
  uint64_t primitives = 0;
  std::vector<SeriesReport> series;
  std::optional<PovrayRatio> povray;  // set if both ran
  std::string kernels;                // output of `eyeray kernels --json`; empty without the gpu
};

// Measures the scene file, called `name` in the report. Error when a run fails.
PictureReport measure_pictures(const std::string& name, const std::filesystem::path& scene,
                               const PictureOptions& options);

// The report as a table, for people.
std::string to_text(const PictureReport& report);
nlohmann::ordered_json to_json(const PictureReport& report);
// The pictures in older output of `eyeray-bench --json`, as far as picture_changes compares them. Error
// (file_io) if the file cannot be read, Error (bad_input) if it contains something else.
std::vector<PictureReport> read_picture_reports(const std::filesystem::path& file);
// A line for the whole process, the tracing and the memory of each series that both have of a scene. Pictures
// that differ in size or number of samples are not compared.
std::string picture_changes(const std::vector<PictureReport>& old, const std::vector<PictureReport>& now);

}  // namespace eyeray::engine::bench
