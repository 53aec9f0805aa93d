#include "benchmarks/bench/race.hpp"

#include <cmath>

#include "benchmarks/bench/field_run.hpp"
#include "benchmarks/bench/standard_scenes.hpp"
#include "host/loader/scene_file.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::bench;

TEST_CASE("contenders alternate after an untimed run, and are compared with the first") {
  std::string order;
  const auto contender = [&](char letter, double last_t) {
    return Contender{std::string(1, letter), ContenderKind::ours,
                     [&order, letter, last_t](const Batch&, std::span<QueryHit> hits) {
                       order += letter;
                       for (QueryHit& hit : hits) hit = {1, 0};
                       hits.back().t = last_t;
                       return order.size() <= 2 ? 100.0 : double(order.size());
                     }};
  };
  const Contender contenders[] = {contender('a', 2), contender('b', HUGE_VAL)};
  Batch batch;
  batch.rays.resize(5);
  const std::vector<Timing> timings = race(batch, contenders, 3);
  CHECK(order == "abababab");
  REQUIRE(timings.size() == 2);
  CHECK(timings[0].seconds.median == 5);
  CHECK(timings[0].seconds.min == 3);
  CHECK(timings[1].seconds.max == 8);
  CHECK(timings[0].differing == 0);
  CHECK(timings[1].differing == 1);
}

TEST_CASE("hits agree to a thousandth, and a miss with a miss alone") {
  CHECK(agree({1, 0}, {1.0005, 7}));
  CHECK_FALSE(agree({1, 0}, {1.002, 0}));
  CHECK(agree({HUGE_VAL, -1}, {HUGE_VAL, -1}));
  CHECK_FALSE(agree({HUGE_VAL, -1}, {1e30, 0}));
  CHECK_FALSE(agree({3, 0}, {HUGE_VAL, -1}));
  CHECK(agree({0, -1}, {0, -1}));
}

TEST_CASE("a spread holds median, minimum and maximum") {
  CHECK(spread({3, 1, 2}).median == 2);
  CHECK(spread({4, 1, 2, 3}).median == 2.5);
  CHECK(spread({4, 1, 2}).min == 1);
  CHECK(spread({4, 1, 2}).max == 4);
  CHECK(spread({}).median == 0);
}

TEST_CASE("a run builds, races all batches, and lists every contender") {
  const Scene scene = find_standard_scene("terrain-51k")->make();
  CHECK(scene.primitive_count() == 51'200);
  int calls = 0;
  const Contender ours{"ours", ContenderKind::ours, [&](const Batch& batch, std::span<QueryHit> hits) {
                         ++calls;
                         CHECK(batch.rays.size() == hits.size());
                         for (QueryHit& hit : hits) hit = {HUGE_VAL, -1};
                         return 1.0;
                       }};
  const SceneReport report =
      run_field("t", "terrain", scene, {.width = 40, .height = 30, .runs = 2}, std::span(&ours, 1));
  CHECK(calls == 9);
  CHECK(report.primitives == 51'200);
  REQUIRE(report.builds.size() == 1);
  CHECK(report.builds[0].bytes > 51'200 * 20);
  REQUIRE(report.batches.size() == 3);
  CHECK(report.batches[0].name == "primary");
  CHECK(report.batches[0].rays == 1200);
  for (const BatchReport& batch : report.batches) {
    REQUIRE(batch.timings.size() == 4);
    CHECK(batch.timings[0].kind == ContenderKind::single);
    CHECK(batch.timings[1].contender == "ours");
    CHECK(batch.timings[1].differing > 10);  // it reports that nothing is ever hit
    CHECK(batch.timings[2].differing <= 2);
    CHECK(fastest(batch, ContenderKind::packet) != nullptr);
    CHECK(times_as_fast(batch, batch.timings[1], ContenderKind::single) < 0.1);
  }
  // A surface without a light casts no shadow rays.
  Scene dark = find_standard_scene("terrain-51k")->make();
  dark.lights.clear();
  CHECK(run_field("t", "terrain", dark, {.width = 8, .height = 8, .runs = 1}, {}).batches.size() == 2);
}

TEST_CASE("standard scenes have the sizes that their names state") {
  CHECK(find_standard_scene("terrain-1m")->make().primitive_count() == 999'698);
  CHECK(find_standard_scene("sphereflake-7k")->make().primitive_count() == 7'381 + 2);
  const Scene mesh = find_standard_scene("sphereflake-mesh")->make();
  CHECK(mesh.primitive_count() == 944'768 + 2);
  CHECK(mesh.materials[size_t(mesh.instances[0].material)]->name == "ball");
  CHECK(find_standard_scene("terrain") == nullptr);
}
