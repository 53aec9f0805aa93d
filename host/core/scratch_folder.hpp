#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "host/core/error.hpp"
#include "host/core/unfinished_files.hpp"

namespace eyeray::engine {

// A folder that is gone at the end, with all that is in it, however the program ends. Error (file_io) where
// none can be made.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "eyeray-XXXXXX").string();
    UnfinishedFiles unfinished;
    if (!mkdtemp(name.data()))
      throw Error(ExitCode::file_io, "cannot make a folder in {}: {}",
                  std::filesystem::temp_directory_path().string(), strerror(errno));
    path_ = name;
    unfinished.add(path_);
  }
  ~ScratchFolder() {
    UnfinishedFiles unfinished;
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    unfinished.drop(path_);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace eyeray::engine
