// Notices that files were saved, however the editor saves them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/core/stopwatch.hpp"

namespace eyeray::engine::dev {

// The files and folders to watch. A file that does not exist (yet) counts as changed once it appears.
struct WatchList {
  std::vector<std::filesystem::path> files;
  std::vector<std::filesystem::path> folders;  // everything below them whose name has one of `endings`
  std::vector<std::string> endings;            // ".glsl", with the dot
};

// inotify on the folders of the files, never on the files themselves: an editor that writes a new file and
// renames it over the old one would leave a watch on the deleted one.
class FileWatcher {
 public:
  FileWatcher();  // Error (file_io) when the system has no inotify instance left
  ~FileWatcher();
  FileWatcher(const FileWatcher&) = delete;
  FileWatcher& operator=(const FileWatcher&) = delete;

  // Replaces the watch list. A change between two calls is not lost.
  void watch(const WatchList& list);
  // The descriptor of inotify, to poll for reading.
  int descriptor() const { return fd_; }
  // The names of changed files, once the saving is over: after 10 ms without events, or 200 ms if a file has
  // vanished, since many editors put it back. Until then empty. Never waits.
  std::set<std::string> take_changes();
  // The seconds after which to call take_changes() again, even if nothing can be read; empty if nothing has
  // changed.
  std::optional<double> settles_in() const;
  // Waits for changes and returns the files' names; empty once interrupted() is true.
  std::set<std::string> wait();

 private:
  // The names of interest in a watched folder.
  struct Interest {
    std::set<std::string> names;
    bool endings = false;
  };

  void add_folder(const std::filesystem::path& folder, const std::string& name, bool endings);
  void add_tree(const std::filesystem::path& folder);
  void read_events();
  bool matters(int watch_id, const std::string& name) const;

  int fd_ = -1;
  std::map<int, Interest> interests_;  // by inotify's watch descriptor
  std::vector<std::string> endings_;
  std::set<std::string> changed_;  // changed names that take_changes() has not returned yet
  double quiet_seconds_ = 0;       // to wait after the last change
  Stopwatch since_change_;
};

}  // namespace eyeray::engine::dev
