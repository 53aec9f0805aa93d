// Iteration limits: with a superellipsoid's lowered on the GPU, every sample without a flag is right all the
// same, and the flagged ones do not depend on how rays are traced.
#include <fmt/format.h>

#include "host/executors/executor.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/faults.hpp"
#include "tests/support/random_scene.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using test::Random;

namespace {

// More than a thousand superellipsoids, so that four lanes trace each incoherent ray; some let light through.
Scene crowd() {
  Random random(5);
  Scene scene = test::empty_scene();
  scene.camera.eye = Vec3(0, 0, 5);
  test::add(scene, make_phong({}));
  test::add(scene, make_dielectric({.shadow = 0.7}));
  for (int i = 0; i < 1200; ++i)
    test::add(scene,
              make_superellipsoid(random.point(2), Vec3(0.04) + 0.1 * glm::abs(random.point(1)),
                                  random.log_uniform(0.1, 1), random.log_uniform(0.1, 1)),
              i % 2);
  return scene;
}

struct Way {
  const char* name;
  const char* incoherent;
  bool coherent;
};

std::vector<QueryHit> ask(Executor& executor, std::span<const Query> rays, QueryKind kind, bool coherent) {
  std::vector<QueryHit> hits(rays.size());
  executor.query({rays, kind, coherent}, hits);
  return hits;
}

}  // namespace

TEST_CASE("at iteration limits each way to trace flags the same rays, and all others are right") {
  const test::TemporaryFolder folder;
  const std::string shaders = test::lay_fault(folder, "steps");
  const Scene scene = crowd();
  Random random(6);
  std::vector<Query> rays(2000);
  for (Query& ray : rays) {
    ray.o = random.point(3);
    ray.d = random.direction();
    ray.t_max = random.below(2) == 0 ? 3e38 : random.uniform(0, 4);
  }
  const auto twin = make_executor(Backend::twin, scene, {});
  for (const QueryKind kind : {QueryKind::nearest, QueryKind::any}) {
    const std::vector<QueryHit> expected = ask(*twin, rays, kind, false);
    for (const QueryHit& hit : expected) CHECK(hit.flags == 0);

    std::vector<QueryHit> first;
    for (const Way& way : {Way{"each alone", "lanes", false},
                           {"by four lanes", "cooperative", false},
                           {"together", "lanes", true}}) {
      ExecutorOptions options;
      options.shader_folder = shaders;
      options.gpu.profile.incoherent = way.incoherent;
      options.gpu.profile.profile = "cpu";
      const auto gpu = make_executor(Backend::gpu, scene, options);
      const std::vector<QueryHit> found = ask(*gpu, rays, kind, way.coherent);
      if (first.empty()) first = found;
      int flagged = 0, wrong = 0, silent = 0, otherwise = 0;
      for (size_t i = 0; i < rays.size(); ++i) {
        const bool right = found[i].t == expected[i].t && found[i].primitive == expected[i].primitive;
        flagged += found[i].flags == iteration_limit;
        wrong += !right;
        silent += !right && found[i].flags != iteration_limit;
        otherwise += found[i].flags != first[i].flags || found[i].t != first[i].t;
      }
      MESSAGE(fmt::format("{}: {} of {} rays flagged, {} wrong", way.name, flagged, rays.size(), wrong));
      CHECK(wrong > 10);
      CHECK(flagged < int(rays.size()));
      CHECK(silent == 0);
      CHECK(otherwise == 0);
    }
  }
}
