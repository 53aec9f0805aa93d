#include "host/core/folder_trees.hpp"

#include <algorithm>

namespace eyeray::engine {

namespace fs = std::filesystem;

void FolderTrees::allow(const fs::path& folder) {
  std::error_code error;
  const fs::path whole = fs::canonical(folder.empty() ? "." : folder, error);
  if (!error) trees_.push_back(whole);
}

bool FolderTrees::hold(const fs::path& file) const {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(fs::absolute(file), error);
  if (error) return false;
  return std::ranges::any_of(
      trees_, [&](const fs::path& tree) { return std::ranges::mismatch(tree, whole).in1 == tree.end(); });
}

}  // namespace eyeray::engine
