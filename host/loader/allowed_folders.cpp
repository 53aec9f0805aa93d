#include "loader/allowed_folders.hpp"

#include <algorithm>
#include <system_error>

#include "core/error.hpp"

namespace eyeray {

namespace fs = std::filesystem;

namespace {

// Whether `path` lies in the folder tree of `folder`; both canonical.
bool lies_in(const fs::path& path, const fs::path& folder) {
  return std::ranges::mismatch(folder, path).in1 == folder.end();
}

}  // namespace

AllowedFolders::AllowedFolders(const fs::path& scene, std::span<const fs::path> others) {
  const auto allow = [&](const fs::path& folder) {
    std::error_code error;
    const fs::path whole = fs::canonical(folder.empty() ? "." : folder, error);
    if (!error) trees_.push_back(whole);
  };
  allow(scene.parent_path());
  for (const fs::path& folder : others) allow(folder);
}

AllowedFolders::File AllowedFolders::find(std::string_view key, const std::string& name,
                                          const fs::path& from) const {
  if (name.empty() || name.find('\0') != std::string::npos)
    throw Error(ExitCode::bad_input, "`{}` needs the name of a file", key);
  const fs::path path = (from.parent_path() / name).lexically_normal();

  // Follow links before asking whether the file may be read.
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path), error);
  if (error || std::ranges::none_of(trees_, [&](const fs::path& tree) { return lies_in(whole, tree); })) {
    throw Error(ExitCode::bad_input, "{} lies outside the scene's folder; --allow-path DIR allows other ones",
                name);
  }
  return {path, whole};
}

}  // namespace eyeray
