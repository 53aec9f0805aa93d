// A model that nobody could see is a warning.
#include "host/render/legibility.hpp"

#include <algorithm>

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using render::Legibility;

namespace {

// The warning for 100 × 100 pixels of a grey background, the first `count` of which are `value`.
std::string warning(int count, float value, double exposure = 0) {
  image::Image rows(100, 100, 3);
  std::ranges::fill(rows.samples(), 0.5f);
  std::fill_n(rows.samples().begin(), 3 * count, value);
  Legibility legibility(Vec3(0.5), exposure);
  legibility.see(rows);
  return legibility.warning();
}

}  // namespace

TEST_CASE("a picture of background alone, or of overexposed pixels, is reported") {
  CHECK(warning(5, 0).find("cannot be distinguished from the background") != std::string::npos);
  CHECK(warning(5000, 0.5f).find("cannot be distinguished from the background") != std::string::npos);
  CHECK(warning(20, 0) == "");
  CHECK(warning(5000, 1) == "");
  CHECK(warning(5000, 1.5f).find("brighter than white") != std::string::npos);
  CHECK(warning(5000, 1.5f, -1) == "");
  CHECK(warning(5000, 1.5f, 0.5).ends_with("try --exposure -1.5, or --tone neutral"));
  CHECK(warning(5000, 30000).ends_with("try --exposure -15"));
  CHECK(warning(5000, 30000, -15) == "");
  CHECK(warning(5000, 0.75f, 1).find("brighter than white") != std::string::npos);
}
