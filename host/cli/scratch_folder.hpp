#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "core/error.hpp"

namespace eyeray::cli {

// A folder that is gone at the end, with all that is in it. Error (file_io) where none can be made.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "eyeray-bench-XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw Error(ExitCode::file_io, "cannot make a folder in {}: {}",
                  std::filesystem::temp_directory_path().string(), strerror(errno));
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace eyeray::cli
