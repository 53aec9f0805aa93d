// FLIP and HDR-FLIP, pixel by pixel, against the papers' formulas written down a second time.
#include "host/compare/flip.hpp"

#include <limits>
#include <numeric>

#include "flip_by_the_book.hpp"
#include "host/compare/hdr_flip.hpp"
#include "host/compare/metrics.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::compare;
using namespace eyeray::engine::image;
using eyeray::engine::test::Random;
namespace book = eyeray::engine::test::book;

namespace {

constexpr int columns = 36, rows = 27;

// A picture of gradients, edges, points and noise, with colours up to `brightest`; much of it is dark.
Image scene(uint64_t seed, double brightest) {
  Random random(seed);
  Image image(columns, rows, 3);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      for (int c = 0; c < 3; ++c) {
        const double ramp = double(x + 2 * y + 5 * c) / (columns + 2 * rows + 10);
        const bool bright = (x / 9 + y / 9) % 3 == 0, point = x % 13 == 4 && y % 11 == 5;
        const double value = point ? 1 : bright ? 0.3 + 0.4 * ramp : 0.05 * ramp;
        image.pixel(x, y)[c] = float(brightest * value * random.uniform(0.8, 1));
      }
  return image;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

}  // namespace

TEST_CASE("FLIP equals the papers' values at every pixel") {
  const Image a = scene(1, 1), b = scene(2, 0.9);
  const std::vector<double> map = flip_map(a, b),
                            expected = book::ldr_flip(book::picture_of(a), book::picture_of(b));
  double worst = 0;
  for (size_t i = 0; i < map.size(); ++i) worst = std::max(worst, std::abs(map[i] - expected[i]));
  CHECK(worst < 1e-6);
  CHECK(mean(expected) > 0.02);
  CHECK(std::abs(flip(a, b).mean - mean(expected)) < 1e-6);
}

TEST_CASE("HDR-FLIP equals the papers' exposures, and their errors at every pixel") {
  for (const double brightest : {1.0, 40.0, 3e5}) {
    CAPTURE(brightest);
    const Image a = scene(1, 1.3 * brightest), b = scene(2, brightest);
    const auto hdr = hdr_flip(a, b);
    REQUIRE(hdr);
    const book::HdrFlip expected = book::hdr_flip(book::picture_of(a), book::picture_of(b));
    CHECK(std::abs(hdr->exposures.start - expected.start) < 1e-9);
    CHECK(std::abs(hdr->exposures.stop - expected.stop) < 1e-9);
    CHECK(hdr->exposures.count == expected.count);
    CHECK(hdr->exposures.count > 3);
    double worst = 0;
    for (size_t i = 0; i < hdr->map.size(); ++i)
      worst = std::max(worst, std::abs(double(hdr->map[i]) - expected.map[i]));
    CHECK(worst < 1e-5);
    CHECK(std::abs(hdr->flip.mean - mean(expected.map)) < 1e-6);
    // A pixel's exposure is one at which its error is found.
    for (const size_t i : {size_t{0}, size_t{300}, size_t{971}}) {
      const double exposure = double(hdr->exposure[i]);
      CHECK(exposure >= hdr->exposures.start - 1e-5);
      CHECK(exposure <= hdr->exposures.stop + 1e-5);
      CHECK(flip_map(exposed(a, exposure), exposed(b, exposure))[i] ==
            doctest::Approx(double(hdr->map[i])).epsilon(1e-4));
    }
  }
}

TEST_CASE("equal, black and half black pictures have exposures, non-finite pictures have none") {
  const Image grey = [] {
    Image image(4, 4, 1);
    for (float& value : image.samples()) value = 2;
    return image;
  }();
  CHECK(exposures_of(grey).start == exposures_of(grey).stop);
  CHECK(exposures_of(grey).count == 2);
  CHECK(double(exposed(grey, exposures_of(grey).start).samples()[0]) == doctest::Approx(0.85));
  CHECK(hdr_flip(grey, grey)->flip.mean == 0);

  const Image black(4, 4, 1);
  CHECK(exposures_of(black).start == 0);
  CHECK(exposures_of(black).count == 2);
  CHECK(hdr_flip(grey, black)->flip.mean > 0.5);

  Image bright(4, 4, 1);
  bright.samples()[3] = 100;
  bright.samples()[5] = 1;
  bright.samples()[6] = 1;
  CHECK(exposures_of(bright).stop - exposures_of(bright).start == doctest::Approx(std::log2(100)));

  Image bad = grey;
  bad.samples()[7] = std::numeric_limits<float>::infinity();
  CHECK_FALSE(hdr_flip(bad, grey));
  CHECK_FALSE(measure(grey, grey).hdr_flip);
  CHECK(measure(grey, grey, true).hdr_flip);
}
