#include "host/importers/asset_files.hpp"

#include <algorithm>

#include "host/core/error.hpp"
#include "host/core/input_file.hpp"
#include "host/core/option_text.hpp"

namespace eyeray::engine::importers {

namespace fs = std::filesystem;

AssetFiles::AssetFiles(const fs::path& file, std::span<const fs::path> allowed_folders)
    : folder_(file.parent_path()) {
  allowed_.allow(folder_);
  for (const fs::path& folder : allowed_folders) allowed_.allow(folder);
}

fs::path AssetFiles::locate(std::string_view name) {
  std::string portable(name);
  std::ranges::replace(portable, '\\', '/');
  if (portable.empty() || portable.find('\0') != std::string::npos)
    throw Error(ExitCode::bad_input, "it refers to a file with an empty name");
  const fs::path file = (folder_ / portable).lexically_normal();
  if (!allowed_.hold(file)) {
    throw Error(ExitCode::bad_input, "{} lies outside the file's folder; {} allows other ones", name,
                option_text("allow-path", "DIR"));
  }
  if (known_.insert(file).second) files_.push_back(file);
  return file;
}

std::string AssetFiles::read(std::string_view name, std::string_view what) {
  return read_input_file(locate(name), what, most_mesh_bytes);
}

}  // namespace eyeray::engine::importers
