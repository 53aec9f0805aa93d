// Output files appear whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace eyeray::engine {

// A file that grows as PATH.part.PID beside `path`, so that the rename stays within one file system, and
// replaces `path` at commit(). Without commit(), the destructor removes the part file, and a file at `path`
// is untouched. If `path` is a symbolic link, the file that it points to is replaced, or made. The mode of a
// replaced file is kept; a new file gets `mode`, less the umask. If the file has other names (hard links) and
// may be written, commit() copies the part file into it instead. A copy that is cut off leaves the whole part
// file beside it. Every failure is an Error (file_io) that gives the reason, and `path` as the caller wrote
// it.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path, unsigned mode = 0666);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Writes after the bytes of the previous write().
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
  // At `offset` from the file's start; bytes never written read as 0.
  void write_at(uint64_t offset, std::span<const std::byte> bytes);
  // Reads bytes that were written at `offset`.
  void read_at(uint64_t offset, std::span<std::byte> bytes) const;
  // Syncs, and renames or copies; nothing may be written afterwards.
  void commit();

 private:
  // Replaces the content of the open file `target` by that of the part file.
  void copy_to(int target);

  std::filesystem::path named_;  // as the caller wrote it
  std::filesystem::path path_;   // behind links
  std::filesystem::path part_;
  int file_ = -1;
  uint64_t end_ = 0;
  bool committed_ = false;  // from then on the part file is left alone
};

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

// Throws Error (file_io) if no file of that name can be written: now rather than after a long render.
void check_writable(const std::filesystem::path& path);

// The whole file; Error (file_io) when it cannot be read.
std::string read_file(const std::filesystem::path& path);

}  // namespace eyeray::engine
