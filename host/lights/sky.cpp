#include "host/lights/sky.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "host/core/parallel_for.hpp"

namespace eyeray::engine::lights {

namespace {

// Lengths in km, and coefficients per km.
constexpr double ground_radius = 6360, top_radius = 6460, eye_height = 0.2;
constexpr Vec3 rayleigh(0.005802, 0.013558, 0.033100), ozone(0.000650, 0.001881, 0.000085);
constexpr double mie_scattering = 0.003996, mie_extinction = 0.004440, mie_forward = 0.8;
constexpr double sun_angle = 0.533;  // degrees

constexpr int width = 512, height = 256;  // width of the map

struct Medium {
  Vec3 rayleigh_scattering;
  double mie_scattering;
  Vec3 extinction;

  Vec3 scattering() const { return rayleigh_scattering + mie_scattering; }
};

Medium medium_at(double radius) {
  const double h = std::max(radius - ground_radius, 0.0);
  const double air = std::exp(-h / 8), dust = std::exp(-h / 1.2),
               layer = std::max(0.0, 1 - std::abs(h - 25) / 15);
  return {air * rayleigh, dust * mie_scattering, air * rayleigh + dust * mie_extinction + layer * ozone};
}

// Distances along a ray from `radius` whose direction has that cosine with up: from within the top sphere to
// it, and to the near side of the ground. The latter is below 0 if the ray misses the ground.
double to_top(double radius, double cosine) {
  return -radius * cosine +
         std::sqrt(std::max(0.0, radius * radius * (cosine * cosine - 1) + top_radius * top_radius));
}
double to_ground(double radius, double cosine) {
  const double root = radius * radius * (cosine * cosine - 1) + ground_radius * ground_radius;
  return root < 0 || cosine >= 0 ? -1 : -radius * cosine - std::sqrt(root);
}

// A function of two numbers in [0, 1], tabulated at even steps and interpolated bilinearly.
class Table {
 public:
  template <typename Function>
  Table(int columns, int rows, const Function& function)
      : columns_(columns), rows_(rows), values_(size_t(columns * rows)) {
    parallel_for(0, rows, [&](int y) {
      for (int x = 0; x < columns; ++x)
        values_[size_t(y * columns + x)] = function(x / double(columns - 1), y / double(rows - 1));
    });
  }
  Vec3 operator()(double u, double v) const {
    const double x = std::clamp(u, 0.0, 1.0) * (columns_ - 1), y = std::clamp(v, 0.0, 1.0) * (rows_ - 1);
    const int left = std::min(int(x), columns_ - 2), upper = std::min(int(y), rows_ - 2);
    const auto value = [&](int column, int row) { return values_[size_t(row * columns_ + column)]; };
    return glm::mix(glm::mix(value(left, upper), value(left + 1, upper), x - left),
                    glm::mix(value(left, upper + 1), value(left + 1, upper + 1), x - left), y - upper);
  }

 private:
  int columns_, rows_;
  std::vector<Vec3> values_;
};

// The share of light that the atmosphere leaves between its rim and a radius, for rays that miss the ground.
// Indexed by Bruneton's coordinates: the ray's length among all possible ones, and the distance to the
// horizon.
class Transmittance {
 public:
  Vec3 operator()(double radius, double cosine) const {
    const double horizon = std::sqrt(std::max(0.0, radius * radius - ground_radius * ground_radius));
    const double least = top_radius - radius, most = horizon + span;
    return table_((to_top(radius, cosine) - least) / (most - least), horizon / span);
  }

 private:
  static inline const double span = std::sqrt(top_radius * top_radius - ground_radius * ground_radius);

  static Vec3 value(double u, double v) {
    const double horizon = v * span, radius = std::sqrt(horizon * horizon + ground_radius * ground_radius);
    const double least = top_radius - radius, length = least + u * (horizon + span - least);
    const double cosine =
        length == 0 ? 1
                    : std::clamp((span * span - horizon * horizon - length * length) / (2 * radius * length),
                                 -1.0, 1.0);
    Vec3 depth(0);
    constexpr int steps = 100;
    for (int i = 0; i < steps; ++i) {
      const double t = length * (i + 0.5) / steps;
      depth += medium_at(std::sqrt(radius * radius + t * t + 2 * radius * t * cosine)).extinction *
               (length / steps);
    }
    return glm::exp(-depth);
  }

  Table table_{256, 64, value};
};

class Atmosphere {
 public:
  explicit Atmosphere(const Vec3& ground) : ground_(ground) {}

  // The share of the sun's light that arrives at a radius, if the direction to the sun has that cosine with
  // up.
  Vec3 sunlight(double radius, double cosine) const {
    return to_ground(radius, cosine) >= 0 ? Vec3(0) : transmittance_(radius, cosine);
  }

