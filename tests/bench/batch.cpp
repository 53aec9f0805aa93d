#include "benchmarks/bench/batch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "benchmarks/contenders/embree.hpp"
#include "host/generate/octasphere.hpp"
#include "host/loader/scene_file.hpp"
#include "host/reference/tracer.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::generate;
using namespace eyeray::engine::contenders;
using namespace eyeray::engine::bench;

namespace {

constexpr const char* scene_text = R"([camera]
eye = [0, 0, 5]
target = [0, 0, 0]
fov = 40
[[light]]
type = "point"
position = [5, 5, 5]
[[material]]
name = "m"
type = "phong"
[[sphere]]
center = [0, 0, 0]
radius = 1
material = "m"
)";

// The sphere of the scene, as a shape or as a mesh.
Scene sphere(bool as_mesh) {
  Scene scene = parse_scene(scene_text, "sphere");
  if (!as_mesh) return scene;
  scene.shapes.clear();
  scene.meshes.push_back(octasphere(20));
  scene.instances.push_back({.mesh = 0, .material = 0, .position = {}});
  return scene;
}

std::vector<SurfacePosition> spawned_from(const Scene& scene, const Batch& primary) {
  const Embree embree(scene);
  std::vector<QueryHit> hits(primary.rays.size());
  embree.query(primary.rays, QueryKind::nearest, hits, EmbreeCalls::one, true);
  return surface_positions(scene, primary.rays, hits);
}

}  // namespace

TEST_CASE("primary rays go block by block through the pixels' centres") {
  const Scene scene = sphere(false);
  const Batch batch = primary_batch(scene, 20, 12);
  REQUIRE(batch.rays.size() == 240);
  CHECK(batch.kind == QueryKind::nearest);
  // The point where a ray crosses the picture, in pixels.
  const auto pixel = [&](size_t i) {
    const Vec3 d = batch.rays[i].d / -batch.rays[i].d.z / std::tan(glm::radians(20.0));
    return Vec2((d.x + 1) * 10 - 0.5, (12.0 / 20 - d.y) * 10 - 0.5);
  };
  const std::pair<size_t, Vec2> expected_pixels[] = {
      {0, {0, 0}},    {7, {7, 0}},    {8, {0, 1}},    {63, {7, 7}},  {64, {8, 0}},
      {128, {16, 0}}, {131, {19, 0}}, {132, {16, 1}}, {160, {0, 8}}, {239, {19, 11}}};
  for (const auto& [i, expected] : expected_pixels) {
    CHECK(glm::distance(pixel(i), expected) < 1e-9);
  }
}

TEST_CASE("rays leave instanced groups where they leave copies; Embree refuses such groups") {
  const auto grouped = [](const char* groups) {
    Scene scene = parse_scene(fmt::format(R"([render]
groups = "{}"
[[material]]
name = "m"
type = "phong"
[[sphere]]
center = [-1.6, 0, 0]
radius = 0.4
material = "m"
[[group]]
batch = {{ transform = [[], [{{ scale = [-1, 2, 1] }}, {{ translate = [1, 0.5, 0] }}]] }}
[[group.box]]
min = [-0.4, -0.4, -0.4]
max = [0.3, 0.4, 0.4]
material = "m"
[[group.ellipsoid]]
center = [0, 0.8, 0]
radii = [0.3, 0.2, 0.3]
material = "m"
)",
                                          groups),
                              "groups");
    // Adds instances of a mesh as the loader would: one in the scene itself, and two in the group.
    scene.meshes.push_back(octasphere(4));
    const auto at = [](double x, double y) {
      return Mat4({0.3, 0, 0, 0}, {0, 0.3, 0, 0}, {0, 0, 0.3, 0}, {x, y, 0, 1});
    };
    const auto mesh = [&](const Mat4& map) { return Instance{.mesh = 0, .transform = map, .position = {}}; };
    scene.instances.push_back(mesh(at(-1.6, 1)));
    const std::vector<Instance> members = {mesh(at(0, -0.8)), mesh(at(0, -1.5))};
    for (GroupInstance& instance : scene.group_instances) instance.instances_before = 1;
    if (!scene.groups.empty()) {
      scene.groups[0].instances = members;
    } else {
      Mat4 second(1.0);
      second[0].x = -1;
      second[1].y = 2;
      second[3] = {1, 0.5, 0, 1};
      for (const Mat4& map : {Mat4(1.0), second})
        for (const Instance& member : members) scene.instances.push_back(mesh(map * member.transform));
    }
    return scene;
  };
  const Scene once = grouped("instanced"), flat = grouped("flat");
  REQUIRE(once.group_instances.size() == 2);
  const Batch primary = primary_batch(flat, 96, 72);
  std::set<int64_t> met;
  const auto leaving = [&](const Scene& scene) {
    const reference::Tracer tracer(scene);
    std::vector<QueryHit> hits(primary.rays.size());
    for (size_t i = 0; i < hits.size(); ++i) {
      const auto hit = tracer.trace({primary.rays[i].o, primary.rays[i].d});
      if (!hit) continue;
      hits[i] = {hit->at.t, int64_t(hit->primitive)};
      met.insert(hits[i].primitive);
    }
    return surface_positions(scene, primary.rays, hits);
  };
  const std::vector<SurfacePosition> a = leaving(once), b = leaving(flat);
  REQUIRE(a.size() == b.size());
  CHECK(met.size() > 150);
  double apart = 0;
  for (size_t i = 0; i < a.size(); ++i)
    apart = std::max(
        {apart, glm::distance(a[i].position, b[i].position), glm::distance(a[i].normal, b[i].normal)});
  CHECK(apart < 1e-6);
  CHECK_THROWS_WITH_AS(Embree{once}, doctest::Contains("-D render.groups=flat"), Error);
}

