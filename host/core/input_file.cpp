#include "host/core/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine {

namespace {

constexpr size_t least_piece = size_t{1} << 16;

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

// "; did you mean scenes/whitted.toml?", or "".
std::string suggest_file(const std::filesystem::path& file) {
  constexpr size_t most_looked_at = 1000;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::vector<std::string> names;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().extension() == file.extension()) names.push_back(entry->path().filename().string());
    if (names.size() == most_looked_at) break;
  }
  const std::string nearest =
      nearest_name(file.filename().string(), std::vector<std::string_view>(names.begin(), names.end()));
  return nearest.empty() ? "" : fmt::format("; did you mean {}?", (file.parent_path() / nearest).string());
}

}  // namespace

std::string read_input_file(const std::filesystem::path& file, std::string_view what, size_t most_bytes) {
  const auto fail = [&](const std::string& why) {
    return Error(ExitCode::file_io, "cannot read {} {}: {}", what, file.string(), why);
  };

  // Look before reading: a device never ends, a pipe without a writer never begins.
  const Descriptor descriptor(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (descriptor.get() < 0) {
    const int reason = errno;
    throw fail(std::strerror(reason) + (reason == ENOENT ? suggest_file(file) : ""));
  }
  struct stat status;
  if (fstat(descriptor.get(), &status) != 0) throw fail(std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw fail("it is a folder");
  if (!S_ISREG(status.st_mode)) throw fail("it is not a regular file");
  if (static_cast<size_t>(status.st_size) > most_bytes) {
    throw fail(fmt::format("it has {} bytes; the most is {} ({} MiB)", status.st_size, most_bytes,
                           most_bytes >> 20));
  }

  // Read to the end, whatever the size: files of /proc report 0.
  std::string text(std::min(std::max(static_cast<size_t>(status.st_size), least_piece), most_bytes) + 1,
                   '\0');
  for (size_t done = 0;;) {
    if (done > most_bytes) throw fail(fmt::format("it has more than {} bytes", most_bytes));
    if (done == text.size()) text.resize(std::min(2 * done, most_bytes) + 1);
    const ssize_t count = read(descriptor.get(), text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw fail(std::strerror(errno));
    done += static_cast<size_t>(count);
    if (count > 0) continue;
    text.resize(done);
    return text;
  }
}

void drop_byte_order_mark(std::string& text) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  if (text.starts_with(mark)) text.erase(0, mark.size());
}

}  // namespace eyeray::engine
