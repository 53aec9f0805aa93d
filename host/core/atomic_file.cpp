#include "host/core/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "host/core/error.hpp"
#include "host/core/unfinished_files.hpp"

namespace eyeray {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const char* what, const fs::path& path, int error) {
  throw Error(ExitCode::file_io, "cannot {} {}: {}", what, path.string(),
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

// Throws where a rename would replace something that is no file of the user's: a folder, or a device such as
// /dev/null.
void check_replaceable(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw Error(ExitCode::file_io, "cannot write {}: it is not a regular file", path.string());
  }
}

}  // namespace

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)) {
  check_replaceable(path_);
  // A name of its own, even where one program writes a file twice at once or a killed one left its part.
  const std::string stem = path_.string() + ".part." + std::to_string(::getpid());
  part_ = stem;
  UnfinishedFiles unfinished;
  for (int i = 1; file_ < 0; ++i) {
    file_ = ::open(part_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ < 0 && errno != EEXIST) fail("write", part_, errno);
    if (file_ < 0) part_ = stem + "." + std::to_string(i);
  }
  unfinished.add(part_);
}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) ::close(file_);
  if (renamed_) return;
  UnfinishedFiles unfinished;
  ::unlink(part_.c_str());
  unfinished.drop(part_);
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  write_at(end_, bytes);
  end_ += bytes.size();
}

void AtomicFile::write_at(uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::pwrite(file_, bytes.data(), bytes.size(), off_t(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("write", part_, errno);
    bytes = bytes.subspan(size_t(count));
    offset += uint64_t(count);
  }
}

void AtomicFile::read_at(uint64_t offset, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t count = ::pread(file_, bytes.data(), bytes.size(), off_t(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("read", part_, errno);
    if (count == 0) fail("read", part_, EIO);
    bytes = bytes.subspan(size_t(count));
    offset += uint64_t(count);
  }
}

void AtomicFile::commit() {
  if (::fsync(file_) != 0) fail("write", part_, errno);
  // Some file systems report a full disk only here.
  if (::close(std::exchange(file_, -1)) != 0) fail("write", part_, errno);
  {
    UnfinishedFiles unfinished;
    if (::rename(part_.c_str(), path_.c_str()) != 0) fail("replace", path_, errno);
    renamed_ = true;
    unfinished.drop(part_);
  }

  // Make the rename itself durable; file systems that cannot sync a folder say EINVAL.
  const Descriptor folder(folder_of(path_), O_RDONLY | O_DIRECTORY);
  if (!folder.valid() || (::fsync(folder.get()) != 0 && errno != EINVAL))
    fail("sync the folder of", path_, errno);
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

}  // namespace eyeray
