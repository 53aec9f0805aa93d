// Kernel against twin, ray by ray: hits do not depend on where the shader runs nor on how it was specialised.
#include <fmt/format.h>

#include "tests/support/query_kernel.hpp"
#include "tests/support/random_scene.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::records;

TEST_CASE("nearest and any: every bit is the same on the GPU, unrolled or looping, and on the twin") {
  gpu::Device device({});
  test::Random random(7);
  for (int round = 0; round < 6; ++round) {
    const PackedScene scene = test::random_packed_scene(random, 1 + round);
    REQUIRE_FALSE(scene.has_bvh);
    std::vector<shader::QueryRay> rays(100'000);
    for (shader::QueryRay& ray : rays) ray = test::random_ray(random);
    const std::vector<shader::QueryHit> nearest = test::query_twin(scene, rays, false);
    const std::vector<shader::QueryHit> any = test::query_twin(scene, rays, true);
    const auto hits =
        std::ranges::count_if(nearest, [](const shader::QueryHit& hit) { return hit.primitive != NONE; });
    const auto shadows =
        std::ranges::count_if(any, [](const shader::QueryHit& hit) { return hit.occlusion > 0; });
    for (const bool constants : {true, false}) {
      Specialisation specialisation;
      specialisation.constants = constants;
      test::QueryKernel kernel(device, scene, specialisation);
      const int different = test::differences(kernel.ask(rays, false), nearest) +
                            test::differences(kernel.ask(rays, true), any);
      MESSAGE(fmt::format("{} primitives, {}: {} of {} rays hit, {} in shadow, {} differ",
                          scene.primitives.size(), constants ? "unrolled" : "looping", hits, rays.size(),
                          shadows, different));
      CHECK(hits > 20'000);
      CHECK(shadows > 20'000);
      CHECK(different == 0);
    }
  }
}
