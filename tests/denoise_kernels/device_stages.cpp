// Denoising by kernels has the bits of denoising by the processor.
#include "host/denoise_kernels/device_stages.hpp"

#include <algorithm>
#include <atomic>
#include <vector>

#include "host/core/error.hpp"
#include "host/core/termination.hpp"
#include "host/denoise/denoise.hpp"
#include "host/executors/tuning.hpp"

#include "tests/support/doctest.hpp"
#include "tests/support/noisy_pictures.hpp"
#include "tests/support/shader_overlay.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::denoise_kernels;
using namespace eyeray::engine::test;

namespace {

// The number of values of which processor and device compute different bits.
size_t different(const NoisyPicture& picture, const executors::ExecutorOptions& options = {}) {
  DeviceStages stages(executors::open_device(options.gpu), options);
  const image::DenoisedPicture device = denoise::denoise(picture, stages),
                               processor = denoise::denoise(picture);
  REQUIRE(device.color.sample_count() == processor.color.sample_count());
  size_t count = 0;
  for (const auto& [one, other] :
       {std::pair{&device.color, &processor.color}, {&device.errors, &processor.errors}})
    for (size_t i = 0; i < one->sample_count(); ++i) count += one->samples()[i] != other->samples()[i];
  return count;
}

// A picture of that size, which repeats this one, or shows its first rows and columns.
NoisyPicture resized(NoisyPicture picture, int columns, int rows) {
  for (Image* each : {&picture.color, &picture.half_color, &picture.variance, &picture.albedo,
                      &picture.half_albedo, &picture.normal, &picture.half_normal, &picture.samples}) {
    Image result(columns, rows, each->channels());
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x)
        std::copy_n(each->pixel(x % each->width(), y % each->height()), each->channels(), result.pixel(x, y));
    *each = result;
  }
  return picture;
}

}  // namespace

TEST_CASE("kernels have the processor's bits") {
  CHECK(different(noisy_picture(textured, 16, 0.5, 0.2)) == 0);
  CHECK(different(noisy_picture(shadowed, 5, 1)) == 0);
  CHECK(different(picture_with(soft_edge, 16)) == 0);
}

TEST_CASE("kernels have the processor's bits where a picture has many tiles") {
  CHECK(different(resized(noisy_picture(textured, 4, 0.5, 0.2), 280, 140)) == 0);
}

TEST_CASE("kernels have the processor's bits on a device that keeps no more than Vulkan promises") {
  const NoisyPicture picture = resized(noisy_picture(textured, 16, 0.5, 0.2), 40, 24);
  for (const char* freedom : {"device-division=worst", "device-contraction=worst", "device-nan=worst",
                              "device-denormals=worst", "division=exact"}) {
    CAPTURE(freedom);
    executors::ExecutorOptions options;
    executors::tune(options, freedom);
    CHECK(different(picture, options) == 0);
  }
}

TEST_CASE("a fault in a kernel shows") {
  executors::ExecutorOptions options;
  const TemporaryFolder folder;
  lay_changed_shader(folder.path(), "denoise/distance.glsl", "0.25f / float(values)",
                     "0.26f / float(values)");
  options.shader_folder = folder.path();
  CHECK(different(resized(noisy_picture(textured, 16, 0.5), 40, 24), options) > 0);
}

TEST_CASE("kernels report the share that is done, and a report stops them") {
  const NoisyPicture picture = resized(noisy_picture(textured, 4, 0.5), 40, 24);
  DeviceStages stages(executors::open_device({}), {});
  std::vector<double> shares;
  stages.report_to([&](double share) {
    shares.push_back(share);
    return share < 1;
  });
  CHECK_THROWS_WITH_AS(denoise::denoise(picture, stages), "denoising was stopped", Error);
  CHECK(shares.size() >= 2);
  CHECK(std::ranges::is_sorted(shares));
  CHECK(shares.back() == 1);
}

TEST_CASE("kernels stop when interrupted, and the processor does not") {
  const NoisyPicture picture = resized(noisy_picture(textured, 4, 0.5), 40, 24);
  DeviceStages stages(executors::open_device({}), {});
  const std::atomic<bool> stop = true;
  const Interruptible interruptible(stop);
  CHECK_THROWS_WITH_AS(denoise::denoise(picture, stages), "interrupted", Error);
  CHECK(denoise::denoise(picture).color.sample_count() > 0);
}
