#include "host/core/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/core/error.hpp"
#include "host/core/unfinished_files.hpp"

namespace eyeray::engine {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const char* what, const fs::path& path, int error) {
  throw Error(ExitCode::file_io, "cannot {} {}: {}", what, printable(path.string()),
              std::generic_category().message(error));
}

// An open file descriptor.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : value_(::open(path.c_str(), flags | O_CLOEXEC)) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool valid() const { return value_ >= 0; }
  int get() const { return value_; }

 private:
  int value_;
};

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// The file that `path` leads to: behind symbolic links, whether it exists or not.
fs::path behind_links(fs::path path) {
  std::error_code error;
  for (int links = 0; links < 40 && fs::is_symlink(fs::symlink_status(path, error)); ++links)
    path = path.parent_path() / fs::read_symlink(path, error);
  return path;
}

// The path of the unfinished file before a unique ending. File systems limit names to 255 bytes, so a
// long name is cut, at the start of a character.
fs::path stem_of_part(const fs::path& path) {
  constexpr size_t longest = 255 - std::string_view(".part.1234567890.12345").size();
  std::string name = path.filename().string();
  if (name.size() > longest) {
    size_t end = longest;
    while (end > 1 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;
    name.resize(end);
  }
  return path.parent_path() / name;
}

// Gives the open file `part` the mode of the file that it replaces and, where allowed, its owner and group.
void keep_mode(int part, const struct stat& replaced) {
  mode_t mode = replaced.st_mode & 0777;
  if (::fchown(part, uid_t(-1), replaced.st_gid) != 0) mode &= ~mode_t(S_IRWXG);  // meant for another group
  if (::fchown(part, replaced.st_uid, gid_t(-1)) != 0) errno = 0;                 // only root can
  ::fchmod(part, mode);
}

// Writes all of `bytes` at `offset`; false, with errno, if that fails.
bool write_all(int file, uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::pwrite(file, bytes.data(), bytes.size(), off_t(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    bytes = bytes.subspan(size_t(count));
    offset += uint64_t(count);
  }
  return true;
}

// True if the file has other names, which a rename would leave with the old content.
bool has_hard_links(const fs::path& path) {
  struct stat file{};
  return ::lstat(path.c_str(), &file) == 0 && file.st_nlink > 1;
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path, unsigned mode) : named_(path), path_(behind_links(path)) {
  // Call stat() on the link too: the system refuses to follow links that others left in a folder that
  // everybody may write to.
  struct stat replaced{};
  const bool replaces = ::stat(named_.c_str(), &replaced) == 0;
  if (!replaces && errno != ENOENT) fail("write", named_, errno);
  // A rename would replace a folder, or a device such as /dev/null.
  if (replaces && !S_ISREG(replaced.st_mode))
    throw Error(ExitCode::file_io, "cannot write {}: it is not a regular file", printable(named_.string()));

  // The name is unique, even if one program writes a file twice at once or a killed one left its part.
  const std::string stem = stem_of_part(path_).string() + ".part." + std::to_string(::getpid());
  part_ = stem;
  UnfinishedFiles unfinished;
  for (int i = 1; file_ < 0; ++i) {
    file_ = ::open(part_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (file_ < 0 && errno != EEXIST) fail("write", named_, errno);
    if (file_ < 0) part_ = stem + "." + std::to_string(i);
  }
  unfinished.add(part_);
  if (replaces) keep_mode(file_, replaced);
}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) ::close(file_);
  if (committed_) return;
  UnfinishedFiles unfinished;
  ::unlink(part_.c_str());
  unfinished.drop(part_);
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  write_at(end_, bytes);
  end_ += bytes.size();
}

void AtomicFile::write_at(uint64_t offset, std::span<const std::byte> bytes) {
  if (!write_all(file_, offset, bytes)) fail("write", named_, errno);
}

void AtomicFile::read_at(uint64_t offset, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t count = ::pread(file_, bytes.data(), bytes.size(), off_t(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("read", named_, errno);
    if (count == 0) fail("read", named_, EIO);
    bytes = bytes.subspan(size_t(count));
    offset += uint64_t(count);
  }
}

void AtomicFile::commit() {
  if (::fsync(file_) != 0) fail("write", named_, errno);
  if (has_hard_links(path_)) {
    const Descriptor target(path_, O_WRONLY | O_NOFOLLOW);
    // A file that is read-only is replaced.
    if (target.valid()) return copy_to(target.get());
  }
  // Some file systems report a full disk only here.
  if (::close(std::exchange(file_, -1)) != 0) fail("write", named_, errno);
  {
    UnfinishedFiles unfinished;
    if (::rename(part_.c_str(), path_.c_str()) != 0) fail("replace", named_, errno);
    committed_ = true;
    unfinished.drop(part_);
  }

  // Make the rename itself durable; file systems that cannot sync a folder return EINVAL.
  const Descriptor folder(folder_of(path_), O_RDONLY | O_DIRECTORY);
  if (!folder.valid() || (::fsync(folder.get()) != 0 && errno != EINVAL))
    fail("sync the folder of", named_, errno);
}

void AtomicFile::copy_to(int target) {
  struct stat part{};
  if (::fstat(file_, &part) != 0) fail("write", named_, errno);
  // On a full disk, fail before the first byte of the old content is lost.
  if (::fallocate(target, FALLOC_FL_KEEP_SIZE, 0, part.st_size) != 0 && (errno == ENOSPC || errno == EDQUOT))
    fail("write", named_, errno);
  // From here on the part file is the only whole one, so it stays until the copy is complete.
  UnfinishedFiles().drop(part_);
  committed_ = true;
  const auto copied = [&] {
    std::vector<std::byte> bytes(size_t(1) << 20);
    const auto size = uint64_t(part.st_size);
    for (uint64_t at = 0; at < size; at += bytes.size()) {
      bytes.resize(size_t(std::min<uint64_t>(bytes.size(), size - at)));
      read_at(at, bytes);
      if (!write_all(target, at, bytes)) return false;
    }
    return ::ftruncate(target, part.st_size) == 0 && ::fsync(target) == 0;
  };
  if (!copied())
    throw Error(ExitCode::file_io, "cannot write {}: {}; {} has its new content", printable(named_.string()),
                std::generic_category().message(errno), printable(part_.string()));
  ::unlink(part_.c_str());
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

void write_file_atomically(const fs::path& path, std::string_view text) {
  write_file_atomically(path, std::as_bytes(std::span(text)));
}

void check_writable(const fs::path& path) {
  const AtomicFile part(path);
}

std::string read_file(const fs::path& path) {
  const Descriptor file(path, O_RDONLY);
  if (!file.valid()) fail("read", path, errno);

  // Read to the end rather than to the size: a pipe has none.
  std::string text;
  char buffer[1 << 16];
  while (true) {
    const ssize_t count = ::read(file.get(), buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("read", path, errno);
    if (count == 0) return text;
    text.append(buffer, size_t(count));
  }
}

}  // namespace eyeray::engine
