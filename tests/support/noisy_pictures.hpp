// Noise of a known distribution on pictures whose truth is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "host/core/halves.hpp"
#include "host/image/noisy_picture.hpp"

namespace eyeray::engine::test {

using image::Image;
using image::NoisyPicture;

constexpr int width = 100, height = 70;  // pixels of the pictures

struct Truth {
  double color = 0;  // red; green and blue are 0.5 and 0.25 of it
  double albedo = 0.5;
  double normal = 0;  // its x
};

// Samples whose colours are the truth's times numbers of mean 1 and standard deviation `noise`, with a long
// tail. Albedo has Gaussian noise.
template <typename TruthAt>
inline NoisyPicture noisy_picture(const TruthAt& truth_at, int samples, double noise,
                                  double albedo_noise = 0) {
  NoisyPicture picture;
  for (Image* each : {&picture.color, &picture.half_color, &picture.variance, &picture.albedo,
                      &picture.half_albedo, &picture.normal, &picture.half_normal})
    *each = Image(width, height, 3);
  picture.samples = Image(width, height, 1);
  std::mt19937 random(1);
  std::exponential_distribution<double> light(1);
  std::normal_distribution<double> error(0, 1);
  constexpr double parts[] = {1, 0.5, 0.25};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Truth truth = truth_at(x, y);
      double sum[3]{}, squares[3]{}, half[3]{}, albedo = 0, half_albedo = 0;
      for (int i = 0; i < samples; ++i) {
        const double sample_albedo = truth.albedo + albedo_noise * error(random);
        albedo += sample_albedo / samples;
        if (in_first_half(uint64_t(i)))
          half_albedo += sample_albedo / double(first_half_of(uint64_t(samples)));
        for (int c = 0; c < 3; ++c) {
          const double value = truth.color * parts[c] * (1 + noise * (light(random) - 1));
          sum[c] += value;
          squares[c] += value * value;
          if (in_first_half(uint64_t(i))) half[c] += value / double(first_half_of(uint64_t(samples)));
        }
      }
      for (int c = 0; c < 3; ++c) {
        const double n = samples;
        picture.color.pixel(x, y)[c] = float(sum[c] / n);
        picture.half_color.pixel(x, y)[c] = float(half[c]);
        picture.variance.pixel(x, y)[c] = float((squares[c] - sum[c] * sum[c] / n) / (n * (n - 1)));
        picture.albedo.pixel(x, y)[c] = float(albedo);
        picture.half_albedo.pixel(x, y)[c] = float(half_albedo);
      }
      picture.normal.pixel(x, y)[0] = picture.half_normal.pixel(x, y)[0] = float(truth.normal);
      *picture.samples.pixel(x, y) = float(samples);
    }
  }
  return picture;
}

// A texture of stripes, on a ball that is lit from one side.
inline Truth textured(int x, int y) {
  const double normal = std::sin(0.03 * x) * std::cos(0.02 * y);
  const double albedo = (x / 3 + y / 5) % 2 ? 0.8 : 0.3;
  return {.color = albedo * (1.2 + normal), .albedo = albedo, .normal = normal};
}
inline Truth plain(int, int) {
  return {.color = 1};
}
// A shadow that no feature shows.
inline Truth shadowed(int x, int) {
  return {.color = x < 50 ? 1.0 : 0.2};
}

// The alpha from left to right: nothing, a soft edge, a solid object.
inline double soft_edge(int x) {
  return std::clamp((x - 30) / 30.0, 0.0, 1.0);
}
inline double hard_edge(int x) {
  return std::clamp(x - 49.5, 0.0, 1.0);
}

// A noisy white surface with that alpha. A sample is covered wholly or not at all.
inline NoisyPicture picture_with(double (*alpha_at)(int x), int samples) {
  NoisyPicture picture = noisy_picture(plain, samples, 0);
  picture.coverage = picture.half_coverage = Image(width, height, 1);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> chance(0, 1);
  std::exponential_distribution<double> light(1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0, squares = 0, half = 0, covered = 0, half_covered = 0;
      for (int i = 0; i < samples; ++i) {
        const bool hit = chance(random) < alpha_at(x);
        const double value = hit ? 1 + 0.5 * (light(random) - 1) : 0;
        sum += value;
        squares += value * value;
        covered += hit;
        if (in_first_half(uint64_t(i))) half += value, half_covered += hit;
      }
      const double n = samples, n_half = double(first_half_of(uint64_t(samples)));
      for (int c = 0; c < 3; ++c) {
        picture.color.pixel(x, y)[c] = float(sum / n);
        picture.half_color.pixel(x, y)[c] = float(half / n_half);
        picture.variance.pixel(x, y)[c] = float((squares - sum * sum / n) / (n * (n - 1)));
      }
      *picture.coverage.pixel(x, y) = float(covered / n);
      *picture.half_coverage.pixel(x, y) = float(half_covered / n_half);
    }
  return picture;
}

}  // namespace eyeray::engine::test
