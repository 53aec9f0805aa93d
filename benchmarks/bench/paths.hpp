// Measures how fast the noise of path-traced pictures falls: paths and rays a second, the error after each
// number of samples and its cost, and the same figures of other renderers of the scene.
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
  int most_samples = 64;  // runs take 4, 16, … samples a pixel, up to this number
  int runs = 5;           // each with another seed
  double clamp = 0;       // unless 0, --clamp of render
  bool cycles = false;    // beside Blender's Cycles
  bool povray = false;    // beside POV-Ray's radiosity
};

// All runs of a renderer with one number of samples a pixel.
struct PathLevel {
  int samples = 0;
  Spread seconds;          // seconds of rendering alone, on the wall clock
  Spread processor;        // seconds of all threads, of rendering alone
  Spread whole_processor;  // seconds of all threads, of the whole process
  uint64_t rays = 0;       // rays of a run; 0 where unknown
  // Mean squared error over pixels and channels: the variance over the runs, which is the error of an
  // unbiased renderer, or the squared difference from PathReport::reference.
  double error = 0;
  // The variance over the runs, divided by the squared mean of the pixel's channel plus 0.01; the mean over
  // pixels and channels.
  double relative_error = 0;

  // 1 / (error · processor seconds).
  double efficiency() const { return 1 / (error * processor.median); }
};

struct PathSeries {
  std::string name;  // "gpu", "gpu, random", "Cycles"
  std::string device;
  std::vector<PathLevel> levels;

  // d log error / d log samples, fitted to the levels; −1 for independent samples.
  double slope() const;
  // Processor seconds of rendering until the error is this small: interpolated between levels, extrapolated
  // beyond them.
  double processor_until(double error) const;
  // The error after that many processor seconds: interpolated between levels, by slope() beyond them.
  double error_after(double processor) const;
};

// The difference between another renderer's means over the regions of a picture and ours, in the runs with
// the most samples.
struct Likeness {
  std::string name;
  int regions = 0;              // regions of the picture, each with three channels
  double ours = 0, theirs = 0;  // means of the picture
  double standard_error = 0;    // standard error of their difference
  double greatest = 0;          // the greatest difference of a region, relative to ours
  double t = 0, p = 1;          // t and p of the least likely region; p is 1 if the other is not random
  double threshold = 0;         // for p: by chance, one comparison in a thousand is below it
  bool judged = true;           // false: the other renderer is biased, so p means nothing

  bool within_noise() const { return p >= threshold; }
};

struct PathReport {
  std::string scene;
  int width = 0, height = 0;
  int runs = 0;
  std::vector<PathSeries> series;
  std::vector<Likeness> likeness;  // one for each other renderer
  // Describes, for people, the pictures that errors of photon mapping are measured against, since photons are
  // biased. Empty for other integrators.
  std::string reference = {};
};

// `processor`: processor seconds of the shorter of two series. `ratio`: the square root of the first series'
// error over the second's after that time.
struct EqualTime {
  double processor = 0;
  double ratio = 0;
};
EqualTime at_equal_time(const PathSeries& first, const PathSeries& second);

// Measures the paths of a scene. For a scene of `sppm`, measures `sppm` beside `path`. Error as load_scene
// and render. Error (file_io) if Blender or POV-Ray is requested but missing. Error (bad_input) if the scene
// cannot be written for them, or is not for `path`.
PathReport measure_paths(const std::string& scene, const PathOptions& options);

// The report as a table, for people.
std::string to_text(const PathReport& report);
nlohmann::ordered_json to_json(const PathReport& report);
// The path reports in the output of `eyeray-bench --json`, as far as path_changes compares them. Error as
// read_picture_reports.
std::vector<PathReport> read_path_reports(const std::filesystem::path& file);
// A line for the rays and the error of each series that both reports have with the same number of samples.
std::string path_changes(const std::vector<PathReport>& old, const std::vector<PathReport>& now);

}  // namespace eyeray::engine::bench
