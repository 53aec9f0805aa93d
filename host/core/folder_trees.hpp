// The files that a file may refer to: those in the allowed folder trees, links followed.
#pragma once

#include <filesystem>
#include <vector>

namespace eyeray::engine {

class FolderTrees {
 public:
  // Allows everything below `folder`; "" is the working directory. A folder that does not exist allows
  // nothing.
  void allow(const std::filesystem::path& folder);
  // True if `file`, which need not exist, lies in one of the trees once its links are followed.
  bool hold(const std::filesystem::path& file) const;

 private:
  std::vector<std::filesystem::path> trees_;  // canonical
};

}  // namespace eyeray::engine
