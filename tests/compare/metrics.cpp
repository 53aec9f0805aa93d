#include "host/compare/metrics.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include "host/compare/flip.hpp"
#include "host/compare/plane.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::compare;
using namespace eyeray::engine::image;
using eyeray::engine::test::Random;

namespace {

Image constant(int width, int height, const Vec3& color) {
  Image image(width, height, 3);
  for (size_t i = 0; i < image.sample_count(); ++i) image.samples()[i] = float(color[int(i % 3)]);
  return image;
}

Image noise(int width, int height, uint64_t seed) {
  Random random(seed);
  Image image(width, height, 3);
  for (float& sample : image.samples()) sample = float(random.uniform());
  return image;
}

// Lightness of a linear grey, by CIE 1976.
double lightness(double y) {
  return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

}  // namespace

TEST_CASE("a picture has no difference from itself in any metric") {
  const Image image = noise(40, 30, 1);
  const Metrics m = measure(image, image);
  CHECK(m.rmse == 0);
  CHECK(std::isinf(m.psnr));
  CHECK(m.p99 == 0);
  CHECK(m.max == 0);
  CHECK(m.ssim == doctest::Approx(1));
  CHECK(m.flip.mean == 0);
}

TEST_CASE("one pixel's difference gives the numbers worked out by hand") {
  const Image a = constant(20, 10, Vec3(0.5));
  Image b = a;
  b.pixel(13, 7)[1] += 0.25f;
  const Metrics m = measure(a, b);
  CHECK(m.rmse == doctest::Approx(0.25 / std::sqrt(600.0)));
  CHECK(m.psnr == doctest::Approx(10 * std::log10(600 / 0.0625)));
  CHECK(m.max == doctest::Approx(0.25));
  CHECK(m.max_at == Pixel{13, 7});
  // 1 of 200 pixels differs: the 99 % quantile is 0, and the 99.9 % quantile is not.
  CHECK(m.p99 == 0);
  CHECK(m.p999 == doctest::Approx(0.25));
  b.pixel(3, 2)[0] += 0.125f;
  CHECK(measure(a, b).p99 == 0);
  b.pixel(3, 3)[0] += 0.125f;
  CHECK(measure(a, b).p99 == doctest::Approx(0.125));
  CHECK(m.ssim < 1);
  CHECK(m.flip.mean > 0);
  CHECK(m.flip.p99 >= m.flip.p95);
  CHECK(m.max_a == Vec3(0.5));
  CHECK(m.max_b == Vec3(0.5, 0.75, 0.5));
  CHECK(m.relative_mse == doctest::Approx(0.0625 / (0.76 * 0.76) / 600));
  // sRGB of 0.5 is 187.5 of 255, of 0.75 it is 224.7.
  CHECK(m.display_over == std::array<int64_t, 5>{1, 1, 1, 1, 1});
  CHECK(m.decades == std::array<int64_t, 9>{199, 0, 0, 0, 0, 0, 0, 1, 0});
  b.pixel(4, 4)[0] += 0.01f;
  CHECK(measure(a, b).display_over == std::array<int64_t, 5>{4, 3, 3, 3, 3});
  CHECK(measure(a, b).p95 == 0);
  CHECK(count_different(a, b, 1e-4) == 4);
  CHECK(count_different(a, b, 0.3) == 0);
  CHECK(*log_difference(a, b).pixel(13, 7) == doctest::Approx(std::log10(0.25)));
  CHECK(*log_difference(a, b).pixel(0, 0) == -8.0f);
}

TEST_CASE("a value that is not finite has an infinite difference") {
  const Image a = constant(5, 5, Vec3(0.5));
  Image b = a;
  b.pixel(2, 3)[0] = std::numeric_limits<float>::quiet_NaN();
  const Metrics m = measure(a, b);
  CHECK(std::isinf(m.max));
  CHECK(std::isinf(m.rmse));
  CHECK(m.display_over[4] == 1);
  CHECK(m.decades.back() == 1);
  CHECK(m.max_at == Pixel{2, 3});
}

TEST_CASE("SSIM of constant pictures is their luminance term") {
  const auto encoded = [](double x) { return 1.055 * std::pow(x, 1 / 2.4) - 0.055; };
  const double a = encoded(0.2), b = encoded(0.6), c1 = 1e-4;
  const double expected = (2 * a * b + c1) / (a * a + b * b + c1);
  CHECK(measure(constant(20, 20, Vec3(0.2)), constant(20, 20, Vec3(0.6))).ssim == doctest::Approx(expected));
  // Independent noise has no structure in common.
  CHECK(measure(noise(60, 60, 1), noise(60, 60, 1'000'000)).ssim < 0.1);
}

TEST_CASE("FLIP of constant greys is the paper's redistributed HyAB distance") {
  // Greys have a* = b* = 0, so HyAB is the difference in L*; without any edge the feature error is 0.
  // The greatest distance, green to blue, is 41.276 (to the power 0.7).
  const auto expected = [](double a, double b) {
    const double greatest = 41.276, knee = 0.4 * greatest;
    const double error = std::pow(std::abs(lightness(a) - lightness(b)), 0.7);
    return error < knee ? error * 0.95 / knee : 0.95 + (error - knee) / (greatest - knee) * 0.05;
  };
  for (const auto& [a, b] : {std::pair{0.0, 1.0}, {0.2, 0.25}, {0.001, 0.002}, {0.5, 0.9}}) {
    const double flip = compare::flip(constant(30, 30, Vec3(a)), constant(30, 30, Vec3(b))).mean;
    CHECK(flip == doctest::Approx(expected(a, b)).epsilon(1e-3));
  }
  CHECK(compare::flip(constant(30, 30, Vec3(0)), constant(30, 30, Vec3(1))).mean ==
        doctest::Approx(0.9674).epsilon(1e-3));
}

TEST_CASE("FLIP agrees with the authors' program, filtered directly in two dimensions") {
  // The expected figures come from a transcription of the published steps, which is neither separable nor in
  // C++.
  const auto paint = [](const std::function<double(int x, int y, int c)>& value) {
    Image image(24, 20, 3);
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 24; ++x) {
        for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = float(value(x, y, c));
      }
    }
    return image;
  };
  const Image pattern = paint([](int x, int y, int c) { return (x * 7 + y * 13 + c * 5) % 17 / 16.0; });
  const Image other =
      paint([](int x, int y, int c) { return (x * 7 + y * 11 + c * 5 + x * y / 9) % 17 / 16.0; });
  CHECK(compare::flip(pattern, other).mean == doctest::Approx(0.246853).epsilon(1e-4));
  const Image plain = constant(24, 20, Vec3(0.3));
  const Image bar =
      paint([](int x, int, int c) { return 0.3 + (x >= 8 && x < 14 ? 0.4 : 0.0) * (c == 1 ? 1 : 0.5); });
  CHECK(compare::flip(plain, bar).mean == doctest::Approx(0.336658).epsilon(1e-4));
}

