// The light meter: exposure = "auto".
#include "host/render/light_meter.hpp"

#include <algorithm>
#include <cmath>

#include "fake_executor.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using render::exposure_for;
using render::metered_exposure;

namespace {

// 80 × 80 grey pixels, of which the upper `rows` are `other`.
image::Image picture(float value, int rows = 0, float other = 0) {
  image::Image picture(80, 80, 3);
  std::ranges::fill(picture.samples(), value);
  std::fill_n(picture.samples().begin(), 3 * 80 * rows, other);
  return picture;
}

}  // namespace

TEST_CASE("the geometric mean of the light becomes 0.36") {
  CHECK(exposure_for(picture(0.36f)) == doctest::Approx(0));
  CHECK(exposure_for(picture(0.72f)) == doctest::Approx(-1));
  CHECK(exposure_for(picture(0.045f)) == doctest::Approx(3));
  CHECK(exposure_for(picture(0.18f, 40, 0.72f)) == doctest::Approx(0));
  CHECK(exposure_for(picture(0.36f, 40, 0)) == doctest::Approx(0));
  // Squares of 4 × 4 pixels have the mean of their light.
  CHECK(exposure_for(picture(0.18f, 2, 0.54f)) == doctest::Approx(1));
}

TEST_CASE("neither the brightest nor the darkest tenth of a picture changes its exposure") {
  for (const float other : {0.0f, 1e-6f, 1.0f, 1e6f})
    CHECK(exposure_for(picture(0.18f, 8, other)) == doctest::Approx(1));
}

TEST_CASE("no more than a tenth of a picture is beyond white") {
  for (const float bright : {4.0f, 1e6f})
    CHECK(exposure_for(picture(0.01f, 16, bright)) == doctest::Approx(-std::log2(double(bright))));
  CHECK(exposure_for(picture(0.01f, 16, 0.02f)) > 4);
}

TEST_CASE("exposures of extreme pictures stay within the key's range") {
  CHECK(exposure_for(picture(0)) == 0);
  CHECK(exposure_for(picture(1e-30f)) == 32);
  CHECK(exposure_for(picture(1e30f)) == -32);
  CHECK(std::isfinite(exposure_for(picture(0.1f, 10, INFINITY))));
  CHECK(std::isfinite(exposure_for(picture(0.1f, 10, NAN))));
}

TEST_CASE("the meter takes one sample of the whole picture, only if the scene asks for it") {
  Scene scene = test::scene_of(90, 60, 4);
  test::FakeExecutor executor;
  scene.image.tone.exposure = 1.5;
  CHECK(metered_exposure(scene, executor) == 1.5);
  CHECK(executor.calls == 0);

  bool goes_on = true;
  int calls = 0;
  test::FakeExecutor metered([&](int) { return ++calls, goes_on; });
  scene.image.meters = true;
  const double exposure = metered_exposure(scene, metered);
  CHECK(calls == 1);
  std::vector<PixelSample> samples(90 * 60);
  test::FakeExecutor().sample(Grid(Rect{0, 0, 90, 60}), 0, samples, {});
  image::Image picture(90, 60, 3);
  for (size_t i = 0; i < samples.size(); ++i)
    for (int channel = 0; channel < 3; ++channel)
      picture.samples()[3 * i + size_t(channel)] = float(samples[i].color[channel]);
  CHECK(exposure == exposure_for(picture));
  goes_on = false;
  CHECK(metered_exposure(scene, metered) == 0);
}
