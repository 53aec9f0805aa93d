#include "host/image/false_color.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"
#include "host/image/srgb.hpp"

namespace eyeray::engine::image {

namespace {

constexpr double grey = 0.35;

// Viridis (van der Walt and Smith 2015) as Matt Zucker's polynomial of degree 6, error below 0.01. x in [0,
// 1].
Vec3 viridis(double x) {
  const Vec3 c[] = {
      {0.2777273272234177, 0.005407344544966578, 0.3340998053353061},
      {0.1050930431085774, 1.404613529898575, 1.384590162594685},
      {-0.3308618287255563, 0.214847559468213, 0.09509516302823659},
      {-4.634230498983486, -5.799100973351585, -19.33244095627987},
      {6.228269936347081, 14.17993336680509, 56.69055260068105},
      {4.776384997670288, -13.74514537774601, -65.35303263337234},
      {-5.435455855934631, 4.645852612178535, 26.3124352495832},
  };
  return c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * (c[5] + x * c[6])))));
}

// Hues a golden angle apart, so that neighbours in number differ most; lightness alternates in threes.
Vec3 id_color(double id) {
  const double hue = std::fmod(id * 0.6180339887498949, 1.0) * 2 * M_PI;
  const double value = 0.95 - 0.2 * std::fmod(id, 3.0);
  const Vec3 wheel(std::cos(hue), std::cos(hue - 2 * M_PI / 3), std::cos(hue + 2 * M_PI / 3));
  return value * (0.55 + 0.45 * wheel);
}

}  // namespace

double FalseColorPainter::Range::position(double value) const {
  return low < high ? (value - low) / (high - low) : value - low;
}

FalseColorPainter::FalseColorPainter(FalseColor kind, int channels) : kind_(kind), ranges_(size_t(channels)) {
  const bool one_channel = kind == FalseColor::scalar || kind == FalseColor::depth || kind == FalseColor::ids;
  CHECK(one_channel ? channels == 1 : channels == 3 || kind == FalseColor::position);
  CHECK_LE(channels, 3);
}

void FalseColorPainter::see(const Image& data) {
  CHECK_EQ(size_t(data.channels()), ranges_.size());
  for (size_t i = 0; i < data.sample_count(); ++i) {
    Range& range = ranges_[i % ranges_.size()];
    const double value = double(data.samples()[i]);
    if (!std::isfinite(value)) continue;
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
}

// 1 at the least depth, 0 at the greatest, by the logarithm.
double FalseColorPainter::nearness(double depth) const {
  const double low = std::log(std::max(ranges_[0].low, 1e-30));
  const double high = std::log(std::max(ranges_[0].high, 1e-30));
  return high > low ? (high - std::log(depth)) / (high - low) : 1.0;
}

// The sRGB colour of one pixel's data; grey where there is none.
Vec3 FalseColorPainter::color(const float* value) const {
  const double x = double(value[0]);
  switch (kind_) {
    case FalseColor::scalar:
      return std::isfinite(x) ? viridis(ranges_[0].position(x)) : Vec3(grey);
    case FalseColor::depth:
      return std::isfinite(x) && x > 0 ? viridis(nearness(x)) : Vec3(grey);
    case FalseColor::ids:
      return x >= 0 && std::isfinite(x) ? id_color(x) : Vec3(grey);
    case FalseColor::color: {
      const Vec3 shown(x, double(value[1]), double(value[2]));
      return {srgb_from_linear(shown.x), srgb_from_linear(shown.y), srgb_from_linear(shown.z)};
    }
    case FalseColor::direction: {
      const Vec3 n(x, double(value[1]), double(value[2]));
      return glm::dot(n, n) > 0 ? 0.5 * (n + 1.0) : Vec3(grey);
    }
    case FalseColor::position: {
      Vec3 color(0.0);
      for (size_t c = 0; c < ranges_.size(); ++c) {
        const double v = double(value[c]);
        if (!std::isfinite(v)) return Vec3(grey);
        color[int(c)] = ranges_[c].position(v);
      }
      return color;
    }
  }
  return Vec3(grey);
}

Image FalseColorPainter::paint(const Image& data) const {
  CHECK_EQ(size_t(data.channels()), ranges_.size());
  Image picture(data.width(), data.height(), 3);
  parallel_for(0, data.height(), [&](int y) {
    for (int x = 0; x < data.width(); ++x) {
      const Vec3 shown = glm::clamp(color(data.pixel(x, y)), 0.0, 1.0);
      // The colours are sRGB, as a screen shows them; an image is linear.
      for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = float(linear_from_srgb(shown[c]));
    }
  });
  return picture;
}

Image false_color(const Image& data, FalseColor kind) {
  FalseColorPainter painter(kind, data.channels());
  painter.see(data);
  return painter.paint(data);
}

}  // namespace eyeray::engine::image
