#include "host/render/legibility.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace eyeray::engine::render {

namespace {

// The difference up to which a display may show two values alike.
constexpr double alike = 1.0 / 512;
// The least share of a picture that must differ from the background.
constexpr double least_foreground = 1e-3;
// The most stops beyond white that a tone mapping can show.
constexpr size_t most_stops_of_tone = 4;

}  // namespace

Legibility::Legibility(const Vec3& background, double exposure)
    : background_(background), exposure_(exposure), gain_(std::exp2(exposure)) {}

void Legibility::see(const image::Image& rows) {
  for (int y = 0; y < rows.height(); ++y)
    for (int x = 0; x < rows.width(); ++x) {
      const float* pixel = rows.pixel(x, y);
      const Vec3 color(pixel[0], pixel[1], pixel[2]);
      const Vec3 apart = glm::abs(color - background_) * gain_;
      ++pixels_;
      if (!(std::max({apart.x, apart.y, apart.z}) > alike)) continue;
      ++foreground_;
      const double darkest = std::min({color.x, color.y, color.z}) * gain_;
      if (darkest > 1) ++bright_[std::min(bright_.size() - 1, size_t(std::ilogb(darkest)))];
    }
}

std::string Legibility::warning() const {
  if (double(foreground_) < least_foreground * double(pixels_))
    return "the model cannot be distinguished from the background: smooth metal mirrors it, or the camera "
           "misses the model; add an environment, such as -D environment.image=studio.hdr, or choose another "
           "camera.eye";
  // Count the stops after which half of the foreground is not brighter than white.
  int64_t brighter = std::accumulate(bright_.begin(), bright_.end(), int64_t{0});
  size_t stops = 0;
  for (; 2 * brighter > foreground_; ++stops) brighter -= bright_[stops];
  if (stops == 0) return "";
  return fmt::format("more than half of the model is brighter than white: try --exposure {}{}",
                     exposure_ - double(stops), stops <= most_stops_of_tone ? ", or --tone neutral" : "");
}

std::optional<Legibility> legibility_of(const Scene& scene, double exposure) {
  if (!scene.is_mesh_alone || scene.environment || scene.image.transparent) return std::nullopt;
  return Legibility(scene.render.background, exposure);
}

}  // namespace eyeray::engine::render
