// Tests of the probability of each cell of an environment, which is in whole numbers that every executor
// shares.
#include <numeric>

#include "host/scene/whole_shares.hpp"
#include "tests/support/environments.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("whole shares use up all numbers, and each positive share gets at least one") {
  Random random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> shares(size_t(1 + random.below(3000)));
    for (double& share : shares) share = random.below(3) == 0 ? 0 : std::pow(10, random.uniform(-20, 20));
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    if (sum == 0) continue;
    std::vector<uint32_t> ends(shares.size());
    for (double& share : shares) share /= sum;
    whole_shares(shares, ends);
    CHECK(ends.back() == choice_numbers);
    int wrong = 0;
    for (size_t i = 0; i < shares.size(); ++i) {
      const uint32_t own = ends[i] - (i == 0 ? 0 : ends[i - 1]);
      wrong += (own > 0) != (shares[i] > 0) || std::abs(own * 0x1p-24 - shares[i]) > 3000 * 0x1p-24;
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("every cell with light at a corner can be chosen, and no other") {
  Random random(2);
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(1, 9), std::pair(9, 1), std::pair(40, 21)}) {
    const auto map = environment(width, height, [&](const Vec3&) {
      return random.below(4) > 0 ? Vec3(0) : Vec3(0, 0, std::pow(10, random.uniform(-30, 12)));
    });
    const EnvironmentCells& cells = map->cells();
    if (!cells.lit()) continue;
    int wrong = 0;
    for (int row = 0; row <= height; ++row) {
      uint32_t before = 0;
      const uint32_t above = row == 0 ? 0 : cells.row_ends[size_t(row) - 1];
      for (int column = 0; column < width; ++column) {
        bool lit = false;
        for (const int x : {column, (column + 1) % width})
          for (const int y : {std::max(row - 1, 0), std::min(row, height - 1)})
            lit = lit || map->texel(x, y) != Vec3(0);
        const uint32_t end = cells.column_ends[size_t(row * width + column)];
        const bool chosen = end > before && cells.row_ends[size_t(row)] > above;
        wrong += chosen != lit;
        before = end;
      }
    }
    CHECK(wrong == 0);
    CHECK(cells.row_ends.back() == choice_numbers);
  }
}

TEST_CASE("shares are proportional to light and solid angle") {
  const auto map = environment(8, 4, [](const Vec3&) { return Vec3(1); });
  const EnvironmentCells& cells = map->cells();
  for (int row = 0; row <= 4; ++row) {
    const double upper = M_PI * std::max(row - 0.5, 0.0) / 4, lower = M_PI * std::min(row + 0.5, 4.0) / 4;
    const uint32_t before = row == 0 ? 0 : cells.row_ends[size_t(row) - 1];
    CHECK((cells.row_ends[size_t(row)] - before) * 0x1p-24 ==
          doctest::Approx((std::cos(upper) - std::cos(lower)) / 2).epsilon(1e-5));
    CHECK(cells.column_ends[size_t(row) * 8 + 3] == choice_numbers / 2);
  }
}

TEST_CASE("a black environment is never chosen; others always, or by their share beside lights") {
  const auto black = environment(4, 2, [](const Vec3&) { return Vec3(0); });
  CHECK_FALSE(black->cells().lit());
  CHECK(environment_numbers(black.get(), false) == 0);
  CHECK(environment_numbers(nullptr, false) == 0);
  const auto gray = environment(4, 2, [](const Vec3&) { return Vec3(1e-30); });
  CHECK(environment_numbers(gray.get(), false) == choice_numbers);
  CHECK(environment_numbers(gray.get(), true) == choice_numbers / 2);
  gray->share = 1e-12;
  CHECK(environment_numbers(gray.get(), true) == 1);
  gray->share = 1 - 1e-12;
  CHECK(environment_numbers(gray.get(), true) == choice_numbers - 1);
}
