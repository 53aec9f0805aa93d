// The findings of a race on one or more scenes: the figures that the table, the JSON and --compare show.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/bench/race.hpp"

namespace eyeray::engine::bench {

struct BatchReport {
  std::string name;  // primary, shadow, bounce
  uint64_t rays = 0;
  std::vector<Timing> timings;
};

// A contender's preparation of the scene before it traces it.
struct Build {
  std::string contender;
  double seconds = 0;
  uint64_t bytes = 0;  // geometry and BVH; 0 where unknown
};

struct SceneReport {
  std::string scene;
  std::string family;  // the same for scenes that differ only in size
  uint64_t primitives = 0;
  std::vector<Build> builds;
  std::vector<BatchReport> batches;
};

using FieldReport = std::vector<SceneReport>;

// Rays a second, by the median time.
double rate(const BatchReport& batch, const Timing& timing);
// The fastest timing of a kind, or nullptr.
const Timing* fastest(const BatchReport& batch, ContenderKind kind);
// The speed of a timing as a multiple of the fastest of a kind; 0 if that side did not run.
double times_as_fast(const BatchReport& batch, const Timing& timing, ContenderKind kind);

nlohmann::ordered_json to_json(const FieldReport& report);
// Reads a report from the output of `eyeray-bench --json`. Error (file_io) if the file cannot be read, Error
// (bad_input) if it contains something else.
FieldReport read_field_report(const std::filesystem::path& file);

// The report as a table, for people.
std::string to_text(const FieldReport& report);
// The changes from `old` to `report`: a line for each build of a contender, and for each contender on a
// batch, that both reports have.
std::string changes(const FieldReport& old, const FieldReport& report);

}  // namespace eyeray::engine::bench
