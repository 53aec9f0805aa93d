#include "core/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/error.hpp"

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
  Descriptor(const fs::path& path, int flags) : value_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool valid() const { return value_ >= 0; }
  int get() const { return value_; }
  // Whether the file system took everything: some report a full disk only here.
  bool close() {
    if (value_ < 0) return true;
    const int value = value_;
    value_ = -1;
    return ::close(value) == 0;
  }

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

// The part file: gone at the end of its scope, unless it has been renamed.
class AtomicFile::Part {
 public:
  explicit Part(const fs::path& target)
      : path_(target.string() + ".part." + std::to_string(::getpid())),
        file_(path_, O_WRONLY | O_CREAT | O_TRUNC) {
    if (!file_.valid()) fail("write", path_, errno);
  }
  ~Part() {
    if (!renamed_) ::unlink(path_.c_str());
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  void write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(file_.get(), bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail("write", path_, errno);
      bytes = bytes.subspan(size_t(count));
    }
  }
  void rename_to(const fs::path& target) {
    if (::fsync(file_.get()) != 0) fail("write", path_, errno);
    if (!file_.close()) fail("write", path_, errno);
    if (::rename(path_.c_str(), target.c_str()) != 0) fail("replace", target, errno);
    renamed_ = true;
  }

 private:
  fs::path path_;
  Descriptor file_;
  bool renamed_ = false;
};

// The part lies beside the target, so that the rename stays within one file system.
AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
  check_replaceable(path);
  part_ = std::make_unique<Part>(path);
}

AtomicFile::~AtomicFile() = default;

void AtomicFile::write(std::span<const std::byte> bytes) {
  part_->write(bytes);
}

void AtomicFile::commit() {
  part_->rename_to(path_);

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
