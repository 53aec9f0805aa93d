#include "host/render/legibility.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::render {

namespace {

// The difference up to which a display may show two values alike.
constexpr double alike = 1.0 / 512;
// The least share of a picture that must differ from the background.
constexpr double least_foreground = 1e-3;

}  // namespace

Legibility::Legibility(const Vec3& background, double exposure)
    : background_(background), gain_(std::exp2(exposure)) {}

void Legibility::see(const image::Image& rows) {
  for (int y = 0; y < rows.height(); ++y)
    for (int x = 0; x < rows.width(); ++x) {
      const float* pixel = rows.pixel(x, y);
      const Vec3 color(pixel[0], pixel[1], pixel[2]);
      const Vec3 apart = glm::abs(color - background_) * gain_;
      ++pixels_;
      if (!(std::max({apart.x, apart.y, apart.z}) > alike)) continue;
      ++foreground_;
      bright_ += std::min({color.x, color.y, color.z}) * gain_ > 1;
    }
}

std::string Legibility::warning() const {
  if (double(foreground_) < least_foreground * double(pixels_))
    return "the model cannot be distinguished from the background: smooth metal mirrors it, or the camera "
           "misses the model; add an environment, such as -D environment.image=studio.hdr, or choose another "
           "camera.eye";
  if (2 * bright_ > foreground_)
    return "more than half of the model is brighter than white: try --exposure -4, or --tone neutral";
  return "";
}

std::optional<Legibility> legibility_of(const Scene& scene) {
  if (!scene.is_mesh_alone || scene.environment) return std::nullopt;
  return Legibility(scene.render.background, scene.image.tone.exposure);
}

}  // namespace eyeray::engine::render
