// Noise of a known distribution on pictures whose truth is known.
#include "host/denoise/denoise.hpp"

#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "host/core/halves.hpp"
#include "host/denoise/block_means.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::denoise;
using image::Image;

namespace {

constexpr int width = 100, height = 70;

struct Truth {
  double color = 0;  // red; green and blue are 0.5 and 0.25 of it
  double albedo = 0.5;
  double normal = 0;  // its x
};

// Samples whose colours are the truth's times numbers of mean 1 and standard deviation `noise`, with a long
// tail. Albedo has Gaussian noise.
template <typename TruthAt>
NoisyPicture noisy_picture(const TruthAt& truth_at, int samples, double noise, double albedo_noise = 0) {
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

// The mean squared error of red.
template <typename TruthAt>
double error_of(const Image& image, const TruthAt& truth_at) {
  double sum = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) sum += std::pow(double(image.pixel(x, y)[0]) - truth_at(x, y).color, 2);
  return sum / (width * height);
}

// A texture of stripes, on a ball that is lit from one side.
Truth textured(int x, int y) {
  const double normal = std::sin(0.03 * x) * std::cos(0.02 * y);
  const double albedo = (x / 3 + y / 5) % 2 ? 0.8 : 0.3;
  return {.color = albedo * (1.2 + normal), .albedo = albedo, .normal = normal};
}
Truth plain(int, int) {
  return {.color = 1};
}
// A shadow that no feature shows.
Truth shadowed(int x, int) {
  return {.color = x < 50 ? 1.0 : 0.2};
}

}  // namespace

TEST_CASE("noise goes, textures and lighting stay") {
  for (const int samples : {2, 5, 16, 64}) {
    CAPTURE(samples);
    const NoisyPicture noisy = noisy_picture(textured, samples, 0.5);
    const double before = error_of(noisy.color, textured),
                 after = error_of(denoise::denoise(noisy).color, textured);
    CHECK(after < before / 15);
  }
  // A texture whose own noise is seen, as where it is out of focus.
  const NoisyPicture noisy = noisy_picture(textured, 16, 0.5, 0.2);
  CHECK(error_of(denoise::denoise(noisy).color, textured) < error_of(noisy.color, textured) / 3);
}

namespace {

// The alpha from left to right: nothing, a soft edge, a solid object.
double soft_edge(int x) {
  return std::clamp((x - 30) / 30.0, 0.0, 1.0);
}
double hard_edge(int x) {
  return std::clamp(x - 49.5, 0.0, 1.0);
}

// A noisy white surface with that alpha. A sample is covered wholly or not at all.
NoisyPicture picture_with(double (*alpha_at)(int x), int samples) {
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

}  // namespace

TEST_CASE("objects stay solid, and nothing is beside them") {
  for (const auto edge : {soft_edge, hard_edge}) {
    const Image denoised = denoise::denoise(picture_with(edge, 16)).color;
    for (int y = 0; y < height; ++y)
      for (int x = 1; x < width - 1; ++x) {
        const float* const pixel = denoised.pixel(x, y);
        if (edge(x + 1) == 0) CHECK((pixel[0] == 0 && pixel[3] == 0));
        if (edge(x - 1) == 1) CHECK(pixel[3] == 1);
      }
  }
}

TEST_CASE("an alpha loses its noise") {
  const NoisyPicture noisy = picture_with(soft_edge, 16);
  const Image denoised = denoise::denoise(noisy).color;
  REQUIRE(denoised.channels() == 4);
  double before = 0, after = 0, colors = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float* const pixel = denoised.pixel(x, y);
      const double truth = soft_edge(x);
      before += std::pow(double(*noisy.coverage.pixel(x, y)) - truth, 2);
      after += std::pow(double(pixel[3]) - truth, 2);
      colors += std::pow(double(pixel[0]) - truth, 2);
    }
  CHECK(after < before / 4);
  CHECK(colors <
        error_of(noisy.color, [](int x, int) { return Truth{.color = soft_edge(x)}; }) * width * height / 4);
}

TEST_CASE("a shadow's edge stays sharp") {
  const NoisyPicture noisy = noisy_picture(shadowed, 16, 0.5);
  const Image denoised = denoise::denoise(noisy).color;
  CHECK(error_of(denoised, shadowed) < error_of(noisy.color, shadowed) / 15);
  for (const int x : {48, 49, 50, 51}) {
    double mean = 0;
    for (int y = 0; y < height; ++y) mean += double(denoised.pixel(x, y)[0]) / height;
    CHECK(mean == doctest::Approx(shadowed(x, 0).color).epsilon(0.03));
  }
}

