// Every n-th pixel along both axes: the picture that is shown first.
#include "host/core/grid.hpp"

#include "host/executors/executor.hpp"
#include "host/loader/scene_file.hpp"
#include "host/scene/integrator.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;

namespace {

struct Taken {
  std::vector<PixelSample> samples;
  std::vector<AuxiliarySample> auxiliaries;
};

Taken take(Executor& executor, const Grid& grid, bool auxiliaries) {
  Taken taken;
  taken.samples.resize(size_t(grid.pixels()));
  if (auxiliaries) taken.auxiliaries.resize(taken.samples.size());
  REQUIRE(executor.sample(grid, 1, taken.samples, taken.auxiliaries));
  return taken;
}

}  // namespace

TEST_CASE("a grid's width and height count the pixels that a stride leaves") {
  const Grid grid({3, 5, 10, 7}, 3);
  CHECK(grid.width() == 4);
  CHECK(grid.height() == 3);
  CHECK(grid.pixels() == 12);
  CHECK(Grid({0, 0, 10, 7}).pixels() == 70);
}

TEST_CASE("every third pixel equals the whole picture's pixel, bit by bit, however rays are traced") {
  struct Way {
    Backend backend;
    const char* rays;
  };
  for (const char* file : {"scenes/sphereflake.toml", "scenes/whitted.toml", "scenes/path/cornell_box.toml",
                           "scenes/sppm/points.toml"}) {
    const Scene scene = loader::load_scene(
        file, std::vector<loader::Override>{{"image.width=37"}, {"image.height=23"}, {"image.samples=4"}});
    const bool at_random = walks_at_random(scene.render.integrator);
    for (const Way& way : {Way{Backend::gpu, "lanes"}, Way{Backend::gpu, "packets"}, Way{Backend::twin, ""},
                           Way{Backend::reference, ""}}) {
      CAPTURE(file);
      CAPTURE(backend_name(way.backend));
      CAPTURE(way.rays);
      ExecutorOptions options;
      options.pack.acceleration = Acceleration::bvh;
      options.gpu.profile.rays = way.rays;
      const auto executor = make_executor(way.backend, scene, options);
      const Taken all = take(*executor, Rect{0, 0, 37, 23}, at_random);
      const Grid grid({5, 2, 32, 20}, 3);
      const Taken some = take(*executor, grid, at_random);
      int different = 0;
      for (int i = 0; i < grid.pixels(); ++i) {
        const int x = 5 + 3 * (i % grid.width()), y = 2 + 3 * (i / grid.width());
        const PixelSample &a = some.samples[size_t(i)], &b = all.samples[size_t(y * 37 + x)];
        different += a.color != b.color || a.hits != b.hits || a.rays != b.rays || a.trail != b.trail;
        if (!at_random) continue;
        const AuxiliarySample &c = some.auxiliaries[size_t(i)], &d = all.auxiliaries[size_t(y * 37 + x)];
        different += c.albedo != d.albedo || c.normal != d.normal;
      }
      CHECK(different == 0);
    }
  }
}
