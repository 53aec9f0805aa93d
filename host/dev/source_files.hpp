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
  // The present time, by the clock that sets files' times.
  static Clock::time_point now();

  // Sets the watched files, which were read since `began`. Later bytes of a new file are compared with its
  // present bytes. If a file, new or not, was written since `began`, it is unknown which bytes were read: it
  // counts as changed, once.
  void set(const std::set<std::filesystem::path>& files, Clock::time_point began);
  const std::set<std::filesystem::path>& files() const { return files_; }
  // True if for some file it is unknown which bytes were read.
  bool any_unknown() const;

  // The files whose bytes differ from those at the last call: a file saved with the same bytes does not
  // count.
  std::set<std::filesystem::path> changed();
  // The changed files on file systems without notifications, such as network file systems. To be called about
  // every second. A changed file counts once it has the same stamp in two calls.
  std::set<std::filesystem::path> changed_unnoticed();

 private:
  // Identifies a file's bytes without reading the file; all 0 if there is no file.
  struct Stamp {
    uint64_t inode = 0, size = 0;
    int64_t seconds = 0, nanoseconds = 0;
    bool operator==(const Stamp&) const = default;
  };
  struct State {
    Stamp stamp, last_look;
    Stamp unknown;  // the stamp at which the file counted as changed without a check
    std::string hash;
  };
  static Stamp stamp_of(const std::filesystem::path& file);
  static std::string hash_of(const std::filesystem::path& file);

  std::set<std::filesystem::path> files_;
  std::map<std::filesystem::path, State> states_;
};

}  // namespace eyeray::engine::dev
