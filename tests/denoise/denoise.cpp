// Noise of a known distribution on pictures whose truth is known.
#include "host/denoise/denoise.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <thread>
#include <vector>

#include "host/core/error.hpp"
#include "host/denoise/block_means.hpp"
#include "host/reference/denoising.hpp"

#include "tests/support/amount.hpp"
#include "tests/support/doctest.hpp"
#include "tests/support/noisy_pictures.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::denoise;
using namespace eyeray::engine::test;
using image::Image;

namespace {

// The mean squared error of red.
template <typename TruthAt>
double error_of(const Image& image, const TruthAt& truth_at) {
  double sum = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) sum += std::pow(double(image.pixel(x, y)[0]) - truth_at(x, y).color, 2);
  return sum / (width * height);
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

namespace {

// The largest difference of a picture from the reference's, relative to the reference's value and a
// hundredth.
double largest_difference(const NoisyPicture& noisy) {
  const Image denoised = denoise::denoise(noisy).color;
  const auto expected = reference::denoise(noisy);
  double largest = 0;
  int doubtful = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const reference::DenoisedPixel& pixel = expected[size_t(y * width + x)];
      CHECK(!pixel.undecided);
      doubtful += pixel.doubt[0] > 0;
      for (int c = 0; c < denoised.channels(); ++c) {
        const double wanted = pixel.color[size_t(c)];
        const double apart = std::abs(double(denoised.pixel(x, y)[c]) - wanted) - pixel.doubt[size_t(c)];
        largest = std::max(largest, apart / (std::abs(wanted) + 0.01));
      }
    }
  CHECK(doubtful < 0.05 * width * height);
  return largest;
}

}  // namespace

TEST_CASE("denoising agrees with the float64 reference") {
  const NoisyPicture pictures[] = {picture_with(soft_edge, 16), noisy_picture(textured, 16, 0.5, 0.2),
                                   noisy_picture(shadowed, 4, 1), noisy_picture(textured, 2, 0.5)};
  for (const NoisyPicture& each : std::span(pictures).first(size_t(amount(1, 4, 4))))
    CHECK(largest_difference(each) < 1e-4);
}

TEST_CASE("the reference leaves pixels that are not finite, and fireflies") {
  NoisyPicture noisy = noisy_picture(plain, 16, 0.5);
  noisy.color.pixel(30, 30)[1] = std::numeric_limits<float>::quiet_NaN();
  noisy.color.pixel(50, 20)[0] = noisy.half_color.pixel(50, 20)[0] = 900;
  noisy.variance.pixel(50, 20)[0] = 900 * 900;
  const Image denoised = denoise::denoise(noisy).color;
  const auto expected = reference::denoise(noisy);
  CHECK(std::isnan(expected[30 * width + 30].color[1]));
  CHECK(expected[20 * width + 50].color[0] == 900);
  CHECK(denoised.pixel(50, 20)[0] == 900);
  for (const int x : {28, 31, 49, 51, 60})
    CHECK(double(denoised.pixel(x, 20)[2]) ==
          doctest::Approx(expected[size_t(20 * width + x)].color[2]).epsilon(1e-5));
}

TEST_CASE("the share that is done is reported on the caller's thread, and a report may stop denoising") {
  const NoisyPicture noisy = noisy_picture(textured, 4, 0.5);
  const auto expected = denoise::denoise(noisy).color.samples();
  ProcessorStages stages;
  std::vector<double> shares;
  const auto caller = std::this_thread::get_id();
  stages.report_to([&](double share) {
    CHECK(std::this_thread::get_id() == caller);
    shares.push_back(share);
    return true;
  });
  CHECK(denoise::denoise(noisy, stages).color.samples() == expected);
  REQUIRE(shares.size() > 1);
  CHECK(std::ranges::is_sorted(shares));
  CHECK(shares.front() > 0);
  CHECK(shares.back() <= 1);
  CHECK(shares.back() > 0.5);

  int reports = 0;
  stages.report_to([&](double) { return ++reports < 2; });
  CHECK_THROWS_WITH_AS(denoise::denoise(noisy, stages), "denoising was stopped", Error);
  CHECK(reports == 2);
}
