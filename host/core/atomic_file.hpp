// Output files appear whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace eyeray::engine {

// A file that grows as PATH.part.PID beside `path`, so that the rename stays within one file system, and
// takes its place at commit(). Without that the part file goes with its scope, and a file at `path` is
// untouched. Where `path` is a symbolic link, the file that it points to is replaced, or made. A file that is
// replaced keeps its mode; a new one gets `mode`, less the umask. Every failure is an Error (file_io) that
// gives the reason, and `path` as the caller wrote it.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path, unsigned mode = 0666);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // After the bytes written last.
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
  // At `offset` from the file's start; bytes never written read as 0.
  void write_at(uint64_t offset, std::span<const std::byte> bytes);
  // Reads bytes that were written at `offset`.
  void read_at(uint64_t offset, std::span<std::byte> bytes) const;
  // Syncs and renames; nothing may be written afterwards.
  void commit();

 private:
  std::filesystem::path named_;  // as the caller wrote it
  std::filesystem::path path_;   // behind links
  std::filesystem::path part_;
  int file_ = -1;
  uint64_t end_ = 0;
  bool renamed_ = false;
};

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

// Error (file_io) now rather than after a long render: whether a file of that name can be written.
void check_writable(const std::filesystem::path& path);

// The whole file; Error (file_io) when it cannot be read.
std::string read_file(const std::filesystem::path& path);

}  // namespace eyeray::engine
