#include "host/compare/flip.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "host/compare/frame.hpp"
#include "host/compare/plane.hpp"
#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"

namespace eyeray::engine::compare {

namespace {

constexpr double pixels_per_degree = 0.7 * 3840 / 0.7 * M_PI / 180;

// The paper's constants.
constexpr double color_exponent = 0.7;    // q_c
constexpr double knee = 0.4;              // p_c: this share of the greatest colour distance …
constexpr double knee_error = 0.95;       // p_t: … becomes this error
constexpr double feature_width = 0.082;   // w, degrees
constexpr double feature_exponent = 0.5;  // q_f

const glm::dmat3 xyz_from_rgb =
    glm::transpose(glm::dmat3(10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794,  //
                              2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,    //
                              1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382));
const glm::dmat3 rgb_from_xyz = glm::inverse(xyz_from_rgb);
const Vec3 white = xyz_from_rgb * Vec3(1.0);

Vec3 ycxcz_from_rgb(const Vec3& rgb) {
  const Vec3 xyz = xyz_from_rgb * rgb / white;
  return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)};
}

Vec3 rgb_from_ycxcz(const Vec3& ycxcz) {
  const double y = (ycxcz.x + 16) / 116;
  return rgb_from_xyz * (white * Vec3(y + ycxcz.y / 500, y, y - ycxcz.z / 200));
}

// The cube root of a positive number, accurate to its last bits: three of Halley's steps from a guess whose
// exponent is a third of x's. It takes half the time of std::cbrt, which took a sixth of FLIP's time.
double cube_root(double x) {
  double root = std::bit_cast<double>(std::bit_cast<uint64_t>(x) / 3 + 0x2a9f7893782da1ce);
  for (int step = 0; step < 3; ++step) {
    const double cube = root * root * root;
    root *= (cube + 2 * x) / (2 * cube + x);
  }
  return root;
}

// x^exponent to float32's precision, in half the time of float64's std::pow.
double power(double x, double exponent) {
  return double(std::pow(float(x), float(exponent)));
}

Vec3 lab_from_rgb(const Vec3& rgb) {
  const auto f = [](double x) { return x > 216.0 / 24389 ? cube_root(x) : (24389.0 / 27 * x + 16) / 116; };
  const Vec3 xyz = xyz_from_rgb * rgb / white;
  return {116 * f(xyz.y) - 16, 500 * (f(xyz.x) - f(xyz.y)), 200 * (f(xyz.y) - f(xyz.z))};
}

