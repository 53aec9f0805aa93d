// Outliers among samples, in pictures whose distribution is known.
#include "host/film/outliers.hpp"

#include <algorithm>
#include <cmath>

#include "host/film/film.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::film;

namespace {

constexpr int side = 64;

struct Cleaned {
  Film film;
  Outliers outliers;
  double mean_before = 0, mean_after = 0;
};

double mean_of(const Film& film) {
  const Rows rows = film.rows(0, side);
  double sum = 0;
  for (const float each : rows.color.samples()) sum += double(each);
  return sum / double(rows.color.sample_count());
}

// A film of grey pixels, after its outliers were left out.
template <typename ValueAt>
Cleaned cleaned(const ValueAt& value_at, int samples) {
  Cleaned result;
  result.film.reset(side, side, parse_channels("half,variance,noise"), 1, true);
  for (int index = 0; index < samples; ++index) {
    std::vector<PixelSample> all(side * side);
    for (int i = 0; i < side * side; ++i) all[size_t(i)].color = Vec3(value_at(i % side, i / side, index));
    result.film.add({0, 0, side, side}, all);
  }
  result.mean_before = mean_of(result.film);
  result.outliers = result.film.leave_out_outliers();
  result.mean_after = mean_of(result.film);
  return result;
}

}  // namespace

TEST_CASE("usual noise loses hardly any light, and the lost light is stated") {
  for (const int samples : {4, 16, 100}) {
    CAPTURE(samples);
    test::Random random{test::seed() + 31};
    const auto exponential = [&](int, int, int) { return -std::log(1 - random.uniform()); };
    const Cleaned result = cleaned(exponential, samples);
    CHECK(result.mean_after > 0.997 * result.mean_before);
    CHECK(result.mean_before - result.mean_after ==
          doctest::Approx(result.outliers.luminance / (side * side)).epsilon(0.001).scale(1e-6));
  }
}

TEST_CASE("light that pixels find seldom but all around stays") {
  test::Random random{test::seed() + 32};
  const auto caustic = [&](int, int, int) { return random.uniform() < 1.0 / 16 ? 16.0 : 0.0; };
  const Cleaned result = cleaned(caustic, 16);
  CHECK(result.mean_after > 0.98 * result.mean_before);
}

TEST_CASE("a pixel that is bright in all samples stays") {
  const Cleaned result = cleaned([](int x, int y, int) { return x == 9 && y == 6 ? 500.0 : 1.0; }, 16);
  CHECK(result.outliers.pixels == 0);
  CHECK(result.film.rows(6, 1).color.pixel(9, 0)[0] == 500);
}

TEST_CASE("a rare bright sample is left out of colour, half, variance and noise, and of no other pixel") {
  test::Random random{test::seed() + 33};
  std::vector<double> usual(side * side * 32);
  for (double& each : usual) each = random.uniform(0.5, 1.5);
  for (const int firefly : {7, 5}) {  // in the first half, and in the second
    CAPTURE(firefly);
    const auto value = [&](bool sparkles) {
      return [&, sparkles](int x, int y, int index) {
        return sparkles && x == 21 && y == 40 && index == firefly
                   ? 5000.0
                   : usual[size_t((index * side + y) * side + x)];
      };
    };
    const Cleaned plain = cleaned(value(false), 32), result = cleaned(value(true), 32);
    CHECK(plain.outliers.pixels == 0);
    CHECK(result.outliers.pixels == 1);
    CHECK(result.outliers.luminance == doctest::Approx(5000.0 / 32).epsilon(0.01));
    const Rows expected = plain.film.rows(0, side), rows = result.film.rows(0, side);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        if (x != 21 || y != 40) REQUIRE(rows.color.pixel(x, y)[1] == expected.color.pixel(x, y)[1]);
    CHECK(rows.color.pixel(21, 40)[0] ==
          doctest::Approx(double(expected.color.pixel(21, 40)[0])).epsilon(0.05));
    for (const char* name : {"half", "noise"}) {
      CAPTURE(name);
      const auto at = [&](const Rows& of) { return double(*of[channel_named(name)].pixel(21, 40)); };
      CHECK(at(rows) == doctest::Approx(at(expected)).epsilon(0.1));
    }
    // One group of two samples has no more variance than the others.
    const auto variance = [&](const Rows& of) {
      return double(*of[channel_named("variance")].pixel(21, 40));
    };
    CHECK(variance(rows) < 1.5 * variance(expected));
  }
}

TEST_CASE("samples that are not finite are no outliers") {
  const Cleaned result = cleaned(
      [](int x, int y, int index) { return x == 3 && y == 3 && index == 2 ? std::nan("") : 1.0; }, 16);
  CHECK(result.outliers.pixels == 0);
  CHECK(std::isnan(result.film.rows(3, 1).color.pixel(3, 0)[0]));
}
