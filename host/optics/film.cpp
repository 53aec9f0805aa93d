#include "host/optics/film.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::optics {

namespace {

// The reflectance at perpendicular incidence between two indices.
double perpendicular(double n1, double n2) {
  return std::pow((n2 - n1) / (n2 + n1), 2);
}

double schlick_at(double f0, double cosine) {
  return f0 + (1 - f0) * std::pow(1 - cosine, 5);
}

// The paper's Fourier transforms of the CIE's colour matching functions as sums of Gaussians, for a path
// difference in metres, shifted by a phase. As linear sRGB; the whole spectrum has luminance 1.
Vec3 sensitivity(double path, double shift) {
  const double phase = 2 * M_PI * path;
  const auto gaussian = [&](double value, double position, double variance) {
    return value * std::sqrt(2 * M_PI * variance) * std::cos(position * phase + shift) *
           std::exp(-variance * phase * phase) / 1.0685e-7;
  };
  const double x = gaussian(5.4856e-13, 1.6810e6, 4.3278e9) + gaussian(9.7470e-14, 2.2399e6, 4.5282e9);
  const double y = gaussian(4.4201e-13, 1.7953e6, 9.3046e9);
  const double z = gaussian(5.2481e-13, 2.2084e6, 6.6121e9);
  return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
          0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

}  // namespace

Vec3 Film::reflectance(double cosine, const Vec3& f0) const {
  const double inside = std::sqrt(1 - (1 - cosine * cosine) / (ior * ior));
  const double path = 2 * ior * thickness * 1e-9 * inside;
  const double upper = schlick_at(perpendicular(1, ior), cosine);
  Vec3 reflected;
  for (int c = 0; c < 3; ++c) {
    const double amplitude = std::sqrt(std::clamp(f0[c], 0.0, 0.9999));
    const double below = (1 + amplitude) / (1 - amplitude);
    const double lower = schlick_at(perpendicular(ior, below), inside);
    const double both = std::clamp(upper * lower, 1e-5, 0.9999);
    const double all = (1 - upper) * (1 - upper) * lower / (1 - both);
    // Light that turns back at a greater index loses half a wave: here at the film's upper side, from within.
    const double shift = M_PI + (below < ior ? M_PI : 0);
    double sum = upper + all, weight = all - (1 - upper);
    for (int order = 1; order <= 2; ++order) {
      weight *= std::sqrt(both);
      sum += 2 * weight * sensitivity(order * path, order * shift)[c];
    }
    reflected[c] = std::clamp(sum, 0.0, 1.0);
  }
  return reflected;
}

Vec3 Film::over(const Fresnel& bare, double cosine) const {
  if (share == 0) return bare.at(cosine);
  return glm::mix(bare.at(cosine), reflectance(cosine, bare.f0), share);
}

Fresnel Film::seen(const Fresnel& bare, double cosine) const {
  const double edge = std::min(std::pow(1 - cosine, 5), 0.99);
  Fresnel seen = bare;
  const Vec3 mirrored = over(bare, cosine);
  for (int c = 0; c < 3; ++c) {
    const double rest = mirrored[c] - edge * bare.f90[c];
    seen.f0[c] = std::max(0.0, rest / (1 - edge));
    if (rest <= 0) seen.f90[c] = mirrored[c] / edge;
  }
  // Gauss's four points in the square of the cosine.
  const double outer = std::sqrt(525 + 70 * std::sqrt(30.0)) / 35,
               inner = std::sqrt(525 - 70 * std::sqrt(30.0)) / 35;
  const double light = (18 - std::sqrt(30.0)) / 72, heavy = (18 + std::sqrt(30.0)) / 72;
  seen.mean = Vec3(0);
  for (const double side : {-1.0, 1.0})
    seen.mean += light * over(bare, std::sqrt((1 + side * outer) / 2)) +
                 heavy * over(bare, std::sqrt((1 + side * inner) / 2));
  return seen;
}

}  // namespace eyeray::engine::optics