TEST_CASE("blocks keep their mean brightness") {
  NoisyPicture noisy = noisy_picture(textured, 8, 1);
  noisy.color.pixel(20, 30)[0] = noisy.half_color.pixel(20, 30)[0] = 30;  // a firefly
  noisy.variance.pixel(20, 30)[0] = 20;
  const Image denoised = denoise::denoise(noisy).color;
  for (int top = 0; top < height; top += block_size) {
    for (int left = 0; left < width; left += block_size) {
      for (int c = 0; c < 3; ++c) {
        double before = 0, after = 0;
        for (int y = top; y < std::min(top + block_size, height); ++y) {
          for (int x = left; x < std::min(left + block_size, width); ++x) {
            before += double(noisy.color.pixel(x, y)[c]);
            after += double(denoised.pixel(x, y)[c]);
          }
        }
        CHECK(after == doctest::Approx(before).epsilon(0.005));
      }
    }
  }
}

TEST_CASE("a picture without noise stays as it is") {
  const auto check = [](int x, int y) { return Truth{.color = (x / 8 + y / 8) % 2 ? 1.0 : 0.4}; };
  const Image denoised = denoise::denoise(noisy_picture(check, 4, 0)).color;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      CHECK(double(denoised.pixel(x, y)[0]) == doctest::Approx(check(x, y).color).epsilon(0.001));
}

TEST_CASE("the error is estimated") {
  const DenoisedPicture denoised = denoise::denoise(noisy_picture(plain, 16, 1));
  const double error = std::sqrt(error_of(denoised.color, plain));
  CHECK(denoised.error > error / 2);
  CHECK(denoised.error < error * 2);
}

TEST_CASE("the errors of pixels are as large as they are") {
  const DenoisedPicture denoised = denoise::denoise(noisy_picture(textured, 32, 0.8));
  // All channels have the same relative error, so that of the luminance follows from red.
  const double of_red = std::sqrt(error_of(denoised.color, textured)) * (0.2126 + 0.7152 / 2 + 0.0722 / 4);
  double sum = 0;
  for (const float each : denoised.errors.samples()) sum += double(each) * double(each);
  CHECK(std::sqrt(sum / (width * height)) == doctest::Approx(of_red).epsilon(0.3));
}

TEST_CASE("pixels that are not finite or have one sample stay, and spoil no others") {
  NoisyPicture noisy = noisy_picture(plain, 16, 0.5);
  noisy.color.pixel(30, 30)[1] = std::numeric_limits<float>::quiet_NaN();
  noisy.half_color.pixel(40, 30)[2] = std::numeric_limits<float>::infinity();
  *noisy.samples.pixel(50, 30) = 1;
  noisy.color.pixel(50, 30)[0] = 7;
  const Image denoised = denoise::denoise(noisy).color;
  CHECK(std::isnan(denoised.pixel(30, 30)[1]));
  CHECK(denoised.pixel(40, 30)[2] == doctest::Approx(double(noisy.color.pixel(40, 30)[2])).epsilon(0.05));
  CHECK(denoised.pixel(50, 30)[0] > 5);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (x != 30 || y != 30) CHECK(std::isfinite(denoised.pixel(x, y)[1]));
}

TEST_CASE("the number of threads does not matter") {
  const NoisyPicture noisy = noisy_picture(textured, 8, 0.7);
  const Image many = denoise::denoise(noisy).color;
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(denoise::denoise(noisy).color.samples() == many.samples());
}

TEST_CASE("the smallest pictures") {
  for (const auto& [w, h] : {std::pair{1, 1}, {3, 2}, {33, 1}, {1, 17}}) {
    NoisyPicture picture;
    for (Image* each : {&picture.color, &picture.half_color, &picture.variance, &picture.albedo,
                        &picture.half_albedo, &picture.normal, &picture.half_normal})
      *each = Image(w, h, 3);
    picture.samples = Image(w, h, 1);
    for (float& each : picture.samples.samples()) each = 4;
    for (float& each : picture.color.samples()) each = 0.25f;
    for (float& each : picture.half_color.samples()) each = 0.25f;
    const Image denoised = denoise::denoise(picture).color;
    for (const float each : denoised.samples()) CHECK(each == doctest::Approx(0.25));
  }
}
