// Tests the properties of the sky's light that are known without rendering a picture.
#include <cmath>

#include "host/lights/sky.hpp"
#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::lights;

namespace {

Sky sky_at(double degrees, const SkySettings& settings = {}) {
  SkySettings all = settings;
  all.to_sun = {0, std::sin(glm::radians(degrees)), -std::cos(glm::radians(degrees))};
  return make_sky(all);
}

// The texel at these angles from the zenith and from the sun's azimuth, in degrees.
Vec3 at(const Sky& sky, double polar, double azimuth) {
  const int x = int((0.5 + azimuth / 360) * sky.map->width()), y = int(polar / 180 * sky.map->height());
  return sky.map->texel(std::min(x, sky.map->width() - 1), y);
}

// The irradiance of a level surface from the sky alone; it corresponds to π times a light's intensity.
Vec3 irradiance(const Sky& sky) {
  Vec3 sum(0);
  const int width = sky.map->width(), height = sky.map->height();
  for (int y = 0; y < height / 2; ++y) {
    const double polar = M_PI * (y + 0.5) / height;
    for (int x = 0; x < width; ++x)
      sum +=
          sky.map->texel(x, y) * (std::sin(polar) * std::cos(polar) * (M_PI / height) * (2 * M_PI / width));
  }
  return sum;
}

}  // namespace

TEST_CASE("the sun's light is dimmed by the air above it") {
  const Vec3 depth = Vec3(0.005802, 0.013558, 0.033100) * 8.0 * std::exp(-0.2 / 8) +
                     0.004440 * 1.2 * std::exp(-0.2 / 1.2) + Vec3(0.000650, 0.001881, 0.000085) * 15.0;
  const auto sun = sky_at(90).sun;
  REQUIRE(sun);
  CHECK(test::near(sun->intensity, glm::exp(-depth), 2e-3));
  CHECK(sun->angle == doctest::Approx(glm::radians(0.533)));
  CHECK(sky_at(90, {.scale = Vec3(2)}).sun->intensity.x == doctest::Approx(2 * sun->intensity.x));
  CHECK_FALSE(sky_at(-1).sun);
}

TEST_CASE("the sky is finite, the same on both sides of the sun, blue above and pale at the horizon") {
  for (const double degrees : {60.0, 20.0, 2.0, -5.0}) {
    CAPTURE(degrees);
    const Sky sky = sky_at(degrees);
    int wrong = 0;
    for (int y = 0; y < sky.map->height(); ++y)
      for (int x = 0; x < sky.map->width(); ++x) {
        const Vec3 color = sky.map->texel(x, y);
        for (int c = 0; c < 3; ++c) wrong += !(color[c] >= 0 && color[c] < 100);
        wrong += color != sky.map->texel(sky.map->width() - 1 - x, y);
      }
    CHECK(wrong == 0);
  }
  const Sky noon = sky_at(60), evening = sky_at(2);
  const Vec3 zenith = at(noon, 2, 180), horizon = at(noon, 88, 180);
  CHECK(zenith.z > 1.5 * zenith.y);
  CHECK(zenith.y > 1.2 * zenith.x);
  CHECK(horizon.y > zenith.y);
  CHECK(horizon.z / horizon.x < zenith.z / zenith.x);
  // The sky is red around the setting sun, and darker away from it.
  CHECK(at(evening, 88, 1).x > 1.5 * at(evening, 88, 1).z);
  CHECK(at(evening, 88, 1).x > 3 * at(evening, 88, 180).x);
}

TEST_CASE("a sky scatters down a share of the sun's light, less than the air removes") {
  for (const double degrees : {80.0, 45.0, 15.0}) {
    CAPTURE(degrees);
    const Sky sky = sky_at(degrees);
    const double sine = std::sin(glm::radians(degrees));
    const Vec3 diffuse = irradiance(sky) / M_PI, direct = sky.sun->intensity * sine;
    for (int c = 0; c < 3; ++c) {
      CHECK(diffuse[c] > 0.03 * sine);
      // Part of the light that the ground reflects comes down again.
      CHECK(diffuse[c] + direct[c] < 1.1 * sine);
    }
    CHECK(diffuse.z > diffuse.x);
    const Sky white = sky_at(degrees, {.ground = Vec3(0.9)});
    CHECK(irradiance(white).z > irradiance(sky).z);
    CHECK(at(white, 150, 90).y > 2 * at(sky, 150, 90).y);
  }
}

TEST_CASE("a sky is rotated to its sun") {
  const Sky sky = make_sky({.to_sun = glm::normalize(Vec3(1, 1, 0))});
  // The map's middle shows the sun: towards +x, a quarter turn to the right of −z.
  CHECK(sky.map->turn() == doctest::Approx(0.75));
  CHECK(sky.sun->to_light.x > 0.7);
}
