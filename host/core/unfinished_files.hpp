// Files that are to be gone when the program ends before they are finished, however suddenly.
#pragma once

#include <filesystem>
#include <mutex>

namespace eyeray::engine {

// The list of them; hold it while one is made, renamed or removed, so that list and disk agree.
class UnfinishedFiles {
 public:
  UnfinishedFiles();
  void add(std::filesystem::path path);
  void drop(const std::filesystem::path& path);

 private:
  std::unique_lock<std::timed_mutex> lock_;
};

// Removes all of them, folders with their contents; from then on nobody can make another, as the process is
// about to end. Gives up where another thread holds the list for longer than a moment.
void remove_unfinished_files();

}  // namespace eyeray::engine
