#include "host/dev/file_watcher.hpp"

#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "host/core/error.hpp"
#include "host/core/termination.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::dev {
namespace {

constexpr uint32_t appeared = IN_CLOSE_WRITE | IN_MOVED_TO | IN_CREATE;
constexpr uint32_t vanished = IN_MOVED_FROM | IN_DELETE | IN_DELETE_SELF | IN_MOVE_SELF;
constexpr double quiet_after_saving = 0.01;
constexpr double quiet_after_vanishing = 0.2;

}  // namespace

FileWatcher::FileWatcher() : fd_(inotify_init1(IN_CLOEXEC | IN_NONBLOCK)) {
  if (fd_ < 0) throw Error(ExitCode::file_io, "cannot watch files: inotify_init1: {}", strerror(errno));
}

FileWatcher::~FileWatcher() {
  ::close(fd_);
}

void FileWatcher::watch(const WatchList& list) {
  const std::map<int, Interest> before = std::exchange(interests_, {});
  endings_ = list.endings;

  // Watch each file by its given name, and by the name that its links lead to.
  for (const fs::path& file : list.files) {
    std::error_code ignored;
    const fs::path path = fs::absolute(file).lexically_normal();
    add_folder(path.parent_path(), path.filename(), false);
    const fs::path real = fs::weakly_canonical(path, ignored);
    if (!ignored) add_folder(real.parent_path(), real.filename(), false);
  }
  for (const fs::path& folder : list.folders) add_tree(fs::absolute(folder).lexically_normal());

  // Drop the watches that the new list no longer needs.
  for (const auto& [id, interest] : before) {
    if (!interests_.contains(id)) inotify_rm_watch(fd_, id);
  }
}

// Watches `name` in `folder`. If the folder is missing, watches the nearest existing folder above it, in
// which the missing one may appear.
void FileWatcher::add_folder(const fs::path& folder, const std::string& name, bool endings) {
  const int id = inotify_add_watch(fd_, folder.c_str(), appeared | vanished | IN_ONLYDIR);
  if (id >= 0) {
    Interest& interest = interests_[id];
    if (!name.empty()) interest.names.insert(name);
    interest.endings |= endings;
  } else if (errno == ENOSPC) {
    throw Error(ExitCode::file_io,
                "cannot watch {}: no inotify watches left; raise fs.inotify.max_user_watches",
                folder.string());
  } else if (folder.has_relative_path()) {
    add_folder(folder.parent_path(), folder.filename(), false);
  }
}

void FileWatcher::add_tree(const fs::path& folder) {
  add_folder(folder, "", true);
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->is_directory(error)) add_folder(entry->path(), "", true);
  }
}

bool FileWatcher::matters(int watch_id, const std::string& name) const {
  const auto found = interests_.find(watch_id);
  if (found == interests_.end()) return false;
  const Interest& interest = found->second;
  if (interest.names.contains(name)) return true;
  return interest.endings && std::any_of(endings_.begin(), endings_.end(),
                                         [&](const std::string& ending) { return name.ends_with(ending); });
}

void FileWatcher::read_events() {
  alignas(inotify_event) char buffer[16384];
  for (ssize_t count; (count = ::read(fd_, buffer, sizeof buffer)) > 0;) {
    for (const char* at = buffer; at < buffer + count;) {
      const auto* event = reinterpret_cast<const inotify_event*>(at);
      at += sizeof(inotify_event) + event->len;

      // The folder itself is gone, or events were lost: anything may have changed.
      const std::string name = event->len ? event->name : "";
      const bool folder_gone =
          (event->mask & (IN_DELETE_SELF | IN_MOVE_SELF)) && interests_.contains(event->wd);
      const bool new_folder =
          (event->mask & IN_ISDIR) && interests_.contains(event->wd) && interests_.at(event->wd).endings;
      if (!(event->mask & IN_Q_OVERFLOW) && !folder_gone && !new_folder && !matters(event->wd, name))
        continue;
      changed_.insert(name);
      quiet_seconds_ = (event->mask & vanished) ? quiet_after_vanishing : quiet_after_saving;
      since_change_ = {};
    }
  }
}

std::optional<double> FileWatcher::settles_in() const {
  if (changed_.empty()) return std::nullopt;
  return std::max(0.0, quiet_seconds_ - since_change_.seconds());
}

std::set<std::string> FileWatcher::take_changes() {
  read_events();
  if (settles_in().value_or(1) > 0) return {};
  return std::exchange(changed_, {});
}

std::set<std::string> FileWatcher::wait() {
  while (!interrupted()) {
    if (std::set<std::string> changed = take_changes(); !changed.empty()) return changed;
    // A signal that comes just before poll() begins does not end poll(): return about every 0.1 s, to check
    // interrupted().
    pollfd polled{fd_, POLLIN, 0};
    ::poll(&polled, 1, int(std::min(settles_in().value_or(0.1), 0.1) * 1000) + 1);
  }
  return {};
}

}  // namespace eyeray::engine::dev
