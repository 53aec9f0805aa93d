#include "host/image/tone.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/vec.hpp"
#include "host/optics/temperature.hpp"

namespace eyeray::engine::image {
namespace {

Vec3 none(Vec3 color) {
  return color;
}

Vec3 neutral(Vec3 color) {
  // Subtract a dielectric's reflection at normal incidence, which renders add to base colours.
  const double least = std::min({color.r, color.g, color.b});
  color -= least < 0.08 ? least - 6.25 * least * least : 0.04;
  constexpr double start = 0.76, room = 1 - start;
  const double peak = std::max({color.r, color.g, color.b});
  if (peak < start) return color;
  const double squeezed = 1 - room * room / (peak + room - start);
  const double white = 1 - 1 / (0.15 * (peak - squeezed) + 1);
  return glm::mix(color * (squeezed / peak), Vec3(squeezed), white);
}

Vec3 hable(Vec3 x) {
  return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.3;
}
Vec3 filmic(Vec3 color) {
  return hable(2.0 * glm::max(color, 0.0)) / hable(Vec3(11.2));
}

Vec3 aces(Vec3 color) {
  // To the primaries in which the reference rendering works, less saturated; and back.
  const glm::dmat3 in(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
  const glm::dmat3 out(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
  const Vec3 x = in * (glm::max(color, 0.0) / 0.6);
  return glm::max(out * ((x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.4329510) + 0.238081)),
                  0.0);
}

// The share of white from the logarithm of light, from 0 to 1, with the slope 2 at middle grey.
double agx_contrast(double x) {
  constexpr double grey = 20.0 / 33;
  const bool low = x < grey;
  const double scale = low ? 59.507875 : 69.862789, power = low ? 3.0 : 3.25;
  return 0.5 + 2 * (x - grey) * std::pow(1 + scale * std::pow(std::abs(x - grey), power), -1 / power);
}

Vec3 agx(Vec3 color) {
  // The channels are mixed before the curve and unmixed after it, so that bright colours fade to white.
  const Vec3 bled(0.0424010710, 0.0784365016, 0.0791624274);
  const glm::dmat3 mixed(Vec3(bled.r) + Vec3(0.8, 0, 0), Vec3(bled.g) + Vec3(0, 0.8, 0),
                         Vec3(bled.b) + Vec3(0, 0, 0.8));
  Vec3 shown = mixed * glm::max(color, 0.0);
  constexpr double darkest = -12.473931, stops = 16.5;
  for (int i = 0; i < 3; ++i)
    shown[i] = agx_contrast(std::clamp((std::log2(std::max(shown[i], 1e-10)) - darkest) / stops, 0.0, 1.0));
  shown = glm::clamp(glm::inverse(mixed) * shown, 0.0, 1.0);
  return {std::pow(shown.r, 2.2), std::pow(shown.g, 2.2), std::pow(shown.b, 2.2)};
}

constexpr Vec3 (*curves[])(Vec3) = {none, neutral, filmic, aces, agx};
static_assert(std::size(curves) == std::size(tone_curves));

}  // namespace

Image toned(const Image& image, const Tone& tone) {
  Image result = image;
  const glm::dmat3 balance =
      tone.white_balance > 0 ? optics::adaptation_to(tone.white_balance) : glm::dmat3(1);
  const double factor = std::exp2(tone.exposure);
  auto& samples = result.samples();
  const size_t stride = image.channels() == 4 ? 4 : 3;
  for (size_t i = 0; i + 2 < samples.size(); i += stride) {
    Vec3 light = factor * Vec3(samples[i], samples[i + 1], samples[i + 2]);
    if (stride == 4) light = samples[i + 3] > 0 ? light / double(samples[i + 3]) : Vec3(0);
    if (tone.white_balance > 0) light = balance * light;
    const Vec3 shown = curves[size_t(tone.curve)](light);
    for (int c = 0; c < 3; ++c) samples[i + size_t(c)] = float(shown[c]);
  }
  return result;
}

}  // namespace eyeray::engine::image
