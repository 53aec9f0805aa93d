// Tests of the histogram of samples' brightness, for any values that a shader may return.
#include "host/render/brightness.hpp"

#include <cmath>
#include <limits>
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using render::Brightness;

TEST_CASE("samples are counted by brightness; NaN and negative values do not count as bright") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   infinity = std::numeric_limits<double>::infinity();
  std::vector<PixelSample> samples(7);
  const double values[] = {0, 1, 100, -1, nan, std::copysign(nan, -1.0), infinity};
  for (size_t i = 0; i < samples.size(); ++i) samples[i].color = Vec3(values[i]);
  Brightness brightness;
  brightness.add(samples);
  CHECK(brightness.above(0.5) == 3);
  CHECK(brightness.above(10) == 2);
  CHECK(brightness.above(0) == 0);
  uint64_t all = 0;
  for (const uint64_t count : brightness.counts()) all += count;
  CHECK(all == samples.size());
}
