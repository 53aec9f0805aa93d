// Output files appear whole or not at all.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace eyeray {

// Writes `bytes` to PATH.part.PID beside `path`, fsyncs and renames it. On any failure the part file is
// removed, what stood at `path` before is untouched, and an Error (file_io) says why.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

// The same in pieces, for what is larger than memory: the file appears with commit(), and not at all without.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Appends, unbuffered.
  void write(std::span<const std::byte> bytes);
  void commit();

 private:
  class Part;
  std::filesystem::path path_;
  std::unique_ptr<Part> part_;
};

// Error (file_io) now rather than after a long render: whether a file of that name can be written.
void check_writable(const std::filesystem::path& path);

// The whole file; Error (file_io) when it cannot be read.
std::string read_file(const std::filesystem::path& path);

}  // namespace eyeray
