#include "host/optics/fresnel.hpp"

#include <cmath>
#include <complex>

namespace eyeray::engine::optics {

namespace {

// Computed with complex numbers, as in Born and Wolf (fresnel.hpp).
double conductor_reflectance(double n, double k, double cosine) {
  const std::complex<double> index(n, k);
  const std::complex<double> beyond = std::sqrt(1.0 - (1 - cosine * cosine) / (index * index));
  const double crossed = std::norm((cosine - index * beyond) / (cosine + index * beyond));
  const double parallel = std::norm((index * cosine - beyond) / (index * cosine + beyond));
  return (crossed + parallel) / 2;
}

}  // namespace

Vec3 Fresnel::at(double cosine) const {
  if (!conductor) return glm::mix(f0, f90, std::pow(1 - cosine, 5));
  Vec3 share;
  for (int i = 0; i < 3; ++i) share[i] = conductor_reflectance(f0[i], f90[i], cosine);
  return share;
}

Fresnel schlick(const Vec3& f0, const Vec3& f90) {
  return {f0, f90, f0 + (f90 - f0) / 21.0, false};
}

Fresnel conductor(const Vec3& n, const Vec3& k) {
  Fresnel fresnel{n, k, Vec3(0), true};
  constexpr int steps = 256;  // midpoints: an error below 1e-6
  for (int i = 0; i < steps; ++i) {
    const double cosine = (i + 0.5) / steps;
    fresnel.mean += 2 * cosine / steps * fresnel.at(cosine);
  }
  return fresnel;
}

double dielectric_reflectance(double cosine, double n1, double n2) {
  if (n1 == n2) return 0;
  const double eta = n1 / n2;
  const double sin2_squared = eta * eta * (1 - cosine * cosine);
  if (sin2_squared >= 1) return 1;
  const double cos2 = std::sqrt(1 - sin2_squared);
  const double rs = (n1 * cosine - n2 * cos2) / (n1 * cosine + n2 * cos2);
  const double rp = (n1 * cos2 - n2 * cosine) / (n1 * cos2 + n2 * cosine);
  return (rs * rs + rp * rp) / 2;
}

}  // namespace eyeray::engine::optics
