#include "host/compare/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/compare/flip.hpp"
#include "host/compare/plane.hpp"
#include "host/compare/tolerance.hpp"
#include "host/core/error.hpp"
#include "host/image/srgb.hpp"

namespace eyeray::compare {

namespace {

// The worst channel's difference; infinite where it is not a number.
double difference(const Vec3& a, const Vec3& b) {
  double worst = 0;
  for (int c = 0; c < 3; ++c) {
    const double error = std::abs(a[c] - b[c]);
    worst = std::max(worst, std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
  }
  return worst;
}

Plane luma(const Image& image) {
  Plane plane(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      Vec3 color = glm::clamp(color_at(image, x, y), 0.0, 1.0);
      for (int c = 0; c < 3; ++c) color[c] = srgb_from_linear(color[c]);
      plane.at(x, y) = glm::dot(color, Vec3(0.2126, 0.7152, 0.0722));
    }
  }
  return plane;
}

Plane product(const Plane& a, const Plane& b) {
  Plane result(a.width, a.height);
  std::transform(a.values.begin(), a.values.end(), b.values.begin(), result.values.begin(),
                 std::multiplies<>());
  return result;
}

double mean_ssim(const Image& image_a, const Image& image_b) {
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  const Kernel window = gaussian(1.5, 5);
  const auto blur = [&](const Plane& plane) { return convolve(plane, window, window); };

  // The windows' means, variances and covariance.
  const Plane a = luma(image_a), b = luma(image_b);
  const Plane mean_a = blur(a), mean_b = blur(b);
  const Plane square_a = blur(product(a, a)), square_b = blur(product(b, b)), cross = blur(product(a, b));

  double sum = 0;
  for (size_t i = 0; i < a.values.size(); ++i) {
    const double ma = mean_a.values[i], mb = mean_b.values[i];
    const double variances = square_a.values[i] - ma * ma + square_b.values[i] - mb * mb;
    const double covariance = cross.values[i] - ma * mb;
    sum += (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (variances + c2));
  }
  return sum / double(a.values.size());
}

// The least value that `share` of `values` do not exceed; reorders them.
double percentile(std::vector<double>& values, double share) {
  const size_t rank =
      std::min(values.size() - 1, size_t(std::max(0.0, std::ceil(share * double(values.size())) - 1)));
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(rank), values.end());
  return values[rank];
}

}  // namespace

Metrics measure(const Image& a, const Image& b) {
  CHECK(a.same_size(b));
  CHECK_LE(1u, a.sample_count());
  Metrics metrics;

  // One pass for the sums and the greatest difference.
  std::vector<double> differences;
  double squares = 0;
  metrics.max = -1;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const Vec3 color_a = color_at(a, x, y), color_b = color_at(b, x, y);
      const double worst = difference(color_a, color_b);
      differences.push_back(worst);
      squares += std::isinf(worst) ? worst : glm::dot(color_a - color_b, color_a - color_b);
      if (worst > metrics.max) {
        metrics.max = worst;
        metrics.max_at = {x, y};
      }
    }
  }
  metrics.rmse = std::sqrt(squares / (3.0 * double(differences.size())));
  metrics.psnr = -20 * std::log10(metrics.rmse);
  metrics.p99 = percentile(differences, 0.99);
  metrics.p999 = percentile(differences, 0.999);

  metrics.ssim = mean_ssim(a, b);
  metrics.flip = mean_flip(a, b);
  return metrics;
}

int64_t count_different(const Image& a, const Image& b, double tolerance) {
  CHECK(a.same_size(b));
  CHECK_LE(0.0, tolerance);
  CHECK_LE(tolerance, 1.0);
  int64_t count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      if (!(color_excess(color_at(a, x, y), color_at(b, x, y), tolerance) <= 1)) ++count;
    }
  }
  return count;
}

Image log_difference(const Image& a, const Image& b) {
  CHECK(a.same_size(b));
  Image result(a.width(), a.height(), 1);
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const double worst = difference(color_at(a, x, y), color_at(b, x, y));
      *result.pixel(x, y) = float(std::log10(std::max(worst, 1e-8)));
    }
  }
  return result;
}

}  // namespace eyeray::compare
