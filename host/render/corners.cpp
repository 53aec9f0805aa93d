#include "render/corners.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/camera_frame.hpp"

namespace eyeray {
namespace {

// A row of pixels from the rows of corners above and below it.
void mean_of_corners(const float* above, const float* below, int channels, Image& pixels, int row) {
  for (int x = 0; x < pixels.width(); ++x) {
    float* pixel = pixels.pixel(x, row);
    for (int c = 0; c < channels; ++c) {
      const int left = x * channels + c, right = left + channels;
      pixel[c] = ((above[left] + above[right]) + (below[left] + below[right])) / 4;
    }
  }
}

// All rows of pixels between the rows of corners, of which `last` is the one before; and the new last one.
Image between(Image& last, const Image& corners) {
  const int above = last.height();
  Image pixels(corners.width() - 1, corners.height() - 1 + above, corners.channels());
  for (int row = 0; row < pixels.height(); ++row) {
    const int upper = row - above;
    mean_of_corners(upper < 0 ? last.pixel(0, 0) : corners.pixel(0, upper), corners.pixel(0, upper + 1),
                    corners.channels(), pixels, row);
  }
  last = Image(corners.width(), 1, corners.channels());
  const float* row = corners.pixel(0, corners.height() - 1);
  std::copy(row, row + last.sample_count(), last.pixel(0, 0));
  return pixels;
}

}  // namespace

void sample_corners(Scene& scene) {
  const double wider = double(scene.image.width + 1) / scene.image.width;
  Camera& camera = scene.camera;
  const double distance = camera_frame(camera, scene.image.width, scene.image.height).distance;
  camera.fov_degrees = std::atan2(wider, distance) * 360 / std::numbers::pi;
  camera.fov_axis = FovAxis::horizontal;
  camera.size *= wider;
  scene.image.width += 1;
  scene.image.height += 1;
  scene.image.samples = 1;
  scene.image.pattern = SamplePattern::regular;
}

Rect corners_of(const Rect& pixels) {
  return {pixels.x, pixels.y, pixels.width + 1, pixels.height + 1};
}

FinishedRows CornerMean::add(const FinishedRows& corners) {
  FinishedRows rows;
  rows.first = std::max(0, corners.first - 1);
  rows.color = between(last_color_, corners.color);
  rows.hits = between(last_hits_, corners.hits);
  rows.flagged_pixels = corners.flagged_pixels;
  rows.flags = corners.flags;
  return rows;
}

}  // namespace eyeray
