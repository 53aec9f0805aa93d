// FLIP and HDR-FLIP written down once more, step by step as the papers and the authors' program have them:
// float64, filters in two dimensions, nothing shared with host/compare.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "host/image/image.hpp"

namespace eyeray::engine::test::book {

using Color = std::array<double, 3>;

struct Picture {
  int width, height;
  std::vector<Color> pixels;

  const Color& at(int x, int y) const {
    const int cx = std::clamp(x, 0, width - 1), cy = std::clamp(y, 0, height - 1);
    return pixels[size_t(cy) * size_t(width) + size_t(cx)];
  }
};

inline Picture each(const Picture& picture, const std::function<Color(const Color&)>& change) {
  Picture result = picture;
  std::ranges::transform(picture.pixels, result.pixels.begin(), change);
  return result;
}

inline Picture picture_of(const image::Image& image) {
  Picture picture{image.width(), image.height(), {}};
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const float* p = image.pixel(x, y);
      picture.pixels.push_back({double(p[0]), double(p[1]), double(p[2])});
    }
  return picture;
}

inline constexpr double to_xyz[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                        {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                        {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};

// XYZ divided by the XYZ of white.
inline Color relative_xyz(const Color& rgb) {
  Color xyz{};
  for (size_t i = 0; i < 3; ++i) {
    double white = 0;
    for (size_t j = 0; j < 3; ++j) {
      xyz[i] += to_xyz[i][j] * rgb[j];
      white += to_xyz[i][j];
    }
    xyz[i] /= white;
  }
  return xyz;
}

// The RGB of relative XYZ, by Cramer's rule.
inline Color rgb_from(const Color& relative) {
  double m[3][3];
  Color right{};
  for (size_t i = 0; i < 3; ++i) {
    double white = 0;
    for (size_t j = 0; j < 3; ++j) white += m[i][j] = to_xyz[i][j];
    right[i] = relative[i] * white;
  }
  const auto determinant = [](const double(&a)[3][3]) {
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
           a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
  };
  Color rgb{};
  for (size_t c = 0; c < 3; ++c) {
    double replaced[3][3];
    for (size_t i = 0; i < 3; ++i)
      for (size_t j = 0; j < 3; ++j) replaced[i][j] = j == c ? right[i] : m[i][j];
    rgb[c] = determinant(replaced) / determinant(m);
  }
  return rgb;
}

inline Color ycxcz(const Color& rgb) {
  const Color xyz = relative_xyz(rgb);
  return {116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])};
}

inline Color hunt_lab(const Color& rgb) {
  const auto f = [](double t) {
    constexpr double delta = 6.0 / 29;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
  };
  const Color xyz = relative_xyz(rgb);
  const double l = 116 * f(xyz[1]) - 16;
  return {l, 0.01 * l * 500 * (f(xyz[0]) - f(xyz[1])), 0.01 * l * 200 * (f(xyz[1]) - f(xyz[2]))};
}

