#include "host/image/tone.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/vec.hpp"

namespace eyeray::engine::image {
namespace {

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

}  // namespace

Image toned(const Image& image, const Tone& tone) {
  Image result = image;
  const double factor = std::exp2(tone.exposure);
  auto& samples = result.samples();
  for (size_t i = 0; i + 2 < samples.size(); i += 3) {
    const Vec3 light = factor * Vec3(samples[i], samples[i + 1], samples[i + 2]);
    const Vec3 shown = tone.curve == ToneCurve::neutral ? neutral(light) : light;
    for (int c = 0; c < 3; ++c) samples[i + size_t(c)] = float(shown[c]);
  }
  return result;
}

}  // namespace eyeray::engine::image
