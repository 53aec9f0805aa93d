// Lights stated in lumens, candela, lux and nits emit that much, by integrals of the light that arrives.
#include <fmt/format.h>

#include <cmath>

#include "host/loader/scene_file.hpp"
#include "host/scene/luminance.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

namespace {

// The flux through a sphere of radius 2 around a light at [1, 2, 3], by the midpoint rule. The illuminance is
// π times the result of illuminate().
double flux(const std::string& light) {
  const Scene scene = parse_scene("[[light]]\nposition = [1, 2, 3]\n" + light, "light.toml");
  const Vec3 center(1, 2, 3);
  constexpr int rows = 2000, columns = 8;
  double sum = 0;
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < columns; ++k) {
      const double z = 2 * (i + 0.5) / rows - 1, turn = 2 * M_PI * (k + 0.5) / columns;
      const double r = std::sqrt(1 - z * z);
      const Vec3 arriving =
          scene.lights[0]->illuminate(center + 2.0 * Vec3(r * std::cos(turn), z, r * std::sin(turn))).color;
      sum += M_PI * (0.2126 * arriving.r + 0.7152 * arriving.g + 0.0722 * arriving.b);
    }
  }
  return sum * 4 * M_PI * 4 / (rows * columns);
}

double luminance_of_emission(const std::string& light) {
  const Scene scene = parse_scene("[[light]]\ntype = 'area'\n" + light, "light.toml");
  return luminance(scene.materials[size_t(scene.shapes[0]->material)]->constant_emission().value());
}

}  // namespace

TEST_CASE("points and spots emit their lumens, whatever their colour") {
  CHECK(flux("type = 'point'\nlumens = 800") == doctest::Approx(800).epsilon(1e-3));
  CHECK(flux("type = 'point'\nlumens = 800\nkelvin = 2700") == doctest::Approx(800).epsilon(1e-3));
  CHECK(flux("type = 'point'\nlumens = 800\nintensity = [1, 0.2, 0]\nkelvin = 1800") ==
        doctest::Approx(800).epsilon(1e-3));
  CHECK(flux("type = 'point'\ncandela = 10") == doctest::Approx(40 * M_PI).epsilon(1e-3));
  const std::string spot = "type = 'spot'\ndirection = [0, 1, 0]\n";
  for (const char* angles : {"outer_angle = 30\n", "inner_angle = 20\nouter_angle = 50\n",
                             "inner_angle = 80\nouter_angle = 90\n"}) {
    CAPTURE(angles);
    CHECK(flux(spot + angles + "lumens = 500") == doctest::Approx(500).epsilon(3e-3));
  }
}

TEST_CASE("a sun's lux is the illuminance of a surface that faces it") {
  const Scene scene =
      parse_scene("[[light]]\ntype = 'directional'\ndirection = [0, -1, 0]\nlux = 100000", "sun.toml");
  CHECK(M_PI * scene.lights[0]->illuminate({}).color.g == doctest::Approx(100000));
}

TEST_CASE("area lights have their nits, and their lumens over π times their area") {
  CHECK(
      luminance_of_emission("shape = 'sphere'\ncenter = [0, 0, 0]\nradius = 2\nnits = 300\nkelvin = 3000") ==
      doctest::Approx(300));
  CHECK(luminance_of_emission("shape = 'sphere'\ncenter = [0, 0, 0]\nradius = 2\nlumens = 800") ==
        doctest::Approx(800 / (M_PI * 16 * M_PI)));
  CHECK(luminance_of_emission("shape = 'sphere'\ncenter = [0, 0, 0]\nradius = 2\nlumens = 800\n"
                              "emission_side = 'both'") == doctest::Approx(800 / (M_PI * 16 * M_PI)));
  const std::string rectangle =
      "shape = 'rectangle'\norigin = [0, 0, 0]\nedge_u = [2, 0, 0]\nedge_v = [1, 3, 0]\nlumens = 600\n";
  CHECK(luminance_of_emission(rectangle) == doctest::Approx(600 / (M_PI * 6)));
  CHECK(luminance_of_emission(rectangle + "transform = [{ scale = [1, 2, 1] }]") ==
        doctest::Approx(600 / (M_PI * 12)));
  CHECK(luminance_of_emission(rectangle + "emission_side = 'both'") == doctest::Approx(600 / (M_PI * 12)));
  CHECK(luminance_of_emission("shape = 'disk'\ncenter = [0, 0, 0]\nnormal = [1, 1, 0]\nradius = 3\n"
                              "inner_radius = 1\nlumens = 600") == doctest::Approx(600 / (M_PI * 8 * M_PI)));
  CHECK(luminance_of_emission(
            "shape = 'triangle'\nvertices = [[0, 0, 0], [4, 0, 0], [0, 3, 0]]\nlumens = 600") ==
        doctest::Approx(600 / (M_PI * 6)));
}
