#include "host/image/tone.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine::image;

namespace {

std::vector<float> pixel_toned(std::vector<float> pixel, const Tone& tone) {
  Image image(1, 1, 3);
  image.samples() = std::move(pixel);
  return toned(image, tone).samples();
}

}  // namespace

TEST_CASE("exposure counts in stops") {
  CHECK(pixel_toned({0.25f, 0.5f, 3}, {.exposure = 1}) == std::vector<float>{0.5f, 1, 6});
  CHECK(pixel_toned({0.25f, 0.5f, 3}, {.exposure = -2}) == std::vector<float>{0.0625f, 0.125f, 0.75f});
}

TEST_CASE("the neutral curve keeps base colours, less 0.04, and ends below 1") {
  const Tone neutral{.curve = ToneCurve::neutral};
  const auto middle = pixel_toned({0.5f, 0.5f, 0.5f}, neutral);
  CHECK(middle[0] == doctest::Approx(0.46));
  const auto red = pixel_toned({0.7f, 0.1f, 0.2f}, neutral);
  CHECK(red[0] == doctest::Approx(0.66));
  CHECK(red[1] == doctest::Approx(0.06));
  // Computed by hand: (4, 1, 1) less 0.04 has the peak 3.96, which is squeezed to 1 − 0.0576/3.44.
  const auto bright = pixel_toned({4, 1, 1}, neutral);
  CHECK(bright[0] == doctest::Approx(0.983256));
  CHECK(bright[1] == doctest::Approx(0.468299));
  double before = 0;
  for (float light = 0.01f; light < 1e6f; light *= 1.3f) {
    const auto shown = pixel_toned({light, light, light}, neutral);
    CHECK(double(shown[0]) >= before);
    CHECK(shown[0] < 1);
    before = double(shown[0]);
  }
  CHECK(pixel_toned({0, 0, 0}, neutral)[0] == 0);
}
