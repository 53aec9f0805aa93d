#include "benchmarks/bench/bench.hpp"

#include <nlohmann/json.hpp>

#include "benchmarks/bench/field_run.hpp"
#include "benchmarks/bench/own_contenders.hpp"
#include "benchmarks/bench/programs.hpp"
#include "benchmarks/bench/standard_scenes.hpp"
#include "benchmarks/contenders/povray_scene.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/scratch_folder.hpp"
#include "host/loader/scene_file.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::bench {
namespace {

// To parse more primitives, POV-Ray would need gigabytes and a minute.
constexpr uint64_t most_for_povray = 2'000'000;
// The standard scene whose pictures take half a minute each. It is made only if named on the command line.
constexpr std::string_view large_scene = "terrain-8m";

// The standard scene of that name; null if there is none, or if a file has the name.
const StandardScene* as_standard(const std::string& name) {
  return fs::exists(name) ? nullptr : find_standard_scene(name);
}

Scene load(const std::string& name, const Options& options) {
  if (const StandardScene* const standard = as_standard(name)) return standard->make();
  std::vector<loader::Override> overrides;
  for (const std::string& define : options.pictures.defines) overrides.push_back({define});
  return loader::load_scene(name, overrides);
}

SceneReport race_on(const std::string& name, const Options& options) {
  const PictureOptions& pictures = options.pictures;
  const StandardScene* const standard = as_standard(name);
  const FieldOptions field{.width = pictures.width, .height = pictures.height, .runs = pictures.runs};
  Scene scene = load(name, options);
  scene.image.width = field.width;
  scene.image.height = field.height;
  const OwnContenders ours(scene, pictures.backends, options.incoherent, pictures.device);
  SceneReport report =
      run_field(name, standard ? std::string(standard->family) : name, scene, field, ours.contenders());
  for (Build& build : ours.builds()) report.builds.push_back(std::move(build));
  return report;
}

// The scene in POV-Ray's language; "" and a remark if it cannot express the whole scene.
std::string text_for_povray(const std::string& name, const Scene& scene, const PictureOptions& options,
                            const Listener& listener) {
  try {
    return contenders::povray_scene(scene, options.width, options.height);
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_input) throw;
    listener.remark(fmt::format("{}: without POV-Ray: {}", name, error.what()));
    return "";
  }
}

// Measures pictures of a scene. First writes a standard scene to a file for eyeray, and every scene that
// POV-Ray can render to a file for POV-Ray.
PictureReport picture_of(const std::string& name, const Options& options, const Listener& listener) {
  const StandardScene* const standard = as_standard(name);
  PictureOptions pictures = options.pictures;
  const ScratchFolder scratch;
  fs::path file = name;
  if (standard) {
    file = scratch.path() / (name + ".toml");
    standard->write(file);
  }
  {
    const Scene scene = load(name, options);  // freed before anything is measured
    pictures.primitives = scene.primitive_count();
    if (pictures.povray && have_povray() && pictures.primitives <= most_for_povray) {
      const std::string text = text_for_povray(name, scene, pictures, listener);
      if (!text.empty()) {
        pictures.povray_scene = scratch.path() / "scene.pov";
        write_file_atomically(pictures.povray_scene, text);
      }
    }
  }
  return measure_pictures(name, file, pictures);
}

std::vector<std::string> all_scenes() {
  std::vector<std::string> scenes;
  for (const StandardScene& standard : standard_scenes()) scenes.emplace_back(standard.name);
  if (fs::exists(default_scene)) scenes.emplace_back(default_scene);
  return scenes;
}

}  // namespace

Report measure(const Options& options, const Listener& listener) {
  Report report;
  if (options.paths) {
    for (const std::string& name :
         options.scenes.empty() ? std::vector{std::string(path_scene)} : options.scenes) {
      report.paths.push_back(measure_paths(name, *options.paths));
      listener.paths(report.paths.back());
    }
    return report;
  }
  // Check everything that may be wrong before measuring for minutes.
  const bool named = !options.scenes.empty();
  const std::vector<std::string> scenes = named ? options.scenes : all_scenes();
  for (const std::string& backend : options.pictures.backends) executors::parse_backend(backend);
  for (const std::string& name : scenes)
    if (!as_standard(name)) load(name, options);

  for (const std::string& name : scenes) {
    if (options.with_rays) {
      report.field.push_back(race_on(name, options));
      listener.rays(report.field.back());
    }
    if (options.with_pictures && (named || name != large_scene)) {
      report.pictures.push_back(picture_of(name, options, listener));
      listener.picture(report.pictures.back());
    }
  }
  return report;
}

nlohmann::ordered_json to_json(const Report& report) {
  nlohmann::ordered_json pictures = nlohmann::ordered_json::array();
  for (const PictureReport& picture : report.pictures) pictures.push_back(to_json(picture));
  nlohmann::ordered_json paths = nlohmann::ordered_json::array();
  for (const PathReport& each : report.paths) paths.push_back(to_json(each));
  return {{"bench", pictures}, {"field", to_json(report.field)}, {"paths", paths}};
}

Report read_report(const fs::path& file) {
  return {read_field_report(file), read_picture_reports(file), read_path_reports(file)};
}

std::string changes(const Report& old, const Report& now) {
  return changes(old.field, now.field) + picture_changes(old.pictures, now.pictures) +
         path_changes(old.paths, now.paths);
}

}  // namespace eyeray::engine::bench
