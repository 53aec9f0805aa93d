// Kernels that correct division and square root give the twin's bits on a device whose own are as wrong as
// Vulkan allows.
#include "host/executors/executor.hpp"
#include "host/loader/scene_file.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;

namespace {

// The number of pixels whose colours on the GPU and the twin differ.
size_t different_pixels(const Scene& scene, Division division, bool worst) {
  ExecutorOptions options;
  options.gpu.division = division;
  options.gpu.worst_division = worst;
  const Rect all{0, 0, scene.image.width, scene.image.height};
  const auto samples_by = [&](Backend backend) {
    const auto executor = make_executor(backend, scene, options);
    std::vector<PixelSample> samples(size_t(all.pixels()));
    REQUIRE(executor->sample(all, 0, samples));
    return samples;
  };
  const std::vector<PixelSample> gpu = samples_by(Backend::gpu), twin = samples_by(Backend::twin);
  size_t count = 0;
  for (size_t i = 0; i < gpu.size(); ++i) count += gpu[i].color != twin[i].color;
  return count;
}

}  // namespace

TEST_CASE("on a device as wrong as Vulkan allows, corrected kernels give the twin's bits") {
  for (const char* file : {"scenes/whitted.toml", "scenes/path/cornell_box.toml"}) {
    CAPTURE(file);
    const Scene scene =
        loader::load_scene(file, std::vector<loader::Override>{{"image.width=32"}, {"image.height=24"}});
    CHECK(different_pixels(scene, Division::automatic, true) == 0);
    CHECK(different_pixels(scene, Division::own, true) > 50);
    CHECK(different_pixels(scene, Division::exact, false) == 0);
  }
}
