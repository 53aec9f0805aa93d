#include <cmath>

#include "host/image/tone.hpp"
#include "host/optics/temperature.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;

namespace {

std::vector<float> pixel_toned(std::vector<float> pixel, const Tone& tone) {
  Image image(1, 1, 3);
  image.samples() = std::move(pixel);
  return toned(image, tone).samples();
}

double grey_toned(ToneCurve curve, double light) {
  const float l = float(light);
  return double(pixel_toned({l, l, l}, {.curve = curve})[1]);
}

// The chromaticity x, y of a black body, from Planck's law and the CIE's colour matching functions of 1931.
// Their fit: Wyman, Sloan and Shirley, Simple Analytic Approximations to the CIE XYZ Color Matching
// Functions, JCGT 2013.
Vec2 chromaticity_by_planck(double kelvin) {
  const auto lobe = [](double l, double height, double center, double left, double right) {
    const double t = (l - center) * (l < center ? left : right);
    return height * std::exp(-0.5 * t * t);
  };
  Vec3 sum(0.0);
  for (double l = 360; l <= 830; l += 1) {
    const double light = std::pow(l, -5) / (std::exp(1.4387769e7 / (l * kelvin)) - 1);
    sum += light * Vec3(lobe(l, 0.362, 442.0, 0.0624, 0.0374) + lobe(l, 1.056, 599.8, 0.0264, 0.0323) +
                            lobe(l, -0.065, 501.1, 0.0490, 0.0382),
                        lobe(l, 0.821, 568.8, 0.0213, 0.0247) + lobe(l, 0.286, 530.9, 0.0613, 0.0322),
                        lobe(l, 1.217, 437.0, 0.0845, 0.0278) + lobe(l, 0.681, 459.0, 0.0385, 0.0725));
  }
  return Vec2(sum) / (sum.x + sum.y + sum.z);
}

Vec2 chromaticity(double kelvin) {
  const Vec3 color = optics::black_body_xyz(kelvin);
  return Vec2(color) / (color.x + color.y + color.z);
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

TEST_CASE("every curve keeps black, never darkens as light grows, and ends at white") {
  for (size_t i = 1; i < std::size(tone_curves); ++i) {
    CAPTURE(tone_curves[i]);
    const ToneCurve curve{int(i)};
    CHECK(std::abs(grey_toned(curve, 0)) < 1e-4);
    double before = -1;
    for (double light = 1e-6; light < 1e6; light *= 1.1) {
      const double shown = grey_toned(curve, light);
      CHECK(shown >= before - 1e-6);
      before = shown;
    }
    CHECK(before > 0.95);
    CHECK(std::abs(std::log2(grey_toned(curve, 0.18) / 0.18)) < 1);
    // Colours that a screen lacks, and lights of one channel, stay finite.
    for (const std::vector<float>& light : {std::vector<float>{-1, 0, 2}, {0, 0, 1e6f}, {1e-9f, 0, 0}})
      for (const float shown : pixel_toned(light, {.curve = curve})) CHECK(std::isfinite(shown));
  }
}

TEST_CASE("filmic: white is 5.6, and the curve is Hable's") {
  CHECK(grey_toned(ToneCurve::filmic, 5.6) == doctest::Approx(1));
  // By the constants of the talk, with a calculator: A x² and so on at x = 2, over that at 11.2.
  const double numerator =
      (2 * (0.15 * 2 + 0.1 * 0.5) + 0.2 * 0.02) / (2 * (0.15 * 2 + 0.5) + 0.2 * 0.3) - 0.02 / 0.3;
  CHECK(grey_toned(ToneCurve::filmic, 1) == doctest::Approx(numerator / 0.725106).epsilon(1e-4));
}

TEST_CASE("aces: greys are within 0.07 of Narkowicz's fit of the same transform") {
  for (double light = 0.01; light < 20; light *= 1.3) {
    const double narkowicz = light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14);
    CHECK(std::abs(grey_toned(ToneCurve::aces, light) - narkowicz) < 0.07);
  }
}

TEST_CASE("agx: 10 stops below middle grey is black, 6.5 above is white, grey is half a screen's code") {
  CHECK(grey_toned(ToneCurve::agx, 0.18) == doctest::Approx(std::pow(0.5, 2.2)).epsilon(1e-3));
  CHECK(grey_toned(ToneCurve::agx, 0.18 * std::exp2(-10)) < 1e-4);
  CHECK(grey_toned(ToneCurve::agx, 0.18 * std::exp2(6.5)) == doctest::Approx(1).epsilon(1e-4));
  // Its slope there is 2 of the whole range of 16.5 stops.
  const auto code = [](double stops) {
    return std::pow(grey_toned(ToneCurve::agx, 0.18 * std::exp2(stops)), 1 / 2.2);
  };
  CHECK((code(0.1) - code(-0.1)) / 0.2 == doctest::Approx(2 / 16.5).epsilon(1e-2));
  // Bright red fades towards white.
  const auto red = pixel_toned({16, 0, 0}, {.curve = ToneCurve::agx});
  CHECK(red[0] > 0.9f);
  CHECK(red[1] > 0.2f);
}

TEST_CASE("black bodies have the colours of Planck's law") {
  for (const double kelvin : {1700.0, 2000.0, 2856.0, 4000.0, 5000.0, 6500.0, 10000.0, 20000.0}) {
    CAPTURE(kelvin);
    CHECK(glm::length(chromaticity(kelvin) - chromaticity_by_planck(kelvin)) < 0.006);
  }
  // CIE's illuminant A, and the published 5000 and 10 000 K.
  CHECK(glm::length(chromaticity(2856) - Vec2(0.4476, 0.4074)) < 0.001);
  CHECK(glm::length(chromaticity(5000) - Vec2(0.3451, 0.3516)) < 0.001);
  CHECK(glm::length(chromaticity(10000) - Vec2(0.2807, 0.2884)) < 0.001);
  CHECK(glm::dot(optics::shown_black_body(1700), Vec3(0.2126, 0.7152, 0.0722)) ==
        doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("white balance makes its light white, as Lindbloom's matrix from illuminant A to D65 does") {
  for (const double kelvin : {2000.0, 2856.0, 6500.0, 12000.0}) {
    const Vec3 light = optics::shown_black_body(kelvin);
    const auto shown =
        pixel_toned({float(light.r), float(light.g), float(light.b)}, {.white_balance = kelvin});
    for (const float channel : shown) CHECK(double(channel) == doctest::Approx(1).epsilon(1e-3));
  }
  const glm::dmat3 rgb_to_xyz = glm::transpose(glm::dmat3(
      0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920, 0.9503041));
  const glm::dmat3 published = glm::transpose(glm::dmat3(
      0.8446965, -0.1179225, 0.3948108, -0.1366303, 1.1041226, 0.1291718, 0.0798489, -0.1348999, 3.1924009));
  const glm::dmat3 ours = rgb_to_xyz * optics::adaptation_to(2856) * glm::inverse(rgb_to_xyz);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) CHECK(std::abs(ours[i][k] - published[i][k]) < 0.02);
}
