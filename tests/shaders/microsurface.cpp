// Compares very rough glass and metal with random walks on the microsurface: Heitz, Hanika, d'Eon and
// Dachsbacher, "Multiple-Scattering Microfacet BSDFs with the Smith Model" (SIGGRAPH 2016).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bsdf_examples.hpp"
#include "host/reference/bsdf.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A GGX microsurface whose heights are uniform in [−1, 1], between air above it and a medium of `ior` below;
// a mirror if `ior` is 0.
class Microsurface {
 public:
  Microsurface(double roughness, double ior) : width_(roughness * roughness), ior_(ior) {}

  // Light comes from direction o, o.z > 0. Returns the direction in which it leaves.
  Vec3 walk(const Vec3& o, Random& random) const {
    Vec3 d = -o;
    double height = 1;
    bool outside = true;
    for (;;) {
      height = outside ? next_height(d, height, random) : -next_height(-d, -height, random);
      if (std::abs(height) == infinity) return d;
      const Vec3 back = -d;
      const Vec3 n = outside ? visible_normal(back, random) : -visible_normal(-back, random);
      const double cosine = std::min(glm::dot(back, n), 1.0);
      const double eta = outside ? 1 / ior_ : ior_;
      if (ior_ == 0 || random.uniform() < reflectance(cosine, eta)) {
        d = glm::normalize(2 * cosine * n - back);
      } else {
        d = glm::normalize((eta * cosine - std::sqrt(1 - eta * eta * (1 - cosine * cosine))) * n -
                           eta * back);
        outside = !outside;
      }
    }
  }

 private:
  // Smith's Λ of directions up and down.
  double lambda(const Vec3& d) const {
    const double slope = width_ * width_ * (1 / (d.z * d.z) - 1);
    return (std::copysign(std::sqrt(1 + slope), d.z) - 1) / 2;
  }
  // The height at which a ray from `height` next hits the microsurface; infinite if it leaves upwards.
  double next_height(const Vec3& d, double height, Random& random) const {
    const double u = random.uniform();
    const double below = std::min((height + 1) / 2, 1.0);
    if (d.z > 0.9999) return infinity;
    if (d.z < -0.9999) return 2 * u * below - 1;
    if (std::abs(d.z) < 1e-4) return height;
    const double exponent = lambda(d);
    if (d.z > 0 && u > 1 - std::pow(below, exponent)) return infinity;
    return 2 * below / std::pow(1 - u, 1 / exponent) - 1;
  }
  // Samples a visible normal by spherical caps (Dupuy and Benyoub, HPG 2023), which hold for o below the
  // horizon too.
  Vec3 visible_normal(const Vec3& o, Random& random) const {
    const Vec3 v = glm::normalize(Vec3(width_ * o.x, width_ * o.y, o.z));
    const double turn = 2 * M_PI * random.uniform();
    const double z = (1 - random.uniform()) * (1 + v.z) - v.z;
    const double radius = std::sqrt(std::max(0.0, 1 - z * z));
    const Vec3 h = Vec3(radius * std::cos(turn), radius * std::sin(turn), z) + v;
    return glm::normalize(Vec3(width_ * h.x, width_ * h.y, h.z));
  }
  // Fresnel's reflectance; refraction multiplies the sine by eta.
  static double reflectance(double cosine, double eta) {
    const double squared = 1 - eta * eta * (1 - cosine * cosine);
    if (squared <= 0) return 1;
    const double through = std::sqrt(squared);
    const double s = (eta * cosine - through) / (eta * cosine + through);
    const double p = (cosine - eta * through) / (cosine + eta * through);
    return (s * s + p * p) / 2;
  }

  double width_, ior_;
};

int walks() {
  return amount(1 << 18, 1 << 18, 1 << 22);
}

// The share of light from everywhere that is mirrored towards o: by random walks, and by the BSDF.
struct Mirrored {
  double walked, found;
};
Mirrored mirrored(double roughness, double cosine) {
  const Vec3 o = towards(cosine);
  const Microsurface surface(roughness, 1.5);
  const Bsdf bsdf = glass(roughness, 1, 1.5);
  const reference::ViewedBsdf viewed(bsdf, o);
  Random random(3);
  Mirrored sums{};
  for (int i = 0; i < walks(); ++i) {
    sums.walked += surface.walk(o, random).z > 0;
    const double uc = random.uniform(), u = random.uniform(), v = random.uniform();
    const Vec3 to = viewed.sample(uc, {u, v}).i;
    if (!(to.z > 0)) continue;
    const reference::BsdfValue value = viewed.at(to, true);
    if (value.density > 0) sums.found += value.value.x / value.density;
  }
  return {sums.walked / walks(), sums.found / walks()};
}

// Cells of equal projected solid angle: 4 by the angle from the normal, times 4 by the angle from the plane
// of o.
using Cells = std::array<double, 16>;
size_t cell_of(const Vec3& o, const Vec3& d) {
  const double turn = std::abs(std::atan2(o.x * d.y - o.y * d.x, o.x * d.x + o.y * d.y)) / M_PI;
  return size_t(std::min(3.0, 4 * d.z * d.z)) * 4 + size_t(std::min(3.0, 4 * turn));
}

// The share of light that a white metal's BSDF scatters into other cells than random walks do.
double sent_elsewhere(double roughness, double cosine) {
  const Vec3 o = towards(cosine);
  const Microsurface surface(roughness, 0);
  const Bsdf bsdf = conductor(perfect(), roughness);
  const reference::ViewedBsdf viewed(bsdf, o);
  Random random(5);
  Cells difference{};
  for (int i = 0; i < walks(); ++i) {
    difference[cell_of(o, surface.walk(o, random))] += 1.0 / walks();
    const double uc = random.uniform(), u = random.uniform(), v = random.uniform();
    const Vec3 to = viewed.sample(uc, {u, v}).i;
    if (!(to.z > 0)) continue;
    const reference::BsdfValue value = viewed.at(to, true);
    if (value.density > 0) difference[cell_of(o, to)] -= value.value.x / value.density / walks();
  }
  double sum = 0;
  for (const double each : difference) sum += std::abs(each) / 2;
  return sum;
}

}  // namespace

// docs/rendering.md states these figures.
TEST_CASE("glass of high roughness differs from random walks on the microsurface as documented") {
  struct Expected {
    double roughness, degrees, more;
  };
  for (const Expected& at : {Expected{0.3, 70, -0.012}, {0.7, 70, 0.046}, {1, 70, 0.178}, {1, 0, -0.091}}) {
    CAPTURE(at.roughness);
    CAPTURE(at.degrees);
    const Mirrored share = mirrored(at.roughness, std::cos(at.degrees * M_PI / 180));
    MESSAGE("glass of roughness " << at.roughness << " at " << at.degrees << " degrees: " << share.found
                                  << " mirrored, by walks " << share.walked);
    CHECK(std::abs(share.found / share.walked - 1 - at.more) < 0.02);
  }
}

TEST_CASE("white metal of high roughness scatters light almost as random walks on the microsurface do") {
  for (const double roughness : {0.3, 0.7, 1.0})
    for (const double degrees : {20.0, 45.0, 70.0}) {
      const double share = sent_elsewhere(roughness, std::cos(degrees * M_PI / 180));
      MESSAGE("metal of roughness " << roughness << " at " << degrees << " degrees: " << share);
      CHECK(share < 0.03);
    }
}
