// A cache on disk of compiled code, kept for the next start.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace eyeray::engine {

// Named bytes in a folder. A cache may forget: damaged entries count as absent, old ones are dropped when
// there are many, and a folder that cannot be written remembers nothing. A folder or an entry is ignored if
// it belongs to another user, if others may write to it, or if it is a link (private_folder.hpp).
class DiskCache {
 public:
  // An empty path: remembers nothing.
  explicit DiskCache(std::filesystem::path folder) : folder_(std::move(folder)) {}
  // $EYERAY_CACHE_DIR, else $XDG_CACHE_HOME/eyeray, else ~/.cache/eyeray. If EYERAY_CACHE_DIR is set but
  // empty, there is no cache.
  static DiskCache of_user();

  const std::filesystem::path& folder() const { return folder_; }

  // Warnings, a sentence each, that the folder or one in it exists but is not used, and why.
  std::vector<std::string> warnings() const;

  // The bytes stored under `name`, a file name. Empty if there are none.
  std::optional<std::string> load(std::string_view name) const;
  void store(std::string_view name, std::string_view bytes) const;

 private:
  std::filesystem::path path(std::string_view name) const;
  void drop_old_entries() const;

  std::filesystem::path folder_;
};

}  // namespace eyeray::engine
