#include "host/cli/bench_changes.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/core/atomic_file.hpp"
#include "host/core/error.hpp"

namespace eyeray::cli {
namespace {

// The element of a list whose `key` is the same as that of `like`, or null.
const Json* find(const Json& list, const char* key, const Json& like) {
  const auto found =
      std::ranges::find_if(list, [&](const Json& each) { return each.at(key) == like.at(key); });
  return found == list.end() ? nullptr : &*found;
}

bool same_picture(const Json& a, const Json& b) {
  for (const char* key : {"width", "height", "samples"})
    if (a.at(key) != b.at(key)) return false;
  return true;
}

std::string line(const Json& scene, const Json& series, const std::string& what, const Json& old,
                 const Json& now, double unit, const char* unit_name) {
  const double before = old.at("median"), after = now.at("median");
  if (!(before > 0)) return "";
  // Spreads that touch may be one and the same.
  const bool apart = now.at("min") > old.at("max") || now.at("max") < old.at("min");
  return fmt::format("{:<24} {:<12} {:<14} {:>8.4g} -> {:<8.4g} {} {:>+7.1f} %{}\n",
                     scene.at("scene").get<std::string>(), series.at("name").get<std::string>(), what,
                     before / unit, after / unit, unit_name, 100 * (after / before - 1),
                     apart ? "" : "  within the spread");
}

}  // namespace

Json read_older_pictures(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  try {
    Json pictures = Json::parse(text).at("bench");
    picture_changes(pictures, pictures);  // looks at everything that a comparison asks for
    return pictures;
  } catch (const Json::exception&) {
    throw Error(ExitCode::bad_input, "{} is not what eyeray bench --json answers", file.string());
  }
}

std::string picture_changes(const Json& old, const Json& now) {
  std::string text;
  for (const Json& scene : now) {
    const Json* const old_scene = find(old, "scene", scene);
    if (!old_scene || !same_picture(*old_scene, scene)) continue;
    for (const Json& series : scene.at("series")) {
      const Json* const old_series = find(old_scene->at("series"), "name", series);
      if (!old_series) continue;
      const Json& old_seconds = old_series->at("seconds");
      text += line(scene, series, "whole process", old_seconds.at("whole process"),
                   series.at("seconds").at("whole process"), 1, "s");
      text += line(scene, series, "tracing", old_series->at("tracing"), series.at("tracing"), 1, "s");
      if (old_series->contains("peak_memory") && series.contains("peak_memory"))
        text += line(scene, series, "memory", old_series->at("peak_memory"), series.at("peak_memory"),
                     1 << 20, "MiB");
    }
  }
  return text;
}

}  // namespace eyeray::cli
