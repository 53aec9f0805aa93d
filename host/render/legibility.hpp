// Checks whether a picture shows anything: how much of it is brighter than white, and whether it shows more
// than the background.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "host/core/vec.hpp"
#include "host/image/image.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::render {

class Legibility {
 public:
  // `background`: linear RGB of rays that miss. `exposure`: that of the shown picture, in stops.
  Legibility(const Vec3& background, double exposure);

  // Rows of the picture, 3 channels, linear.
  void see(const image::Image& rows);
  // A sentence, if more than half of the foreground is beyond 1, or if less than a thousandth of the picture
  // is foreground; else "".
  std::string warning() const;

 private:
  Vec3 background_;
  double exposure_;
  double gain_;
  int64_t pixels_ = 0;
  int64_t foreground_ = 0;  // pixels that differ from the background
  // Pixels of the foreground with all channels beyond 1, by the whole stops that they are beyond it.
  std::array<int64_t, 64> bright_{};
};

// The check for a scene that is a model alone, in eyeray's own light, shown at that exposure; empty for other
// scenes, or with an environment.
std::optional<Legibility> legibility_of(const Scene& scene, double exposure);

}  // namespace eyeray::engine::render
