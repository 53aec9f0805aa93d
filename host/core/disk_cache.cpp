#include "host/core/disk_cache.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "host/core/atomic_file.hpp"
#include "host/core/content_hash.hpp"
#include "host/core/error.hpp"
#include "host/core/input_file.hpp"
#include "host/core/private_folder.hpp"

namespace eyeray::engine {
namespace {

constexpr std::string_view ending = ".eyeray-cache";
constexpr size_t most_entries = 512;
constexpr size_t most_bytes = size_t{1} << 30;  // most bytes of one entry

std::filesystem::path path_from(const char* variable) {
  const char* value = std::getenv(variable);
  return value ? value : "";
}

}  // namespace

DiskCache DiskCache::of_user() {
  if (std::getenv("EYERAY_CACHE_DIR")) return DiskCache(path_from("EYERAY_CACHE_DIR"));
  if (auto folder = path_from("XDG_CACHE_HOME"); folder.is_absolute()) return DiskCache(folder / "eyeray");
  if (auto home = path_from("HOME"); home.is_absolute()) return DiskCache(home / ".cache" / "eyeray");
  return DiskCache({});
}

std::vector<std::string> DiskCache::warnings() const {
  std::vector<std::filesystem::path> folders{folder_};
  std::error_code failed;
  for (std::filesystem::directory_iterator entry(folder_, failed), end; !failed && entry != end;
       entry.increment(failed))
    if (entry->path().extension() != ending && std::filesystem::is_directory(entry->path(), failed))
      folders.push_back(entry->path());
  std::vector<std::string> warnings;
  for (const std::filesystem::path& folder : folders) {
    if (const std::string why = why_not_private(folder); !why.empty())
      warnings.push_back(
          fmt::format("the cache {} is not used, so each start compiles again: {}", folder.string(), why));
    if (!warnings.empty() && folder == folder_) break;
  }
  return warnings;
}

std::filesystem::path DiskCache::path(std::string_view name) const {
  return folder_ / (std::string(name) + std::string(ending));
}

// An entry is the hash of its name and bytes, in hexadecimal, then the bytes.
std::optional<std::string> DiskCache::load(std::string_view name) const {
  if (folder_.empty() || !is_private_folder(folder_) || !is_private_file(path(name))) return std::nullopt;
  std::string text;
  try {
    text = read_input_file(path(name), "a cache entry", most_bytes);
  } catch (const Error&) {
    return std::nullopt;  // the file is somebody else's, or was removed a moment ago
  }
  const std::string_view bytes = std::string_view(text).substr(std::min<size_t>(32, text.size()));
  if (!text.starts_with(ContentHash().add(name).add(bytes).hex())) return std::nullopt;
  return std::string(bytes);
}

void DiskCache::store(std::string_view name, std::string_view bytes) const {
  if (folder_.empty() || !make_private_folder(folder_)) return;
  try {
    AtomicFile entry(path(name), 0600);
    entry.write(ContentHash().add(name).add(bytes).hex());
    entry.write(bytes);
    entry.commit();
  } catch (const Error&) {
    return;  // a full or read-only disk costs the next start some time, and nothing else
  }
  drop_old_entries();
}

void DiskCache::drop_old_entries() const {
  // Other processes may be doing the same: a file that has gone meanwhile is no fault.
  std::error_code failed;
  std::vector<std::pair<std::filesystem::file_time_type, std::filesystem::path>> entries;
  for (std::filesystem::directory_iterator entry(folder_, failed), end; !failed && entry != end;
       entry.increment(failed))
    if (entry->path().extension() == ending)
      entries.emplace_back(entry->last_write_time(failed), entry->path());
  if (entries.size() <= most_entries) return;
  std::sort(entries.begin(), entries.end());
  for (size_t i = 0; i < entries.size() - most_entries / 2; ++i)
    std::filesystem::remove(entries[i].second, failed);
}

}  // namespace eyeray::engine
