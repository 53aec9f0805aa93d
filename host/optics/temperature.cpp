#include "host/optics/temperature.hpp"

namespace eyeray::engine::optics {
namespace {

glm::dmat3 of_rows(const Vec3& a, const Vec3& b, const Vec3& c) {
  return glm::transpose(glm::dmat3(a, b, c));
}

// IEC 61966-2-1: sRGB's primaries and white.
const glm::dmat3 rgb_to_xyz = of_rows({0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750},
                                      {0.0193339, 0.1191920, 0.9503041});
const glm::dmat3 xyz_to_cones =
    of_rows({0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296});

double cubic(double x, double c3, double c2, double c1, double c0) {
  return ((c3 * x + c2) * x + c1) * x + c0;
}

}  // namespace

Vec3 black_body_xyz(double kelvin) {
  const double t = 1000 / kelvin;
  const double x = kelvin < 4000 ? cubic(t, -0.2661239, -0.2343589, 0.8776956, 0.179910)
                                 : cubic(t, -3.0258469, 2.1070379, 0.2226347, 0.240390);
  const double y = kelvin < 2222   ? cubic(x, -1.1063814, -1.34811020, 2.18555832, -0.20219683)
                   : kelvin < 4000 ? cubic(x, -0.9549476, -1.37418593, 2.09137015, -0.16748867)
                                   : cubic(x, 3.0817580, -5.87338670, 3.75112997, -0.37001483);
  return {x / y, 1, (1 - x - y) / y};
}

Vec3 shown_black_body(double kelvin) {
  const Vec3 color = glm::max(glm::inverse(rgb_to_xyz) * black_body_xyz(kelvin), 0.0);
  return color / (rgb_to_xyz * color).y;
}

glm::dmat3 adaptation_to(double kelvin) {
  const Vec3 shown = xyz_to_cones * rgb_to_xyz * Vec3(1.0), white = xyz_to_cones * black_body_xyz(kelvin);
  glm::dmat3 scaled = xyz_to_cones * rgb_to_xyz;
  for (int i = 0; i < 3; ++i) scaled[i] *= shown / white;
  return glm::inverse(xyz_to_cones * rgb_to_xyz) * scaled;
}

}  // namespace eyeray::engine::optics
