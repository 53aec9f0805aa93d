#include "host/core/unfinished_files.hpp"

#include <chrono>
#include <system_error>
#include <utility>
#include <vector>

namespace eyeray::engine {
namespace {

struct List {
  std::timed_mutex mutex;
  std::vector<std::filesystem::path> paths;
};

// Never destroyed: the process may be ended while its static objects are.
List& list() {
  static List* const list = new List;
  return *list;
}

}  // namespace

UnfinishedFiles::UnfinishedFiles() : lock_(list().mutex) {}

void UnfinishedFiles::add(std::filesystem::path path) {
  list().paths.push_back(std::move(path));
}

void UnfinishedFiles::drop(const std::filesystem::path& path) {
  std::erase(list().paths, path);
}

void remove_unfinished_files() {
  std::unique_lock lock(list().mutex, std::chrono::milliseconds(100));
  if (!lock) return;
  std::error_code ignored;
  for (const std::filesystem::path& path : list().paths) std::filesystem::remove_all(path, ignored);
  lock.release();
}

}  // namespace eyeray::engine
