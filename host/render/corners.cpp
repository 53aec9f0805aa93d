#include "host/render/corners.hpp"

#include <algorithm>

#include "host/core/error.hpp"
#include "host/scene/sampler.hpp"

namespace eyeray::engine::render {
namespace {

float mean(float a, float b, float c, float d) {
  return ((a + b) + (c + d)) / 4;
}

float any_flag(float a, float b, float c, float d) {
  return float(uint32_t(a) | uint32_t(b) | uint32_t(c) | uint32_t(d));
}

using Combine = float (*)(float, float, float, float);

// A row of pixels from the rows of corners above and below it.
void combine_corners(const float* above, const float* below, Combine combine, image::Image& pixels, int row) {
  const int channels = pixels.channels();
  for (int x = 0; x < pixels.width(); ++x) {
    float* pixel = pixels.pixel(x, row);
    for (int c = 0; c < channels; ++c) {
      const int left = x * channels + c, right = left + channels;
      pixel[c] = combine(above[left], above[right], below[left], below[right]);
    }
  }
}

// All rows of pixels between `last`, the row of corners before `corners`, and the rows of `corners`. Sets
// `last` to the last of these.
image::Image between(image::Image& last, const image::Image& corners, Combine combine) {
  const int above = last.height();
  image::Image pixels(corners.width() - 1, corners.height() - 1 + above, corners.channels());
  for (int row = 0; row < pixels.height(); ++row) {
    const int upper = row - above;
    combine_corners(upper < 0 ? last.pixel(0, 0) : corners.pixel(0, upper), corners.pixel(0, upper + 1),
                    combine, pixels, row);
  }
  last = image::Image(corners.width(), 1, corners.channels());
  const float* row = corners.pixel(0, corners.height() - 1);
  std::copy(row, row + last.sample_count(), last.pixel(0, 0));
  return pixels;
}

}  // namespace

void sample_corners(Scene& scene) {
  const double wider = double(scene.image.width + 1) / scene.image.width;
  scene.camera.projection = scene.camera.projection->widened(wider, scene.image.size());
  scene.image.width += 1;
  scene.image.height += 1;
  scene.image.samples = 1;
  scene.image.pattern = SamplePattern::regular;
  scene.image.filter = PixelFilter::box;
}

Rect corners_of(const Rect& pixels) {
  return {pixels.x, pixels.y, pixels.width + 1, pixels.height + 1};
}

film::Rows CornerMean::add(const film::Rows& corners) {
  last_.resize(1 + corners.channels.size());
  film::Rows rows;
  rows.first = std::max(0, corners.first - 1);
  rows.color = between(last_[0], corners.color, mean);
  rows.channels = corners.channels;
  for (size_t i = 0; i < corners.channels.size(); ++i) {
    const film::OfCorners how = corners.channels[i]->of_corners;
    CHECK(how != film::OfCorners::nothing);
    rows.values.push_back(
        between(last_[1 + i], corners.values[i], how == film::OfCorners::any_bit ? any_flag : mean));
  }
  rows.flagged_pixels = corners.flagged_pixels;
  rows.flags = corners.flags;
  return rows;
}

}  // namespace eyeray::engine::render
