// The files that a picture depends on, and whether their bytes are still the same.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace eyeray::engine::dev {

class SourceFiles {
 public:
  using Clock = std::chrono::system_clock;
  // By the clock of files' times.
  static Clock::time_point now();

  // Sets the watched files, read since `began`. The present bytes of new ones are those that later bytes are
  // compared with. If a file, new or not, was written since `began`, it is unknown which bytes were read: it
  // counts as changed, once.
  void set(const std::set<std::filesystem::path>& files, Clock::time_point began);
  const std::set<std::filesystem::path>& files() const { return files_; }
  // True if there is a file of which it is unknown which bytes were read.
  bool any_unknown() const;

  // Those whose bytes are others than at the last call: saving the same bytes counts for nothing.
  std::set<std::filesystem::path> changed();
  // The changed files where no notifications arrive, on network file systems for instance. To be called about
  // every second. A file counts once it has not changed between two calls.
  std::set<std::filesystem::path> changed_unnoticed();

 private:
  // Identifies a file's bytes without reading them; all 0 if there is no file.
  struct Stamp {
    uint64_t inode = 0, size = 0;
    int64_t seconds = 0, nanoseconds = 0;
    bool operator==(const Stamp&) const = default;
  };
  struct State {
    Stamp stamp, last_look;
    Stamp unknown;  // of a file that counted as changed without a check
    std::string hash;
  };
  static Stamp stamp_of(const std::filesystem::path& file);
  static std::string hash_of(const std::filesystem::path& file);

  std::set<std::filesystem::path> files_;
  std::map<std::filesystem::path, State> states_;
};

}  // namespace eyeray::engine::dev
