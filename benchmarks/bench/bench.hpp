// The measurements of `eyeray-bench`: rays a second beside Embree on the same rays, and how long whole
// pictures and their stages take beside POV-Ray.
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

// Measured beside the standard scenes when none is named, where it is there.
inline constexpr std::string_view default_scene = "scenes/whitted.toml";
// The scene whose paths are measured if none is named.
inline constexpr std::string_view path_scene = "scenes/path/cornell_box.toml";

struct Options {
  std::vector<std::string> scenes;  // files, and names of standard scenes; none: all of these and the default
  PictureOptions pictures;          // `backends`, `defines`, `device`, the size and `runs` hold for rays too
  std::vector<std::string> incoherent{""};  // ProfileOptions::incoherent, one gpu executor for each
  // In place of rays and pictures, of path-traced scenes; without a name of path_scene.
  std::optional<PathOptions> paths;
  bool with_rays = true;
  bool with_pictures = true;
};

struct Report {
  FieldReport field;
  std::vector<PictureReport> pictures;
  std::vector<PathReport> paths;
};

// Callbacks for each finding, called as soon as it is there. All must be set.
struct Listener {
  std::function<void(const SceneReport&)> rays;
  std::function<void(const PictureReport&)> picture;
  std::function<void(const PathReport&)> paths;
  std::function<void(const std::string&)> remark;  // a measurement that failed, and why
};

// Loads every scene once before it measures any. Error (bad_input) for a backend or a scene that is none,
// Error (interrupted) after Ctrl-C, and as load_scene, make_executor, Embree and measure_pictures.
Report measure(const Options& options, const Listener& listener);

// {"bench": […], "field": […], "paths": […]}.
nlohmann::ordered_json to_json(const Report& report);
// A report out of such an answer, as far as `changes` compares it. Error (file_io) where it cannot be read,
// Error (bad_input) where it is something else.
Report read_report(const std::filesystem::path& file);
// The changes from `old` to `now`: a line for each contender that both have; "" if there is none.
std::string changes(const Report& old, const Report& now);

}  // namespace eyeray::engine::bench
