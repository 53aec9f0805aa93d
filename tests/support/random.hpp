// Reproducible random numbers for property tests: each seed has a separate stream, so that parallel parts do
// not depend on each other.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>

#include "host/core/vec.hpp"

namespace eyeray::engine::test {

class Random {
 public:
  // Neighbouring seeds start far apart on the generator's one cycle.
  explicit Random(uint64_t seed) : state_(hash(hash(seed) + 0x1234567u)) {}

  // SplitMix64 (Steele, Lea, Flood 2014).
  uint64_t bits() { return hash(state_ += 0x9e3779b97f4a7c15u); }
  // Uniform in [low, high).
  double uniform(double low = 0, double high = 1) {
    return low + (high - low) * double(bits() >> 11) * 0x1p-53;
  }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int below(int n) { return int(bits() % uint64_t(n)); }
  // Uniform on the unit sphere.
  Vec3 direction() {
    const double z = uniform(-1, 1);
    const double phi = uniform(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  Vec3 point(double reach) {
    return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)};
  }

 private:
  static uint64_t hash(uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  uint64_t state_;
};

// The seed of the tests whose random numbers EYERAY_SEED may change; 0 if it is not set.
inline uint64_t seed() {
  const char* set = std::getenv("EYERAY_SEED");
  return set ? std::strtoull(set, nullptr, 10) : 0;
}

}  // namespace eyeray::engine::test
