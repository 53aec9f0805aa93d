// Motion blur: a picture is the mean of the moments while the shutter is open.
#include "host/render/shutter.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "host/loader/scene_file.hpp"
#include "host/render/render.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::render;

namespace {

// A wall of radiance 1 that moves 8 pixels a frame to the right, with nothing behind it. At frame 0 its left
// edge is in the middle of 32 pixels.
Scene passing_wall(double shutter, int steps, int samples, double frame = 0) {
  return loader::parse_scene(fmt::format(R"(
[animation]
shutter = {}
shutter_steps = {}
frame = {}
[image]
width = 32
height = 4
samples = {}
pattern = "sobol"
[camera]
type = "orthographic"
eye = [0, 0, 5]
target = [0, 0, 0]
size = 16
[[material]]
name = "light"
type = "phong"
diffuse = 0
emission = 1
[[parallelogram]]
origin = [0, -10, 0]
edge_u = [100, 0, 0]
edge_v = [0, 20, 0]
material = "light"
[[track]]
target = "parallelogram.0.origin"
keyframes = [[-2, [-16, -10, 0]], [2, [16, -10, 0]]]
)",
                                         shutter, steps, frame, samples),
                             "scene.toml");
}

Rendering picture_of(const Scene& scene, executors::Backend backend) {
  return render::render(scene, *make_picture_executor(backend, scene, {}), {});
}

}  // namespace

TEST_CASE("samples cover all moments about equally often, and their mean approaches the middle soon") {
  for (const int moments : {1, 2, 7, 16, 60}) {
    for (const int samples : {60, 64, 100, 16384}) {
      CAPTURE(moments);
      CAPTURE(samples);
      std::vector<int> shown(size_t(moments), 0);
      double furthest = 0, sum = 0;
      for (int i = 0; i < samples; ++i) {
        const int moment = moment_of_sample(i, samples, moments);
        REQUIRE(moment >= 0);
        REQUIRE(moment < moments);
        ++shown[size_t(moment)];
        sum += (moment + 0.5) / moments;
        if (i >= samples / 4) furthest = std::max(furthest, std::abs(sum / (i + 1) - 0.5));
      }
      const auto [least, most] = std::ranges::minmax(shown);
      CHECK(most - least <= 4);
      CHECK(least > 0);
      CHECK(furthest < 0.2);
    }
  }
  // The first judgement of adaptive sampling, after 64 samples, has all 16 moments.
  std::set<int> seen;
  for (int i = 0; i < 64; ++i) seen.insert(moment_of_sample(i, 16384, 16));
  CHECK(seen.size() == 16);
}

TEST_CASE("a moving edge is blurred along its way, in proportion to its time at each pixel") {
  // The shutter is open for half a frame, a quarter before and after. The edge moves 4 pixels: from column 14
  // to column 18.
  const Scene scene = passing_wall(0.5, 64, 256);
  const Rendering picture = picture_of(scene, executors::Backend::twin);
  for (int x = 0; x < 32; ++x) {
    CAPTURE(x);
    // The share of the time for which the pixel [x, x + 1) is covered: the edge is at 14 + 4 t.
    const double covered = std::clamp((x + 0.5 - 14) / 4, 0.0, 1.0);
    CHECK(double(picture.color.pixel(x, 1)[0]) == doctest::Approx(covered).epsilon(0.02));
  }
  const Rendering sharp = picture_of(passing_wall(0, 64, 256), executors::Backend::twin);
  CHECK(sharp.color.pixel(15, 1)[0] == 0);
  CHECK(sharp.color.pixel(16, 1)[0] == 1);
}

TEST_CASE("each sample equals a still of its moment, bit by bit, on every backend; AOVs show the middle") {
  constexpr int steps = 4, samples = 8;
  const Scene scene = passing_wall(1, steps, samples);
  const Rect all{0, 0, 32, 4};
  const auto count = size_t(all.pixels());
  for (const auto backend :
       {executors::Backend::gpu, executors::Backend::twin, executors::Backend::reference}) {
    CAPTURE(backend_name(backend));
    const auto blurred = make_picture_executor(backend, scene, {});
    for (const int i : {0, 3, 4, 7}) {
      const int moment = moment_of_sample(i, samples, steps);
      const Scene still = passing_wall(0, steps, samples, (moment + 0.5) / steps - 0.5);
      std::vector<PixelSample> got(count), expected(count);
      REQUIRE(blurred->sample(all, uint32_t(i), got));
      REQUIRE(executors::make_executor(backend, still, {})->sample(all, uint32_t(i), expected));
      for (size_t p = 0; p < count; ++p) REQUIRE(got[p].color == expected[p].color);
    }
    std::vector<FirstHit> got(count), expected(count);
    blurred->first_hits(all, got);
    executors::make_executor(backend, passing_wall(0, 1, 1), {})->first_hits(all, expected);
    for (size_t p = 0; p < count; ++p) CHECK(got[p].primitive == expected[p].primitive);
  }
}

TEST_CASE("a scene without motion, or whose shutter is never open, shows one moment") {
  CHECK(passing_wall(0.5, 4, 4).animation.at);
  CHECK_FALSE(passing_wall(0, 4, 4).animation.at);
  const Scene still = loader::parse_scene("[animation]\nshutter = 0.5\n", "scene.toml");
  CHECK_FALSE(still.animation.at);
}
