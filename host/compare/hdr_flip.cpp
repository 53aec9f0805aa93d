#include "host/compare/hdr_flip.hpp"

#include <algorithm>
#include <cmath>

#include "host/compare/frame.hpp"
#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"

namespace eyeray::engine::compare {

namespace {

// (k0 x² + k1 x) / (k3 x² + k4 x + k5): Narkowicz's fit of ACES, which takes 0.6 of its input.
constexpr double k0 = 0.36 * 2.51, k1 = 0.6 * 0.03, k3 = 0.36 * 2.43, k4 = 0.6 * 0.59, k5 = 0.14;
constexpr double shown_luminance = 0.85;  // the paper's t

double tone_mapped(double x) {
  // For such bright input, the terms in x² alone decide the quotient.
  if (x > 1e30) return 1;
  return std::clamp((k0 * x + k1) * x / ((k3 * x + k4) * x + k5), 0.0, 1.0);
}

// The luminance that the tone mapper maps to `shown_luminance`.
double brightest_shown() {
  const double a = k0 - shown_luminance * k3, b = k1 - shown_luminance * k4, c = -shown_luminance * k5;
  return -b / (2 * a) + std::sqrt(b * b / (4 * a * a) - c / a);
}

// The middle value, or for an even number the mean of the two in the middle. Reorders `values`.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

bool finite(const image::Image& image) {
  return std::ranges::all_of(image.samples(), [](float value) { return std::isfinite(value); });
}

}  // namespace

Exposures exposures_of(const image::Image& reference) {
  std::vector<double> luminances;
  luminances.reserve(size_t(reference.width()) * size_t(reference.height()));
  for (int y = 0; y < reference.height(); ++y)
    for (int x = 0; x < reference.width(); ++x)
      luminances.push_back(glm::dot(glm::max(color_at(reference, x, y), 0.0), luma_weights));
  const double greatest = *std::ranges::max_element(luminances);
  if (greatest == 0) return {};
  double middle = median(luminances);
  if (middle == 0) {
    std::erase(luminances, 0.0);
    middle = median(luminances);
  }
  Exposures exposures{std::log2(brightest_shown() / greatest), std::log2(brightest_shown() / middle)};
  exposures.count = std::max(2, int(std::ceil(exposures.stop - exposures.start)));
  return exposures;
}

image::Image exposed(const image::Image& image, double exposure) {
  const double factor = std::exp2(exposure);
  image::Image result(image.width(), image.height(), image.channels());
  const size_t row = size_t(image.width()) * size_t(image.channels());
  parallel_for(0, image.height(), [&](int y) {
    for (size_t i = size_t(y) * row; i < size_t(y + 1) * row; ++i)
      result.samples()[i] = float(tone_mapped(factor * std::max(double(image.samples()[i]), 0.0)));
  });
  return result;
}

std::optional<HdrFlip> hdr_flip(const image::Image& a, const image::Image& b) {
  CHECK(a.same_size(b));
  CHECK_LE(1u, a.sample_count());
  if (!finite(a) || !finite(b)) return std::nullopt;
  HdrFlip result{.exposures = exposures_of(b), .flip = {}, .map = {}, .exposure = {}};
  std::vector<double> greatest;
  for (int i = 0; i < result.exposures.count; ++i) {
    const double exposure = result.exposures.at(i);
    const std::vector<double> map = flip_map(exposed(a, exposure), exposed(b, exposure));
    if (i == 0) {
      greatest = map;
      result.exposure.assign(map.size(), float(exposure));
      continue;
    }
    for (size_t k = 0; k < map.size(); ++k) {
      if (map[k] <= greatest[k]) continue;
      greatest[k] = map[k];
      result.exposure[k] = float(exposure);
    }
  }
  result.map.assign(greatest.begin(), greatest.end());
  result.flip = summary(std::move(greatest));
  return result;
}

}  // namespace eyeray::engine::compare
