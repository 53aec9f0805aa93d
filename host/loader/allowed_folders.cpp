#include "host/loader/allowed_folders.hpp"

#include <algorithm>

#include "host/core/error.hpp"
#include "host/core/option_text.hpp"

namespace eyeray::engine::loader {

namespace fs = std::filesystem;

AllowedFolders::AllowedFolders(const fs::path& scene, std::span<const fs::path> others) : scene_(scene) {
  trees_.allow(scene.parent_path());
  for (const fs::path& folder : others) trees_.allow(folder);
}

AllowedFolders::File AllowedFolders::find(std::string_view key, const std::string& name,
                                          const fs::path& from) const {
  if (name.empty() || name.find('\0') != std::string::npos)
    throw Error(ExitCode::bad_input, "`{}` needs the name of a file", key);
  const fs::path path = (from.parent_path() / name).lexically_normal();

  if (!trees_.hold(path)) {
    throw Error(ExitCode::bad_input, "{} lies outside the scene's folder; {} allows other ones", name,
                option_text("allow-path", "DIR"));
  }
  return {path, fs::weakly_canonical(fs::absolute(path))};
}

AllowedFolders::File AllowedFolders::find(std::string_view key, const std::string& name,
                                          const std::string& from, std::span<const fs::path> sources) const {
  const auto source = std::ranges::find(sources, fs::path(from));
  return find(key, name, source != sources.end() ? *source : scene_);
}

}  // namespace eyeray::engine::loader
