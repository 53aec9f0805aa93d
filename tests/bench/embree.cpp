// Embree's hits on our scenes are those that float64 finds one shape at a time.
#include "benchmarks/contenders/embree.hpp"

#include "host/generate/octasphere.hpp"
#include "host/loader/scene_file.hpp"
#include "host/scene/shape.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::generate;
using namespace eyeray::engine::contenders;
using eyeray::engine::test::Random;

namespace {

constexpr EmbreeCalls all_calls[] = {EmbreeCalls::one, EmbreeCalls::packets_of_8, EmbreeCalls::packets_of_16};

// Opaque and clear shapes of every kind.
Scene mixed_scene() {
  std::string text = R"([[light]]
type = "point"
position = [0, 9, 0]
[[material]]
name = "matte"
type = "phong"
[[material]]
name = "glass"
type = "dielectric"
[[plane]]
point = [0, -3, 0]
normal = [0, 1, 0.1]
material = "matte"
)";
  Random random(1);
  for (int i = 0; i < 60; ++i) {
    const Vec3 a = random.point(3), b = a + random.point(1), c = a + random.point(1);
    const char* const material = i % 3 == 0 ? "glass" : "matte";
    text += fmt::format("[[sphere]]\ncenter = [{}, {}, {}]\nradius = {}\nmaterial = \"{}\"\n", a.z, a.x, a.y,
                        random.uniform(0.05, 0.5), material);
    text += fmt::format(
        "[[triangle]]\nvertices = [[{}, {}, {}], [{}, {}, {}], [{}, {}, {}]]\nmaterial = \"{}\"\n", a.x, a.y,
        a.z, b.x, b.y, b.z, c.x, c.y, c.z, material);
  }
  return parse_scene(text, "mixed");
}

std::vector<Query> random_rays(size_t count, uint64_t seed) {
  Random random(seed);
  std::vector<Query> rays;
  for (size_t i = 0; i < count; ++i) rays.push_back({random.point(5), random.direction()});
  return rays;
}

QueryHit brute_force(const Scene& scene, const Query& ray, QueryKind kind) {
  QueryHit nearest{HUGE_VAL, -1};
  for (size_t i = 0; i < scene.shapes.size(); ++i) {
    const Shape& shape = *scene.shapes[i];
    const auto hit = shape.intersect({ray.o, ray.d});
    if (!hit || hit->t >= std::min(nearest.t, ray.t_max)) continue;
    const bool opaque = scene.materials[size_t(shape.material)]->shadow_transmittance() == 0;
    if (kind == QueryKind::any && opaque) return {0, -1};
    if (kind == QueryKind::nearest) nearest = {hit->t, int64_t(i)};
  }
  return nearest;
}

bool same(const QueryHit& a, const QueryHit& b) {
  return a.primitive == b.primitive &&
         (std::isinf(a.t) ? std::isinf(b.t) : std::abs(a.t - b.t) <= 1e-4 * std::max(1.0, a.t));
}

}  // namespace

TEST_CASE("every way of querying Embree gives the hits of float64, except a few at edges") {
  const Scene scene = mixed_scene();
  const Embree embree(scene);
  CHECK(embree.bytes() > 1000);
  std::vector<Query> rays = random_rays(4999, 2);  // no whole number of packets
  for (size_t i = 0; i < rays.size(); i += 2) rays[i].t_max = 3;
  std::vector<QueryHit> hits(rays.size());
  for (const QueryKind kind : {QueryKind::nearest, QueryKind::any}) {
    for (const EmbreeCalls calls : all_calls) {
      CAPTURE(name(calls));
      const double seconds = embree.query(rays, kind, hits, calls, false);
      CHECK(seconds > 0);
      int different = 0, met = 0;
      for (size_t i = 0; i < rays.size(); ++i) {
        different += !same(brute_force(scene, rays[i], kind), hits[i]);
        met += !std::isinf(hits[i].t);
      }
      CHECK(different <= 5);
      CHECK(met > 1500);
      CHECK(met < 2500);
    }
  }
}

TEST_CASE("triangles of instances are numbered consecutively, after the shapes") {
  Scene scene = parse_scene(
      "[[material]]\nname = \"m\"\ntype = \"phong\"\n[[sphere]]\ncenter = [0, 9, 0]\nradius = 1\nmaterial = "
      "\"m\"\n",
      "instances");
  scene.meshes.push_back(octasphere(4));  // 128 triangles, three times
  scene.meshes.push_back(octasphere(3));  // 72, once
  for (int i = 0; i < 3; ++i) {
    Mat4 transform(1.0);
    transform[3] = Vec4(4.0 * i, 0, 0, 1);
    if (i == 1) transform[1] = Vec4(0, 2, 0, 0);  // twice as high
    scene.instances.push_back({.mesh = 0, .transform = transform, .material = 0, .position = {}});
  }
  Mat4 transform(1.0);
  transform[3] = Vec4(-4, 0, 0, 1);
  scene.instances.push_back({.mesh = 1, .transform = transform, .material = 0, .position = {}});

  const Embree embree(scene);
  const std::vector<Query> rays = {{{0.1, 0.1, 5}, {0, 0, -1}}, {{4.1, 5, 0.1}, {0, -1, 0}},
                                   {{8.1, 0.1, 5}, {0, 0, -1}}, {{-3.9, 0.1, 5}, {0, 0, -1}},
                                   {{0, 20, 0}, {0, -1, 0}},    {{2, 0, 5}, {0, 0, -1}}};
  std::vector<QueryHit> hits(rays.size());
  for (const EmbreeCalls calls : all_calls) {
    embree.query(rays, QueryKind::nearest, hits, calls, true);
    const auto within = [&](size_t ray, int64_t first, int64_t count) {
      return hits[ray].primitive >= first && hits[ray].primitive < first + count;
    };
    CHECK(within(0, 1, 128));
    CHECK(hits[0].t == doctest::Approx(4).epsilon(0.03));
    CHECK(within(1, 129, 128));
    CHECK(hits[1].t == doctest::Approx(3).epsilon(0.03));
    CHECK(within(2, 257, 128));
    CHECK(hits[2].primitive - 257 == hits[0].primitive - 1);
    CHECK(within(3, 385, 72));
    CHECK(hits[4].primitive == 0);
    CHECK(hits[5].primitive == -1);
    CHECK(std::isinf(hits[5].t));
  }
}
