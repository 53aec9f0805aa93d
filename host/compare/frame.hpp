// One executor's results for one picture, in the form in which they are compared.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/core/pixel.hpp"
#include "host/core/rect.hpp"
#include "host/image/image.hpp"

namespace eyeray::engine::compare {

// One sample of a pixel whose path is random.
struct TracedSample {
  glm::vec3 color{0.0f};
  uint32_t trail = 0;  // PixelSample::trail
  uint32_t hits = 0;
  uint32_t rays = 0;
};

struct Frame {
  Rect area;                         // the part of the whole picture that the frame holds
  image::Image color;                // linear RGB, the mean of the samples
  std::vector<FirstHit> first_hits;  // row by row
  image::Image hits;                 // 1 channel: surfaces hit, the mean of the samples
  image::Image rays_traced;          // 1 channel: camera, reflected, refracted and shadow rays, the mean
  uint64_t rays = 0;                 // the number of all rays
  uint64_t flagged_pixels = 0;       // pixels with any SampleFlag
  uint32_t flags = 0;                // all SampleFlags seen

  std::vector<TracedSample> samples = {};  // for random paths: equally many of each pixel, pixel by pixel

  const FirstHit& first_hit(int x, int y) const {
    return first_hits[size_t(y) * size_t(area.width) + size_t(x)];
  }
};

// A pixel of the whole picture.
struct Pixel {
  int x = -1;
  int y = -1;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

// The colour of pixel (x, y) of a 1- or 3-channel image.
inline Vec3 color_at(const image::Image& image, int x, int y) {
  const float* p = image.pixel(x, y);
  return image.channels() == 3 ? Vec3(double(p[0]), double(p[1]), double(p[2])) : Vec3(double(p[0]));
}

// Surfaces hit and rays traced for a pixel, the means of its samples.
using Counts = Vec2;

inline Counts counts_at(const Frame& frame, int x, int y) {
  return {double(*frame.hits.pixel(x, y)), double(*frame.rays_traced.pixel(x, y))};
}

// Weights of Rec. 709's luma, for linear or encoded colours.
inline constexpr Vec3 luma_weights(0.2126, 0.7152, 0.0722);

// Why two frames cannot be compared at all ("its picture is 95×72, not 96×72"); empty when they can.
std::string why_incomparable(const Frame& value, const Frame& reference);

}  // namespace eyeray::engine::compare