// L*a*b* after the Hunt effect: colour counts for less in the dark.
Vec3 hunt(const Vec3& lab) {
  return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

// The length of (x, y), for values that are neither huge nor tiny: std::hypot is slow because it handles
// those.
double length(double x, double y) {
  return std::sqrt(x * x + y * y);
}

// HyAB (Abasi 2020), for large colour differences.
double hyab(const Vec3& a, const Vec3& b) {
  return std::abs(a.x - b.x) + length(a.y - b.y, a.z - b.z);
}

struct Planes {
  Plane y, cx, cz;
};

Planes to_planes(const image::Image& image) {
  Planes planes{
      {image.width(), image.height()}, {image.width(), image.height()}, {image.width(), image.height()}};
  parallel_for(0, image.height(), [&](int y) {
    for (int x = 0; x < image.width(); ++x) {
      const Vec3 p = ycxcz_from_rgb(glm::clamp(color_at(image, x, y), 0.0, 1.0));
      planes.y.at(x, y) = p.x;
      planes.cx.at(x, y) = p.y;
      planes.cz.at(x, y) = p.z;
    }
  });
  return planes;
}

// One Gaussian of a contrast sensitivity function: a · √(π/b) · exp(−π² x² / b), x in degrees.
struct Sensitivity {
  double a;
  double b;
  double sigma() const { return std::sqrt(b / 2) / M_PI * pixels_per_degree; }
  double weight() const { return a * std::sqrt(M_PI / b); }
};

// `plane` as the eye resolves it: filtered by a sum of Gaussians. Each Gaussian is separable. So `plane` is
// filtered by each one, and the results are summed by each one's share of the whole sum of weights.
Plane filter(const Plane& plane, std::initializer_list<Sensitivity> sensitivities) {
  // All channels use the radius of the widest Gaussian, but a narrow Gaussian is cut off where its weights
  // fall below 1e-12.
  const int widest = int(std::ceil(3 * Sensitivity{1, 0.04}.sigma()));
  Plane result(plane.width, plane.height);
  double total = 0;
  for (const Sensitivity& s : sensitivities) {
    const int radius = std::min(widest, int(std::ceil(7.5 * s.sigma())));
    const Kernel kernel = gaussian(s.sigma(), radius);
    const double peak = kernel[size_t(radius)];
    const double share = s.weight() / (peak * peak);  // the sum of the unnormalised weights in two dimensions
    const Plane part = convolve(plane, kernel, kernel);
    parallel_for(0, plane.height, [&](int y) {
      for (int x = 0; x < plane.width; ++x) result.at(x, y) += share * part.at(x, y);
    });
    total += share;
  }
  parallel_for(0, plane.height, [&](int y) {
    for (int x = 0; x < plane.width; ++x) result.at(x, y) /= total;
  });
  return result;
}

std::vector<Vec3> perceived_colors(const Planes& planes) {
  const Plane y = filter(planes.y, {{1, 0.0047}});
  const Plane cx = filter(planes.cx, {{1, 0.0053}});
  const Plane cz = filter(planes.cz, {{34.1, 0.04}, {13.5, 0.025}});
  std::vector<Vec3> colors(y.values.size());
  parallel_for(0, planes.y.height, [&](int row) {
    for (size_t i = size_t(row) * size_t(y.width); i < size_t(row + 1) * size_t(y.width); ++i) {
      const Vec3 rgb = rgb_from_ycxcz({y.values[i], cx.values[i], cz.values[i]});
      colors[i] = hunt(lab_from_rgb(glm::clamp(rgb, 0.0, 1.0)));
    }
  });
  return colors;
}

// The colour distance mapped to [0, 1]: small distances are spread out, large ones are compressed.
double color_error(const Vec3& a, const Vec3& b) {
  static const double greatest =
      std::pow(hyab(hunt(lab_from_rgb({0, 1, 0})), hunt(lab_from_rgb({0, 0, 1}))), color_exponent);
  if (a == b) return 0;
  const double error = power(hyab(a, b), color_exponent);
  if (error < knee * greatest) return error * knee_error / (knee * greatest);
  return knee_error + (error - knee * greatest) / (greatest - knee * greatest) * (1 - knee_error);
}

// Edges or points of the luminance: the lengths of the responses to a first or second derivative of a
// Gaussian.
enum class Feature { edge, point };

Plane features(const Plane& luminance, Feature feature) {
  const double sigma = 0.5 * feature_width * pixels_per_degree;
  const int radius = int(std::ceil(3 * sigma));
  const Kernel smooth = gaussian(sigma, radius);

  // The derivative, its positive weights summing to 1 and its negative ones to −1.
  Kernel derivative = smooth;
  double positive = 0, negative = 0;
  for (int x = -radius; x <= radius; ++x) {
    double& weight = derivative[size_t(x + radius)];
    weight *= feature == Feature::edge ? -x : x * x / (sigma * sigma) - 1;
    (weight > 0 ? positive : negative) += std::abs(weight);
  }
  for (double& weight : derivative) weight /= weight > 0 ? positive : negative;

  Plane result = convolve(luminance, derivative, smooth);
  const Plane vertical = convolve(luminance, smooth, derivative);
  parallel_for(0, result.height, [&](int y) {
    for (int x = 0; x < result.width; ++x) result.at(x, y) = length(result.at(x, y), vertical.at(x, y));
  });
  return result;
}

}  // namespace

std::vector<double> flip_map(const image::Image& a, const image::Image& b) {
  CHECK(a.same_size(b));
  CHECK_LE(1u, a.sample_count());
  Planes planes_a = to_planes(a), planes_b = to_planes(b);
  const std::vector<Vec3> colors_a = perceived_colors(planes_a), colors_b = perceived_colors(planes_b);

  // Features are searched for in the luminance, scaled to [0, 1].
  for (Plane* plane : {&planes_a.y, &planes_b.y}) {
    for (double& value : plane->values) value = (value + 16) / 116;
  }
  const Plane edges_a = features(planes_a.y, Feature::edge), edges_b = features(planes_b.y, Feature::edge);
  const Plane points_a = features(planes_a.y, Feature::point),
              points_b = features(planes_b.y, Feature::point);

  std::vector<double> map(colors_a.size());
  parallel_for(0, a.height(), [&](int y) {
    for (size_t i = size_t(y) * size_t(a.width()); i < size_t(y + 1) * size_t(a.width()); ++i) {
      const double edge = std::abs(edges_a.values[i] - edges_b.values[i]);
      const double point = std::abs(points_a.values[i] - points_b.values[i]);
      const double color = color_error(colors_a[i], colors_b[i]);
      if (color == 0) continue;
      const double feature_error = power(std::max(edge, point) / std::sqrt(2.0), feature_exponent);
      map[i] = power(color, 1 - feature_error);
    }
  });
  return map;
}

Flip flip(const image::Image& a, const image::Image& b) {
  return summary(flip_map(a, b));
}

Flip summary(std::vector<double> map) {
  const double mean = std::accumulate(map.begin(), map.end(), 0.0) / double(map.size());
  return {.mean = mean, .p95 = percentile(map, 0.95), .p99 = percentile(map, 0.99)};
}

}  // namespace eyeray::engine::compare