  // The light gathered by a ray from `radius`: `source(medium, radius, sun's cosine, sunlight)` per length,
  // and the ground's light. `d`, `to_sun`: unit, y up. The `steps` grow longer with the distance.
  template <typename Source>
  Vec3 gather(double radius, const Vec3& d, const Vec3& to_sun, int steps, bool with_ground,
              const Source& source) const {
    const double ground = to_ground(radius, d.y), end = ground >= 0 ? ground : to_top(radius, d.y);
    Vec3 light(0), left(1);
    const auto point = [&](double t) { return Vec3(0, radius, 0) + t * d; };
    for (int i = 0; i < steps; ++i) {
      const double from = end * i * i / (steps * steps), to = end * (i + 1) * (i + 1) / (steps * steps);
      const Vec3 p = point((from + to) / 2);
      const double r = glm::length(p), cosine = glm::dot(p, to_sun) / r;
      const Medium medium = medium_at(r);
      const Vec3 passed = glm::exp(-medium.extinction * (to - from));
      light += left * source(medium, r, cosine, sunlight(r, cosine)) * (1.0 - passed) / medium.extinction;
      left *= passed;
    }
    if (with_ground && ground >= 0) {
      const Vec3 p = point(ground);
      const double cosine = glm::dot(p, to_sun) / glm::length(p);
      const Vec3 arriving =
          std::max(0.0, cosine) * sunlight(ground_radius, cosine) + M_PI * scattered(ground_radius, cosine);
      light += left * ground_ / M_PI * arriving;
    }
    return light;
  }

  // Light that was scattered twice or more, for a sun of irradiance 1. It is the same from all directions.
  Vec3 scattered(double radius, double cosine) const {
    return multiple_
               ? (*multiple_)(0.5 + 0.5 * cosine, (radius - ground_radius) / (top_radius - ground_radius))
               : Vec3(0);
  }

  void add_multiple_scattering() {
    multiple_.emplace(32, 32, [this](double u, double v) {
      const double cosine = std::clamp(2 * u - 1, -1.0, 1.0);
      const double radius = ground_radius + std::clamp(v, 1e-5, 1 - 1e-5) * (top_radius - ground_radius);
      const Vec3 to_sun(std::sqrt(1 - cosine * cosine), cosine, 0);
      constexpr int across = 8, around = 8;
      Vec3 second(0), share(0);
      for (int i = 0; i < across; ++i)
        for (int k = 0; k < around; ++k) {
          const double y = 2 * (i + 0.5) / across - 1, turn = 2 * M_PI * (k + 0.5) / around;
          const Vec3 d(std::sqrt(1 - y * y) * std::cos(turn), y, std::sqrt(1 - y * y) * std::sin(turn));
          second +=
              gather(radius, d, to_sun, 20, true, [](const Medium& medium, double, double, const Vec3& sun) {
                return medium.scattering() * sun / (4 * M_PI);
              });
          share +=
              gather(radius, d, to_sun, 20, false,
                     [](const Medium& medium, double, double, const Vec3&) { return medium.scattering(); });
        }
      return second / (across * around * 1.0) / (1.0 - share / (across * around * 1.0));
    });
  }

  // The radiance seen in direction `d` from a little above the ground, for a sun of irradiance 1.
  Vec3 radiance(const Vec3& d, const Vec3& to_sun) const {
    const double cosine = glm::dot(d, to_sun), g = mie_forward;
    const double air = 3 / (16 * M_PI) * (1 + cosine * cosine);
    // The phase function of Cornette and Shanks.
    const double dust = 3 / (8 * M_PI) * (1 - g * g) * (1 + cosine * cosine) /
                        ((2 + g * g) * std::pow(1 + g * g - 2 * g * cosine, 1.5));
    return gather(ground_radius + eye_height, d, to_sun, 40, true,
                  [&](const Medium& medium, double radius, double sun_cosine, const Vec3& sun) {
                    return sun * (medium.rayleigh_scattering * air + medium.mie_scattering * dust) +
                           medium.scattering() * scattered(radius, sun_cosine);
                  });
  }

 private:
  Vec3 ground_;
  Transmittance transmittance_;
  std::optional<Table> multiple_;
};

}  // namespace

Sky make_sky(const SkySettings& settings) {
  Atmosphere atmosphere(settings.ground);
  atmosphere.add_multiple_scattering();

  // The sun stands over the middle of the map, so the map's left and right halves mirror each other. The map
  // is then turned towards the sun.
  const double up = settings.to_sun.y;
  const Vec3 to_sun(0, up, -std::sqrt(std::max(0.0, 1 - up * up)));
  image::Image map(width, height, 3);
  parallel_for(0, height, [&](int y) {
    const double polar = M_PI * (y + 0.5) / height;
    for (int x = 0; x < width / 2; ++x) {
      const double azimuth = 2 * M_PI * (x + 0.5) / width;
      const Vec3 d(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth));
      const Vec3 light = M_PI * settings.scale * atmosphere.radiance(d, to_sun);
      for (int c = 0; c < 3; ++c) map.pixel(x, y)[c] = map.pixel(width - 1 - x, y)[c] = float(light[c]);
    }
  });
  Sky sky;
  sky.map = std::make_shared<EnvironmentMap>(std::move(map),
                                             -std::atan2(settings.to_sun.x, -settings.to_sun.z) / (2 * M_PI));
  const Vec3 arriving = settings.scale * atmosphere.sunlight(ground_radius + eye_height, up);
  if (arriving != Vec3(0)) sky.sun = DirectionalLight{settings.to_sun, arriving, glm::radians(sun_angle)};
  return sky;
}

}  // namespace eyeray::engine::lights
