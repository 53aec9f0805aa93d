#include "host/core/halves.hpp"

#include <bit>

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

TEST_CASE("halves are counted, equal at powers of two, and never more than two to one") {
  uint64_t first = 0;
  for (uint64_t samples = 1; samples <= 5000; ++samples) {
    CAPTURE(samples);
    first += in_first_half(samples - 1);
    REQUIRE(first_half_of(samples) == first);
    if (samples < 2) continue;
    REQUIRE(3 * first >= samples);
    REQUIRE(3 * first <= 2 * samples);
    if (std::has_single_bit(samples)) REQUIRE(2 * first == samples);
  }
}

TEST_CASE("of each power of two of samples, each half has a quarter in one aligned stretch") {
  for (uint64_t power = 4; power <= 4096; power *= 2) {
    CAPTURE(power);
    for (uint64_t sample = power / 2; sample < power; ++sample)
      REQUIRE((in_first_half(sample) == in_first_half(power / 2)) == (sample < power / 4 * 3));
  }
}
