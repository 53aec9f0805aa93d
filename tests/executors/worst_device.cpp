// Kernels give the twin's bits on a device that keeps no more than Vulkan promises. Without their protection
// they do not.
#include "host/executors/executor.hpp"
#include "host/executors/tuning.hpp"
#include "host/loader/scene_file.hpp"
#include "tests/support/shader_overlay.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;

namespace {

const std::vector<std::string_view> every_freedom = {"device-division=worst", "device-contraction=worst",
                                                     "device-denormals=worst", "device-nan=worst"};

Scene small_scene(const char* file) {
  return loader::load_scene(file, std::vector<loader::Override>{{"image.width=32"}, {"image.height=24"}});
}

// The number of pixels whose colours on the GPU, with such options, and on the twin differ.
size_t different_pixels(const Scene& scene, const std::vector<std::string_view>& settings,
                        ExecutorOptions options = {}) {
  for (const std::string_view setting : settings) tune(options, setting);
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

TEST_CASE("on a device that keeps no more than Vulkan promises, kernels give the twin's bits") {
  for (const char* file : {"scenes/whitted.toml", "scenes/path/cornell_box.toml"}) {
    CAPTURE(file);
    const Scene scene = small_scene(file);
    for (const std::string_view freedom : every_freedom) {
      CAPTURE(freedom);
      CHECK(different_pixels(scene, {freedom}) == 0);
    }
    CHECK(different_pixels(scene, every_freedom) == 0);
    CHECK(different_pixels(scene, {"division=exact"}) == 0);
  }
}

TEST_CASE("without correction, a device's division changes pixels") {
  for (const char* file : {"scenes/whitted.toml", "scenes/path/cornell_box.toml"})
    CHECK(different_pixels(small_scene(file), {"division=own", "device-division=worst"}) > 50);
}

TEST_CASE("without NoContraction, a device that contracts changes pixels") {
  ExecutorOptions options;
  options.gpu.fast_math = true;
  CHECK(different_pixels(small_scene("scenes/whitted.toml"), {"device-contraction=worst"}, options) > 50);
}

TEST_CASE("without denormals, a scene of a size of 1e-11 has other pixels") {
  const test::TemporaryFolder folder;
  test::write_text(folder / "tiny.toml", R"(
[image]
width = 48
height = 36
[camera]
eye = [0, 0, 5e-11]
target = [0, 0, 0]
fov = 40
[[light]]
type = "point"
position = [3e-11, 3e-11, 3e-11]
intensity = 1e-22
[[material]]
name = "grey"
type = "phong"
diffuse = 0.6
[[sphere]]
center = [0, 0, 0]
radius = 1e-11
material = "grey"
[[triangle]]
material = "grey"
vertices = [[-3e-11, -1e-11, -3e-11], [3e-11, -1e-11, -3e-11], [0, 3e-11, -1e-11]]
)");
  const Scene scene = loader::load_scene(folder / "tiny.toml");
  CHECK(different_pixels(scene, {}) == 0);
  CHECK(different_pixels(scene, {"device-denormals=worst"}) > 10);
}
