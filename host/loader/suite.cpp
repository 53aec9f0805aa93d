#include "host/loader/suite.hpp"

#include <algorithm>
#include <set>

#include "host/core/error.hpp"
#include "host/loader/scene_text.hpp"
#include "host/loader/sections.hpp"
#include "host/reading/toml_text.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::loader {
namespace {

// The files that `scene` includes, as far as it can be read. Its errors are not reported here, but when it is
// loaded.
std::vector<fs::path> included_by(const fs::path& scene) {
  std::vector<fs::path> files;
  const auto add = [&](const toml::node& node) {
    if (const auto name = node.value<std::string>())
      files.push_back(fs::weakly_canonical(scene.parent_path() / *name));
  };
  toml::table tree;
  try {
    DiagnosticLog log;
    reading::TreeBudget budget;
    tree = reading::parse_toml(read_scene_text(scene), scene.string(), budget, log);
  } catch (const Error&) {
  }
  const toml::node* const include = tree.get(include_key);
  if (!include) return files;
  add(*include);
  if (const toml::array* list = include->as_array())
    for (const toml::node& node : *list) add(node);
  return files;
}

}  // namespace

std::vector<fs::path> scenes_below(const fs::path& folder) {
  std::vector<fs::path> scenes;
  std::set<fs::path> parts;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".toml" || !entry.is_regular_file()) continue;
    scenes.push_back(entry.path());
    for (const fs::path& part : included_by(entry.path())) parts.insert(part);
  }
  std::erase_if(scenes, [&](const fs::path& scene) { return parts.contains(fs::weakly_canonical(scene)); });
  if (scenes.empty()) throw Error(ExitCode::bad_input, "there is no scene in {}", folder.string());
  std::ranges::sort(scenes);
  return scenes;
}

}  // namespace eyeray::engine::loader
