#include "host/generate/studio.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/vec.hpp"

namespace eyeray::engine::generate {

namespace {

// An area light. Its centre and half size are shares of the picture's width and height.
struct AreaLight {
  Vec2 center, half_size;
  Vec3 radiance;
};

constexpr AreaLight area_lights[] = {
    {{0.27, 0.3}, {0.085, 0.15}, {7, 7.4, 8}},       // the soft box, over the left shoulder
    {{0.83, 0.36}, {0.022, 0.27}, {12, 9.5, 6.5}},   // the strip, behind to the right
    {{0.56, 0.16}, {0.017, 0.034}, {110, 105, 95}},  // the area light, high up
    {{0.5, 0.52}, {0.13, 0.012}, {0.9, 1.05, 1.4}},  // a window's gap, low in front
};

// The coverage of a light: 1 within and 0 outside. It falls from 0.9 to 1.1 half sizes, and is 1/2 at the
// rim.
double cover(double distance, double half_size) {
  return std::clamp((half_size - distance) / (0.2 * half_size) + 0.5, 0.0, 1.0);
}

Vec3 light(double u, double v) {
  // Walls that are lighter towards the ceiling, and a floor.
  Vec3 color = v < 0.5 ? Vec3(0.16, 0.165, 0.18) + (0.5 - v) * Vec3(0.3, 0.31, 0.33) : Vec3(0.1, 0.09, 0.08);
  for (const AreaLight& light : area_lights) {
    const double across = std::abs(u - light.center.x);
    color += cover(std::min(across, 1 - across), light.half_size.x) *
             cover(std::abs(v - light.center.y), light.half_size.y) * light.radiance;
  }
  return color;
}

}  // namespace

image::Image studio(int width) {
  image::Image picture(width, width / 2, 3);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < width; ++x) {
      const Vec3 color = light((x + 0.5) / width, (y + 0.5) / picture.height());
      for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = float(color[c]);
    }
  return picture;
}

}  // namespace eyeray::engine::generate
