#include "host/rounding/positions.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::rounding {

namespace {

constexpr int rings = 4;
constexpr double radius_step = 0.001;  // pixels
// The radii of rings between the innermost ring and the four grow by this factor.
constexpr double radius_growth = 3;
// A rounding error grows from surface to surface. So the radii grow with the number of surfaces that a path
// hits, by at most this factor.
constexpr double most_reach = 8;

}  // namespace

Positions positions_around(double rounding, double surfaces, int angles, bool between) {
  Positions positions;
  const auto add_ring = [&](double radius, int count, double turn) {
    for (int step = 0; step < count; ++step) {
      const double angle = 2 * M_PI * (step + turn) / count;
      positions.all.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
    }
  };
  const double reach = std::min(most_reach, 1 + surfaces / 8);

  // Features narrower than the distance between two of the four rings show on the smaller rings: a caustic's
  // rim may be a hundred-thousandth of a pixel wide.
  if (const double least = std::min(rounding, radius_step); least > 0) {
    add_ring(least, angles, 0.25);
    positions.innermost = positions.all.size();
    if (between)
      for (double radius = radius_growth * least; radius < radius_step; radius *= radius_growth)
        add_ring(radius * reach, angles / 2, 0.25);
  }
  // Each ring is turned a little, so that no direction is tried twice.
  for (int ring = 1; ring <= rings; ++ring)
    add_ring(ring * radius_step * reach, angles, (ring - 1.0) / rings);
  return positions;
}

}  // namespace eyeray::engine::rounding