TEST_CASE("rays leave surfaces outward, and shadow rays end at the light") {
  for (const bool as_mesh : {false, true}) {
    const Scene scene = sphere(as_mesh);
    const Batch primary = primary_batch(scene, 64, 64);
    const std::vector<SurfacePosition> from = spawned_from(scene, primary);
    CHECK(from.size() > 500);
    CHECK(from.size() < 4096);
    for (const SurfacePosition& each : from) {
      CHECK(glm::length(each.position) > (as_mesh ? 0.99 : 1.0));
      CHECK(glm::length(each.position) < 1.0001);
      CHECK(glm::dot(each.normal, each.position) > 0.9);
      CHECK(glm::dot(each.normal, primary.rays[each.ray].d) < 0);
    }
    const Batch shadow = shadow_batch(scene, from);
    CHECK(shadow.kind == QueryKind::any);
    CHECK(shadow.rays.size() > from.size() / 2);
    CHECK(shadow.rays.size() < from.size());
    for (const Query& ray : shadow.rays) {
      CHECK(glm::length(ray.d) == doctest::Approx(1).epsilon(1e-14));
      CHECK(glm::distance(ray.o + ray.t_max * ray.d, Vec3(5.0)) < 1e-12);
    }

    // A convex body never blocks the rays that leave it.
    const Embree embree(scene);
    for (const Batch& batch : {shadow, bounce_batch(from, 0)}) {
      std::vector<QueryHit> hits(batch.rays.size());
      embree.query(batch.rays, batch.kind, hits, EmbreeCalls::one, false);
      int met = 0;
      for (const QueryHit& hit : hits) met += !std::isinf(hit.t);
      CHECK(met == 0);
    }
  }
}

TEST_CASE("bounces follow the cosine distribution, and the same seed gives the same bounces") {
  const std::vector<SurfacePosition> from = [] {
    std::vector<SurfacePosition> made;
    for (uint32_t i = 0; i < 100'000; ++i) made.push_back({i, Vec3(0.0), glm::normalize(Vec3(1, 2, 3))});
    return made;
  }();
  const Batch batch = bounce_batch(from, 7);
  double sum = 0, squares = 0;
  Vec3 mean(0.0);
  for (const Query& ray : batch.rays) {
    const double cosine = glm::dot(ray.d, from[0].normal);
    CHECK(cosine > 0);
    sum += cosine;
    squares += cosine * cosine;
    mean += ray.d;
  }
  const double n = double(from.size());
  CHECK(sum / n == doctest::Approx(2.0 / 3).epsilon(0.005));
  CHECK(squares / n == doctest::Approx(0.5).epsilon(0.005));
  CHECK(glm::distance(mean / n, 2.0 / 3 * from[0].normal) < 0.01);
  CHECK(bounce_batch(from, 7).rays[99].d == batch.rays[99].d);
  CHECK(bounce_batch(from, 8).rays[99].d != batch.rays[99].d);
}
