// Measures how fast the noise of path-traced pictures falls: paths and rays a second, the error left after so
// many samples and its cost, and the same figures of other renderers of the scene.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/bench/spread.hpp"

namespace eyeray::engine::bench {

struct PathOptions {
  std::vector<std::string> defines;  // -D of render
  std::string device = "auto";
  int width = 256;
  int height = 256;
  int most_samples = 64;  // 4, 16, … up to so many
  int runs = 5;           // each under another seed
  double clamp = 0;       // unless 0, --clamp of render
  bool cycles = false;    // beside Blender's Cycles
  bool povray = false;    // beside POV-Ray's radiosity
};

// All runs of a renderer with so many samples a pixel.
struct PathLevel {
  int samples = 0;
  Spread seconds;          // of rendering alone, on the wall clock
  Spread processor;        // seconds of all threads, of rendering alone
  Spread whole_processor;  // … and of the whole process
  uint64_t rays = 0;       // of a run; 0 where unknown
  // Mean squared error over pixels and channels: the variance over the runs, which is the error of an
  // unbiased renderer, or the squared difference from PathReport::reference. Below: the same over the squared
  // mean of each channel, plus 0.01.
  double error = 0;
  double relative_error = 0;

  // 1 / (error · processor seconds).
  double efficiency() const { return 1 / (error * processor.median); }
};

struct PathSeries {
  std::string name;  // "gpu", "gpu, random", "Cycles"
  std::string device;
  std::vector<PathLevel> levels;

  // d log error / d log samples, fitted; −1 of independent samples.
  double slope() const;
  // Processor seconds of rendering until the error is so small, by its levels; beyond them by its slope.
  double processor_until(double error) const;
  // The error that is left after so many; beyond the levels by their slope.
  double error_after(double processor) const;
};

// The difference from our means over the regions of a picture, in the longest runs.
struct Likeness {
  std::string name;
  int regions = 0;              // times three channels
  double ours = 0, theirs = 0;  // means of the picture
  double standard_error = 0;    // of their difference
  double greatest = 0;          // of all differences of regions, over ours
  double t = 0, p = 1;          // of the most unlikely region; 1 where the other is not random
  double threshold = 0;         // of p, so that one comparison in a thousand is beyond by chance
  bool judged = true;           // else it is biased, and the noise means nothing

  bool within_noise() const { return p >= threshold; }
};

struct PathReport {
  std::string scene;
  int width = 0, height = 0;
  int runs = 0;
  std::vector<PathSeries> series;
  std::vector<Likeness> likeness;  // of each other renderer
  // Describes, for people, the pictures that errors of photon mapping are measured against, since photons are
  // biased. Empty for other integrators.
  std::string reference = {};
};

// Processor seconds of the shorter of two series, and the root of the first one's error over the second's by
// then.
struct EqualTime {
  double processor = 0;
  double ratio = 0;
};
EqualTime at_equal_time(const PathSeries& first, const PathSeries& second);

// Measures the paths of a scene. For a scene of `sppm`, measures `sppm` beside `path`. Error as load_scene
// and render; (file_io) where Blender or POV-Ray is asked for and missing, (bad_input) where the scene has no
// likeness there, or is not for `path`.
PathReport measure_paths(const std::string& scene, const PathOptions& options);

// The report as a table, for people.
std::string to_text(const PathReport& report);
nlohmann::ordered_json to_json(const PathReport& report);
// The path reports of an answer of `eyeray-bench --json`, as far as path_changes compares them. Error as
// read_picture_reports.
std::vector<PathReport> read_path_reports(const std::filesystem::path& file);
// A line for rays and error of each series that both have with as many samples.
std::string path_changes(const std::vector<PathReport>& old, const std::vector<PathReport>& now);

}  // namespace eyeray::engine::bench
