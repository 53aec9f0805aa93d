#include "host/denoise/choice.hpp"

#include <algorithm>

namespace eyeray::engine::denoise {
namespace {

constexpr int error_radius = 2;  // radius of the windows in which errors are estimated

// The squared error of a fit in a small window, in plane 0: that from the other half, less that half's
// variance, which is in plane 1.
Planes errors_of(const Halves& colors, const Halves& variances, const Planes& valid, int begin, int end,
                 const Halves& fitted) {
  Planes sums(valid.width(), valid.height(), 2);
  for_each_pixel(valid, [&](int x, int y) {
    if (*valid.at(0, x, y) == 0) return;
    for (int c = begin; c < end; ++c) {
      const float first = *fitted.first.at(c, x, y) - *colors.second.at(c, x, y);
      const float second = *fitted.second.at(c, x, y) - *colors.first.at(c, x, y);
      const float noise = *variances.first.at(c, x, y) + *variances.second.at(c, x, y);
      *sums.at(0, x, y) += 0.5f * (first * first + second * second - noise);
      *sums.at(1, x, y) += 0.5f * noise;
    }
  });
  sums.extend();
  return blurred(sums, error_radius);
}

}  // namespace

void choose_best(const Halves& colors, const Halves& variances, const Planes& valid, int begin, int end,
                 const Halves& other, Halves& best) {
  const Planes errors = errors_of(colors, variances, valid, begin, end, best),
               others = errors_of(colors, variances, valid, begin, end, other);
  for_each_pixel(valid, [&](int x, int y) {
    const bool better = *others.at(0, x, y) < *errors.at(0, x, y);
    const float noise = 0.5f * *errors.at(1, x, y);
    const float error = std::max(0.0f, std::min(*errors.at(0, x, y), *others.at(0, x, y)) - noise);
    const float share = error > 0 ? error / (error + noise) : 0.0f;
    for (int c = begin; c < end; ++c) {
      const auto mix = [&](Planes& mixed, const Planes& second, const Planes& noisy) {
        float& value = *mixed.at(c, x, y);
        if (better) value = *second.at(c, x, y);
        value += share * (*noisy.at(c, x, y) - value);
      };
      mix(best.first, other.first, colors.first);
      mix(best.second, other.second, colors.second);
    }
  });
}

}  // namespace eyeray::engine::denoise
