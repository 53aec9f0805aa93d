// The measurements of `eyeray-bench`: rays a second beside Embree on the same rays, and the times of whole
// pictures and their stages beside POV-Ray.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/bench/field.hpp"
#include "benchmarks/bench/paths.hpp"
#include "benchmarks/bench/pictures.hpp"

namespace eyeray::engine::bench {

// The scene that is measured beside the standard scenes if none is named and if the file exists.
inline constexpr std::string_view default_scene = "scenes/whitted.toml";
// The scene whose paths are measured if none is named.
inline constexpr std::string_view path_scene = "scenes/path/cornell_box.toml";

struct Options {
  // Files, and names of standard scenes; empty: all standard scenes and the default.
  std::vector<std::string> scenes;
  PictureOptions pictures;  // `backends`, `defines`, `device`, the size and `runs` hold for rays too
  std::vector<std::string> incoherent{""};  // ProfileOptions::incoherent, one gpu executor for each
  // If set, only the paths of path-traced scenes are measured; if no scene is named, those of path_scene.
  std::optional<PathOptions> paths;
  bool with_rays = true;
  bool with_pictures = true;
};

struct Report {
  FieldReport field;
  std::vector<PictureReport> pictures;
  std::vector<PathReport> paths;
};

// Callbacks for each finding, called as soon as there is one. All must be set.
struct Listener {
  std::function<void(const SceneReport&)> rays;
  std::function<void(const PictureReport&)> picture;
  std::function<void(const PathReport&)> paths;
  std::function<void(const std::string&)> remark;  // a measurement that failed, and why
};

// Loads every scene once before it measures any. Error (bad_input) for an unknown backend or scene,
// Error (interrupted) after Ctrl-C, and as load_scene, make_executor, Embree and measure_pictures.
Report measure(const Options& options, const Listener& listener);

// {"bench": […], "field": […], "paths": […]}.
nlohmann::ordered_json to_json(const Report& report);
// Reads a report from such JSON, as far as `changes` compares it. Error (file_io) if the file cannot be read,
// Error (bad_input) if it contains something else.
Report read_report(const std::filesystem::path& file);
// The changes from `old` to `now`: a line for each contender that both reports have; "" if there is none.
std::string changes(const Report& old, const Report& now);

}  // namespace eyeray::engine::bench
