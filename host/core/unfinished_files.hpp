// Files that are removed if the program ends before they are finished, however suddenly.
#pragma once

#include <filesystem>
#include <mutex>

namespace eyeray::engine {

// The list of unfinished files. Hold it while such a file is made, renamed or removed, so that list and disk
// agree.
class UnfinishedFiles {
 public:
  UnfinishedFiles();
  void add(std::filesystem::path path);
  void drop(const std::filesystem::path& path);

 private:
  std::unique_lock<std::timed_mutex> lock_;
};

// Removes all unfinished files, and folders with their contents. From then on nobody can make another, since
// the process is about to end. Gives up if another thread holds the list for longer than a moment.
void remove_unfinished_files();

}  // namespace eyeray::engine
