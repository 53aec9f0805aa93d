// Checks whether a picture shows anything: the share of it that is beyond white, and whether there is more
// than background.
#pragma once

#include <optional>
#include <string>

#include "host/core/vec.hpp"
#include "host/image/image.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::render {

class Legibility {
 public:
  // `background`: linear RGB of rays that miss. `exposure`: stops, as the picture is shown.
  Legibility(const Vec3& background, double exposure);

  // Rows of the picture, 3 channels, linear.
  void see(const image::Image& rows);
  // One sentence where more than half of the foreground is beyond 1, or where all but a thousandth
  // is background; else "".
  std::string warning() const;

 private:
  Vec3 background_;
  double gain_;
  int64_t pixels_ = 0;
  int64_t foreground_ = 0;  // pixels that differ from the background
  int64_t bright_ = 0;      // of these, with all channels beyond 1
};

// For a model alone in eyeray's own light; nothing for other scenes, or with an environment.
std::optional<Legibility> legibility_of(const Scene& scene);

}  // namespace eyeray::engine::render