TEST_CASE("FLIP is symmetric, within [0, 1], and clips") {
  const Image a = noise(50, 40, 3), b = noise(50, 40, 4'000'000);
  CHECK(compare::flip(a, b).mean == doctest::Approx(compare::flip(b, a).mean));
  CHECK(compare::flip(a, b).mean > 0.1);
  CHECK(compare::flip(a, b).mean < 1);
  CHECK(compare::flip(constant(9, 9, Vec3(1)), constant(9, 9, Vec3(50))).mean == 0);
}

TEST_CASE("separable filters: constants stay, an impulse becomes the kernels' product, borders go on") {
  Plane plane(9, 7);
  for (double& value : plane.values) value = 3;
  const Kernel smooth = gaussian(1.0, 2), slope{-0.5, 0, 0.5};
  for (const double value : convolve(plane, smooth, smooth).values) CHECK(value == doctest::Approx(3));
  for (const double value : convolve(plane, slope, smooth).values) CHECK(value == doctest::Approx(0));

  Plane impulse(9, 7);
  impulse.at(4, 3) = 1;
  const Plane result = convolve(impulse, slope, smooth);
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x < 9; ++x) {
      const int i = 4 - x, j = 3 - y;
      const double expected =
          std::abs(i) <= 1 && std::abs(j) <= 2 ? slope[size_t(i + 1)] * smooth[size_t(j + 2)] : 0.0;
      CHECK(result.at(x, y) == doctest::Approx(expected));
    }
  }
}
