#include "host/verify/golden.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/core/atomic_file.hpp"
#include "host/core/content_hash.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/json_depth.hpp"
#include "host/core/make_folder.hpp"
#include "host/core/process.hpp"
#include "host/image/image_file.hpp"
#include "host/scene/integrator.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::verify {
namespace {

using Json = nlohmann::ordered_json;

fs::path sidecar(const fs::path& picture) {
  return fs::path(picture).replace_extension(".json");
}

// The commit of the repository in which the picture lies; empty where there is none, or no git.
std::string commit_at(const fs::path& picture) {
  const fs::path folder = fs::absolute(picture).parent_path();
  try {
    const ProcessResult result = run_process({"git", "-C", folder.string(), "rev-parse", "HEAD"});
    return result.code == 0 ? result.out.substr(0, result.out.find('\n')) : "";
  } catch (const Error&) {
    return "";
  }
}

// Everything that decides a picture, under names that people can read.
Json origin(const Golden& golden, const Scene& scene, const compare::Report& report) {
  return {{"scene", report.scene},
          {"scene hash", hash_of_files(scene.files)},
          {"options", report.options},
          {"size", fmt::format("{}x{}", report.width, report.height)},
          {"samples", scene.image.samples},
          {"seed", scene.render.seed},
          {"integrator", integrator_names[size_t(scene.render.integrator)]},
          {"executor", report.participants.front().description},
          {"eyeray", golden.version}};
}

// The entries of origin() that have changed since the golden picture was stored.
std::vector<std::string> changes(const Golden& golden, const Json& now) {
  const fs::path file = sidecar(golden.picture);
  if (!fs::exists(file)) return {"unknown, as it has no " + file.filename().string()};
  const std::string text = read_file(file);
  const Json then = Json::parse(unless_too_deep(text), nullptr, false);
  if (!then.is_object()) return {"unknown, as " + file.string() + " is not JSON"};
  std::vector<std::string> changed;
  for (const auto& [name, value] : now.items())
    if (name != "scene" && then.value(name, Json()) != value) changed.push_back(name);
  return changed;
}

image::Image part_of(image::Image picture, const Rect& area) {
  if (area == Rect{0, 0, picture.width(), picture.height()}) return picture;
  image::Image part(area.width, area.height, picture.channels());
  for (int y = 0; y < area.height; ++y)
    std::copy_n(picture.pixel(area.x, area.y + y), area.width * picture.channels(), part.pixel(0, y));
  return part;
}

bool is_black(const image::Image& image) {
  return std::ranges::all_of(image.samples(), [](float value) { return value == 0; });
}

}  // namespace

compare::GoldenResult compare_with_golden(const Golden& golden, const Scene& scene,
                                          const compare::Frame& frame, const compare::Reference& reference,
                                          const compare::Tolerances& tolerances,
                                          const compare::Report& report) {
  compare::GoldenResult result;
  result.file = golden.picture.string();
  result.value = report.participants.front().name;
  if (!fs::exists(golden.picture)) {
    result.incomparable = "there is no such picture; --update makes it";
    return result;
  }
  image::Image picture = image::read_image(golden.picture);
  if (picture.width() != report.width || picture.height() != report.height) {
    result.incomparable = fmt::format("it has {}×{} pixels, but the scene's picture has {}×{}",
                                      picture.width(), picture.height(), report.width, report.height);
    return result;
  }
  // A golden picture has only colours; everything else is taken from the frame.
  compare::Frame stored = frame;
  stored.color = part_of(std::move(picture), report.area);
  compare::ReferenceComparison comparison =
      compare::compare_with_reference(stored, frame, reference, tolerances);
  result.incomparable = comparison.incomparable;
  result.colors = std::move(comparison.colors);
  if (result.incomparable.empty()) result.metrics = compare::measure(stored.color, frame.color);
  result.picture = std::move(stored.color);
  if (!result.passes()) result.changed = changes(golden, origin(golden, scene, report));
  return result;
}

void bless(const Golden& golden, const Scene& scene, const compare::Frame& frame, compare::Report& report) {
  compare::GoldenResult& result = *report.golden;
  if (golden.update == Update::never || (golden.update == Update::failing && result.passes())) return;
  if (!report.own_gates_pass())
    result.refused = "another gate fails";
  else if (is_black(frame.color))
    result.refused = "the picture is black";
  if (!result.refused.empty()) return;

  if (const fs::path folder = golden.picture.parent_path(); !folder.empty()) make_folder(folder);
  image::write_image(golden.picture, frame.color);
  Json origin_now = origin(golden, scene, report);
  origin_now["commit"] = commit_at(golden.picture);
  write_file_atomically(sidecar(golden.picture), json_text(origin_now, 2) + "\n");
  result.updated = true;
}

}  // namespace eyeray::engine::verify