inline double hyab(const Color& a, const Color& b) {
  return std::abs(a[0] - b[0]) + std::sqrt((a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

// Weights of pixels up to `radius` away, and their weighted sum of one channel.
struct Filter {
  int radius;
  std::vector<double> weights;

  double apply(const Picture& picture, int x, int y, size_t channel) const {
    double sum = 0;
    size_t i = 0;
    for (int dy = -radius; dy <= radius; ++dy)
      for (int dx = -radius; dx <= radius; ++dx) sum += weights[i++] * picture.at(x + dx, y + dy)[channel];
    return sum;
  }
};

inline const double pixels_per_degree = 0.7 * 3840 / 0.7 * M_PI / 180;

inline Filter sensitivity(double a1, double b1, double a2, double b2) {
  Filter filter{int(std::ceil(3 * std::sqrt(0.04 / (2 * M_PI * M_PI)) * pixels_per_degree)), {}};
  double sum = 0;
  for (int dy = -filter.radius; dy <= filter.radius; ++dy)
    for (int dx = -filter.radius; dx <= filter.radius; ++dx) {
      const double z = (dx * dx + dy * dy) / (pixels_per_degree * pixels_per_degree);
      filter.weights.push_back(a1 * std::sqrt(M_PI / b1) * std::exp(-M_PI * M_PI * z / b1) +
                               a2 * std::sqrt(M_PI / b2) * std::exp(-M_PI * M_PI * z / b2));
      sum += filter.weights.back();
    }
  for (double& weight : filter.weights) weight /= sum;
  return filter;
}

// The filter that detects points or edges, along x or along y.
inline Filter feature(bool point, bool along_y) {
  const double sd = 0.5 * 0.082 * pixels_per_degree;
  Filter filter{int(std::ceil(3 * sd)), {}};
  double positive = 0, negative = 0;
  for (int dy = -filter.radius; dy <= filter.radius; ++dy)
    for (int dx = -filter.radius; dx <= filter.radius; ++dx) {
      const double g = std::exp(-(dx * dx + dy * dy) / (2 * sd * sd)), d = along_y ? dy : dx;
      filter.weights.push_back(point ? (d * d / (sd * sd) - 1) * g : -d * g);
      (filter.weights.back() < 0 ? negative : positive) += std::abs(filter.weights.back());
    }
  for (double& weight : filter.weights) weight /= weight < 0 ? negative : positive;
  return filter;
}

// LDR-FLIP of each pixel of two pictures in [0, 1].
inline std::vector<double> ldr_flip(const Picture& a, const Picture& b) {
  static const Filter filters[] = {sensitivity(1, 0.0047, 0, 1e-5), sensitivity(1, 0.0053, 0, 1e-5),
                                   sensitivity(34.1, 0.04, 13.5, 0.025)};
  static const Filter features[] = {feature(false, false), feature(false, true), feature(true, false),
                                    feature(true, true)};
  const double greatest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), 0.7);
  const Picture opponent[] = {each(a, ycxcz), each(b, ycxcz)};
  std::vector<double> map;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      Color lab[2];
      double lengths[2][2];  // lengths of edges and points
      for (size_t i = 0; i < 2; ++i) {
        Color seen{};
        for (size_t c = 0; c < 3; ++c) seen[c] = filters[c].apply(opponent[i], x, y, c);
        const double luminance = (seen[0] + 16) / 116;
        Color rgb = rgb_from({luminance + seen[1] / 500, luminance, luminance - seen[2] / 200});
        for (double& value : rgb) value = std::clamp(value, 0.0, 1.0);
        lab[i] = hunt_lab(rgb);
        // Each filter's weights sum to 0: an offset of the luminance does not count.
        for (size_t kind = 0; kind < 2; ++kind)
          lengths[i][kind] = std::hypot(features[2 * kind].apply(opponent[i], x, y, 0),
                                        features[2 * kind + 1].apply(opponent[i], x, y, 0)) /
                             116;
      }
      const double error = std::pow(hyab(lab[0], lab[1]), 0.7);
      const double color = error < 0.4 * greatest
                               ? 0.95 / (0.4 * greatest) * error
                               : 0.95 + (error - 0.4 * greatest) / (greatest - 0.4 * greatest) * 0.05;
      const double apart =
          std::max(std::abs(lengths[0][0] - lengths[1][0]), std::abs(lengths[0][1] - lengths[1][1]));
      map.push_back(std::pow(color, 1 - std::sqrt(apart / std::sqrt(2.0))));
    }
  return map;
}

inline Picture shown(const Picture& picture, double exposure) {
  return each(picture, [&](const Color& color) {
    Color result{};
    for (size_t c = 0; c < 3; ++c) {
      const double x = std::pow(2, exposure) * std::max(color[c], 0.0) * 0.6;
      result[c] = std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    }
    return result;
  });
}

struct HdrFlip {
  double start, stop;
  int count;
  std::vector<double> map;
};

inline HdrFlip hdr_flip(const Picture& a, const Picture& reference) {
  std::vector<double> luminances;
  for (const Color& c : reference.pixels) luminances.push_back(0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]);
  std::ranges::sort(luminances);
  const double median = (luminances[luminances.size() / 2 - 1] + luminances[luminances.size() / 2]) / 2;
  // Find the argument at which the tone mapper, which rises, gives 0.85, by bisection.
  double low = 0, high = 100;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    const Color color = shown({1, 1, {{middle, middle, middle}}}, 0).pixels[0];
    (color[0] < 0.85 ? low : high) = middle;
  }
  HdrFlip result{std::log2(low / luminances.back()), std::log2(low / median), 0, {}};
  result.count = std::max(2, int(std::ceil(result.stop - result.start)));
  for (int i = 0; i < result.count; ++i) {
    const double exposure = result.start + i * (result.stop - result.start) / (result.count - 1);
    const std::vector<double> map = ldr_flip(shown(a, exposure), shown(reference, exposure));
    if (i == 0) result.map = map;
    for (size_t k = 0; k < map.size(); ++k) result.map[k] = std::max(result.map[k], map[k]);
  }
  return result;
}

}  // namespace eyeray::engine::test::book
