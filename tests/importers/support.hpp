#pragma once

#include <fstream>
#include <string>

#include "host/importers/import.hpp"
#include "tests/support/process.hpp"
#include "tests/support/sound_mesh.hpp"
//
#include "tests/support/doctest.hpp"

namespace eyeray::engine::test {

// The scene that the importers make from the bytes, which must keep all promises.
inline importers::ImportedScene import_sound(const std::string& bytes, const std::string& name,
                                             const importers::ImportOptions& options = {}) {
  importers::ImportedScene scene = importers::import_bytes(bytes, name, options);
  CHECK(broken_promise(scene) == "");
  return scene;
}

// Why the bytes are refused, or "accepted".
inline std::string refusal(const std::string& bytes, const std::string& name,
                           const importers::ImportOptions& options = {}) {
  try {
    importers::import_bytes(bytes, name, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// True if some warning has the words.
inline bool warns(const importers::ImportedScene& scene, const std::string& words) {
  for (const std::string& warning : scene.warnings)
    if (contains(warning, words)) return true;
  return false;
}

// Twice the area of all triangles as seen from `up`; triangles that face away count as negative.
inline double signed_area(const Mesh& mesh, const Vec3& up) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    sum += glm::dot(up, glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                   mesh.positions[t[2]] - mesh.positions[t[0]]));
  }
  return sum;
}

class Folder : public TemporaryFolder {
 public:
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path() / name).parent_path());
    std::ofstream(path() / name, std::ios::binary) << text;
    return (path() / name).string();
  }
};

}  // namespace eyeray::engine::test
