// What the ids of an AOV stand for: a JSON file beside its picture.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "host/cli/aov.hpp"
#include "host/scene/objects.hpp"

namespace eyeray::cli {

// Whether an AOV has a legend: its values are ids.
bool has_legend(Aov aov);

// Takes first hits, and lists what they hit: of `primitive` the shapes and meshes, of `material` the
// materials, each with its ids, its name, where the file has it, its colour in the picture, and its pixels.
class Legend {
 public:
  // `scene` must outlive it.
  Legend(Aov aov, const Scene& scene);

  void see(std::span<const FirstHit> hits);
  // Writes NAME.json for a picture NAME.png; Error (file_io) when it cannot be written. Its name.
  std::filesystem::path write(const std::filesystem::path& picture) const;

 private:
  Aov aov_;
  const Scene& scene_;
  Objects objects_;
  std::vector<uint64_t> pixels_;  // of each object, or of each material
  uint64_t nothing_ = 0;          // pixels where nothing is hit
};

}  // namespace eyeray::cli
