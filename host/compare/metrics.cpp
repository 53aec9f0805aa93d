#include "host/compare/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "host/compare/plane.hpp"
#include "host/compare/tolerance.hpp"
#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"
#include "host/image/srgb.hpp"

namespace eyeray::engine::compare {

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

// The picture as a display shows it.
Vec3 encoded(const Vec3& color) {
  Vec3 result;
  for (int c = 0; c < 3; ++c) result[c] = image::srgb_from_linear(std::clamp(color[c], 0.0, 1.0));
  return result;
}

Plane luma(const image::Image& image) {
  Plane plane(image.width(), image.height());
  parallel_for(0, image.height(), [&](int y) {
    for (int x = 0; x < image.width(); ++x) {
      plane.at(x, y) = glm::dot(encoded(color_at(image, x, y)), luma_weights);
    }
  });
  return plane;
}

Plane product(const Plane& a, const Plane& b) {
  Plane result(a.width, a.height);
  std::transform(a.values.begin(), a.values.end(), b.values.begin(), result.values.begin(),
                 std::multiplies<>());
  return result;
}

double mean_ssim(const image::Image& image_a, const image::Image& image_b) {
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

}  // namespace

Metrics measure(const image::Image& a, const image::Image& b, bool hdr) {
  CHECK(a.same_size(b));
  CHECK_LE(1u, a.sample_count());
  Metrics metrics;

  // The differences of each pixel; a value that is no number counts as infinite.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const size_t pixels = size_t(a.width()) * size_t(a.height());
  std::vector<double> worst(pixels), square(pixels), relative(pixels), shown(pixels);
  parallel_for(0, a.height(), [&](int y) {
    for (int x = 0; x < a.width(); ++x) {
      const Vec3 color_a = color_at(a, x, y), color_b = color_at(b, x, y);
      const size_t i = size_t(y) * size_t(a.width()) + size_t(x);
      worst[i] = difference(color_a, color_b);
      square[i] = relative[i] = shown[i] = infinity;
      if (std::isinf(worst[i])) continue;
      const Vec3 apart = color_a - color_b, share = apart / (color_b + 0.01);
      square[i] = glm::dot(apart, apart);
      relative[i] = glm::dot(share, share);
      shown[i] = worst[i] > 0 ? 255 * difference(encoded(color_a), encoded(color_b)) : 0;
    }
  });

  const auto mean = [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / (3.0 * double(values.size()));
  };
  metrics.rmse = std::sqrt(mean(square));
  metrics.psnr = -20 * std::log10(metrics.rmse);
  metrics.relative_mse = mean(relative);
  for (size_t i = 0; i < display_steps.size(); ++i)
    metrics.display_over[i] = std::ranges::count_if(shown, [&](double s) { return s > display_steps[i]; });
  for (const double each : worst) {
    const double decade = each > 0 ? std::floor(std::log10(each)) - first_decade + 1 : 0;
    ++metrics.decades[size_t(std::clamp(decade, 0.0, double(metrics.decades.size() - 1)))];
  }
  const size_t greatest = size_t(std::ranges::max_element(worst) - worst.begin());
  metrics.max = worst[greatest];
  metrics.max_at = {int(greatest % size_t(a.width())), int(greatest / size_t(a.width()))};
  metrics.max_a = color_at(a, metrics.max_at.x, metrics.max_at.y);
  metrics.max_b = color_at(b, metrics.max_at.x, metrics.max_at.y);
  metrics.p95 = percentile(worst, 0.95);
  metrics.p99 = percentile(worst, 0.99);
  metrics.p999 = percentile(worst, 0.999);

  metrics.ssim = mean_ssim(a, b);
  metrics.flip = flip(a, b);
  if (hdr) metrics.hdr_flip = hdr_flip(a, b);
  return metrics;
}

int64_t count_different(const image::Image& a, const image::Image& b, double tolerance) {
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

image::Image log_difference(const image::Image& a, const image::Image& b) {
  CHECK(a.same_size(b));
  image::Image result(a.width(), a.height(), 1);
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const double worst = difference(color_at(a, x, y), color_at(b, x, y));
      *result.pixel(x, y) = float(std::log10(std::max(worst, 1e-8)));
    }
  }
  return result;
}

}  // namespace eyeray::engine::compare
