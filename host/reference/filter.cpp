#include "host/reference/filter.hpp"

#include <cmath>

#include "host/reference/emitter_sample.hpp"

namespace eyeray::engine::reference {
namespace {

// Samples a Gaussian of standard deviation 1, cut off at 3: each ring of a uniform disk maps to a ring of the
// same probability.
Vec2 gaussian(const Vec2& u) {
  const Vec2 on_unit_disk = on_disk(u);
  const double share = glm::dot(on_unit_disk, on_unit_disk);
  if (share == 0) return Vec2(0.0);
  const double radius = std::sqrt(-2 * std::log1p(share * std::expm1(-4.5)));
  return radius / std::sqrt(share) * on_unit_disk;
}

// Harris, "On the Use of Windows for Harmonic Analysis with the Discrete Fourier Transform" (1978): the
// window with four terms and the lowest side lobes, from −½ to ½, and its integral from 0.
constexpr double terms[] = {0.35875, 0.48829, 0.14128, 0.01168};

double window(double x) {
  double sum = 0;
  for (int k = 0; k < 4; ++k) sum += terms[k] * std::cos(2 * M_PI * k * x);
  return sum / terms[0];
}

double integral(double x) {
  double sum = terms[0] * x;
  for (int k = 1; k < 4; ++k) sum += terms[k] * std::sin(2 * M_PI * k * x) / (2 * M_PI * k);
  return sum / terms[0];
}

// The point at which the integral is u − ½, by Newton's method. The method starts in the middle and never
// overshoots, since the window falls on either side.
double blackman_harris(double u) {
  const double wanted = std::abs(u - 0.5);
  double x = 0;
  for (int i = 0; i < 60 && x < 0.5; ++i) x = std::min(0.5, x + (wanted - integral(x)) / window(x));
  return std::copysign(x, u - 0.5);
}

}  // namespace

Vec2 filtered(const ImageSettings& image, const Vec2& u) {
  switch (image.filter) {
    case PixelFilter::box:
      return u;
    case PixelFilter::gaussian:
      return Vec2(0.5) + image.filter_width / 6 * gaussian(u);
    case PixelFilter::blackman_harris:
      return Vec2(0.5) + image.filter_width * Vec2(blackman_harris(u.x), blackman_harris(u.y));
  }
  return u;
}

}  // namespace eyeray::engine::reference
