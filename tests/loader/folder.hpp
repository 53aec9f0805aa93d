// A folder of files that a test writes.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/process.hpp"

namespace eyeray::engine::test {

class Folder : public TemporaryFolder {
 public:
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path() / name).parent_path());
    std::ofstream(path() / name) << text;
    return (path() / name).string();
  }
};

}  // namespace eyeray::engine::test
