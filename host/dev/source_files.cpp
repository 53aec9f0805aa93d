#include "host/dev/source_files.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <ctime>

#include "host/core/atomic_file.hpp"
#include "host/core/content_hash.hpp"
#include "host/core/error.hpp"

namespace eyeray::engine::dev {
namespace {

constexpr uint64_t hashed_always = 1 << 20;  // bytes
constexpr const char* unknown_hash = "?";

}  // namespace

SourceFiles::Stamp SourceFiles::stamp_of(const std::filesystem::path& file) {
  struct stat info{};
  if (::stat(file.c_str(), &info) != 0) return {};
  return {info.st_ino, uint64_t(info.st_size), info.st_mtim.tv_sec, info.st_mtim.tv_nsec};
}

std::string SourceFiles::hash_of(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return "";
  try {
    return ContentHash().add(read_file(file)).hex();
  } catch (const Error&) {
    return "";  // unreadable: the renderer reports it
  }
}

SourceFiles::Clock::time_point SourceFiles::now() {
  timespec time{};
  ::clock_gettime(CLOCK_REALTIME_COARSE, &time);
  return Clock::time_point(std::chrono::duration_cast<Clock::duration>(
      std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec)));
}

void SourceFiles::set(const std::set<std::filesystem::path>& files, Clock::time_point began) {
  files_ = files;
  std::erase_if(states_, [&](const auto& entry) { return !files_.contains(entry.first); });
  for (const std::filesystem::path& file : files_) {
    const Stamp stamp = stamp_of(file);
    const bool written_since =
        std::chrono::seconds(stamp.seconds) + std::chrono::nanoseconds(stamp.nanoseconds) >=
        began.time_since_epoch();
    const auto [found, is_new] = states_.try_emplace(file);
    State& state = found->second;
    if (written_since && stamp != state.unknown)
      state = {{}, stamp, stamp, unknown_hash};
    else if (is_new)
      state = {stamp, stamp, {}, hash_of(file)};
  }
}

bool SourceFiles::any_unknown() const {
  return std::ranges::any_of(states_, [](const auto& entry) { return entry.second.hash == unknown_hash; });
}

std::set<std::filesystem::path> SourceFiles::changed() {
  std::set<std::filesystem::path> found;
  for (auto& [file, state] : states_) {
    const Stamp stamp = stamp_of(file);
    state.last_look = stamp;
    // The clock may stand still between two quick saves, so an equal stamp counts as unchanged only for large
    // files.
    if (stamp == state.stamp && stamp.size > hashed_always) continue;
    state.stamp = stamp;
    const std::string hash = hash_of(file);
    if (hash != state.hash) found.insert(file);
    state.hash = hash;
  }
  return found;
}

std::set<std::filesystem::path> SourceFiles::changed_unnoticed() {
  bool settled = false;
  for (auto& [file, state] : states_) {
    const Stamp stamp = stamp_of(file);
    settled = settled || (stamp != state.stamp && stamp == state.last_look);
    state.last_look = stamp;
  }
  return settled ? changed() : std::set<std::filesystem::path>();
}

}  // namespace eyeray::engine::dev
