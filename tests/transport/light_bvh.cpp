// The BVH by which one of many lights is chosen: its contents, and the probability of each light.
#include "host/scene/light_bvh.hpp"

#include <set>

#include "host/reference/light_pick.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/sampler.hpp"
#include "tests/support/estimate.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::test;
using executors::Backend;

namespace {

// Clusters of triangles, spots and point lights; some triangles shine to one side.
struct Lights {
  std::vector<LightBounds> bounds;
  std::vector<TriangleForm> triangles;  // triangles of the lights that are triangles

  Lights(Random& random, size_t count) {
    Vec3 heap(0);
    for (size_t i = 0; i < count; ++i) {
      if (i % 20 == 0) heap = random.point(5);
      const Vec3 a = heap + random.point(1);
      const TriangleForm form{{a, a + random.point(0.2), a + random.point(0.2)}};
      LightBounds light = bounds_of(form);
      if (i % 3 == 0) light.both_sides = false;
      if (i % 7 == 0) light = {.center = a, .axis = random.direction(), .spread = 0.2, .reach = 0.4};
      if (i % 11 == 0) light = {.center = a};
      light.power = std::pow(10.0, random.uniform(-3, 1));
      triangles.push_back(form);
      bounds.push_back(light);
    }
  }
};

LightChoice choice_of(std::span<const LightBounds> lights) {
  LightChoice choice{.emitters = {}, .ends = std::vector<uint32_t>(lights.size()), .bvh = light_bvh(lights)};
  return choice;
}

}  // namespace

TEST_CASE("each light with power is one leaf, at the end of its trail") {
  Random random(1);
  for (const size_t count : {2u, 3u, 17u, 1000u, 30'000u}) {
    Lights lights(random, count);
    lights.bounds[0].power = 0;
    if (count == 1000)
      for (LightBounds& light : lights.bounds) light.center = Vec3(1, 2, 3);
    const LightBvh bvh = light_bvh(lights.bounds);
    CHECK(bvh.trails[0] == LightBvh::no_trail);
    if (count == 2) {
      CHECK(bvh.nodes.empty());
      continue;
    }
    REQUIRE(bvh.nodes.size() == 2 * (count - 2));
    std::set<uint32_t> leaves;
    for (const LightBvh::Node& node : bvh.nodes)
      if (node.leaf) leaves.insert(node.child);
    CHECK(leaves.size() == count - 1);
    int lost = 0;
    for (uint32_t light = 1; light < count; ++light) {
      uint32_t pair = 0;
      for (int level = 0;; ++level) {
        if (level == LightBvh::deepest) {
          ++lost;
          break;
        }
        const LightBvh::Node& node = bvh.nodes[pair + (bvh.trails[light] >> level & 1)];
        if (node.leaf) {
          lost += node.child != light;
          break;
        }
        pair = node.child;
      }
    }
    CHECK(lost == 0);
  }
}

TEST_CASE("a node's sphere bounds its lights, its cone their normals, and its power is their sum") {
  Random random(2);
  const Lights lights(random, 500);
  const LightBvh bvh = light_bvh(lights.bounds);
  int outside = 0, beyond = 0, uncounted = 0;
  const auto visit = [&](auto& self, const LightBvh::Node& node) -> std::vector<uint32_t> {
    std::vector<uint32_t> below;
    if (node.leaf) {
      below.push_back(node.child);
    } else {
      for (uint32_t child = node.child; child < node.child + 2; ++child)
        for (const uint32_t light : self(self, bvh.nodes[child])) below.push_back(light);
    }
    double power = 0;
    for (const uint32_t i : below) {
      const LightBounds& light = lights.bounds[i];
      power += light.power;
      outside += glm::length(light.center - node.bounds.center) + light.radius > node.bounds.radius + 1e-9;
      double apart = std::acos(std::clamp(glm::dot(light.axis, node.bounds.axis), -1.0, 1.0));
      if (light.both_sides && node.bounds.both_sides) apart = std::min(apart, M_PI - apart);
      beyond += std::min(M_PI, apart + light.spread) > node.bounds.spread + 1e-6 ||
                light.reach > node.bounds.reach || (light.both_sides && !node.bounds.both_sides);
    }
    uncounted += std::abs(power / node.bounds.power - 1) > 1e-9;
    return below;
  };
  visit(visit, bvh.nodes[0]);
  visit(visit, bvh.nodes[1]);
  CHECK(outside == 0);
  CHECK(beyond == 0);
  CHECK(uncounted == 0);
}

TEST_CASE("a light that may reach a point has importance there, as have all nodes above it") {
  Random random(3);
  int forgotten = 0, lit = 0;
  for (int scene = 0; scene < 40; ++scene) {
    const Lights lights(random, 60);
    const LightChoice choice = choice_of(lights.bounds);
    for (int i = 0; i < 400; ++i) {
      const reference::LitPoint point{random.point(7), random.direction()};
      const auto light = size_t(random.below(60));
      const LightBounds& bounds = lights.bounds[light];
      // A point of the light, and whether the light shines here.
      Vec3 position = bounds.center;
      if (bounds.radius > 0) {
        const auto& [a, b, c] = lights.triangles[light].vertices;
        const double root = std::sqrt(random.uniform(0, 1)), v = random.uniform(0, 1);
        position = (1 - root) * a + root * (1 - v) * b + root * v * c;
      }
      const Vec3 way = glm::normalize(point.position - position);
      double cosine = glm::dot(way, bounds.axis);
      if (bounds.both_sides) cosine = std::abs(cosine);
      const bool shines = bounds.spread == M_PI || cosine > std::cos(bounds.spread + bounds.reach);
      if (!shines || !(glm::dot(way, *point.normal) < 0)) continue;
      ++lit;
      forgotten += !(reference::light_share(choice, point, light) > 0);
    }
  }
  CHECK(lit > 2000);
  CHECK(forgotten == 0);
}

TEST_CASE("lights are picked as often as their shares") {
  Random random(4);
  const Lights lights(random, 40);
  const LightChoice choice = choice_of(lights.bounds);
  for (int i = 0; i < 5; ++i) {
    const reference::LitPoint point{random.point(6), random.direction()};
    std::vector<int> picked(lights.bounds.size());
    constexpr int count = 100'000;
    int none = 0, wrong = 0;
    for (int k = 0; k < count; ++k) {
      const auto pick = reference::pick_light(choice, point, double(random.below(1 << 24)) * 0x1p-24);
      if (!pick) {
        ++none;
        continue;
      }
      ++picked[pick->light];
      wrong += std::abs(reference::light_share(choice, point, pick->light) / pick->share - 1) > 1e-9;
    }
    CHECK(wrong == 0);
    double sum = double(none) / count;
    for (size_t light = 0; light < picked.size(); ++light) {
      const double share = reference::light_share(choice, point, light);
      sum += share;
      CHECK(std::abs(picked[light] - count * share) < 5 * std::sqrt(count * share) + 1);
    }
    CHECK(sum == doctest::Approx(1).epsilon(0.01));
  }
}

TEST_CASE("the picture is the same, however lights are chosen") {
  const auto heap = [](LightSampler sampler) {
    Scene scene = one_pixel({0.4, 0.9, 0.5}, {0, 0, 0});
    scene.image = {.width = 8, .height = 8, .samples = 512, .pattern = SamplePattern::sobol};
    scene.camera.projection = cameras::make_projection(PerspectiveCamera{.fov_degrees = 1e-3});
    scene.render.integrator = IntegratorType::path;
    scene.render.max_depth = 0;
    scene.render.light_sampler = sampler;
    add(scene, make_plane({0, 0, 0}, {0, 1, 0}), add(scene, make_phong({.diffuse = gray(0.8)})));
    const int emissive = add(scene, make_phong({.diffuse = gray(0), .emission = gray(2)}));
    const int front = add(scene, make_phong({.diffuse = gray(0), .emission = gray(3)}));
    scene.materials[size_t(front)]->emits_in_front = true;
    Random random(5);
    const auto somewhere = [&] { return random.point(1.5) + Vec3(0, 1.8, 0); };
    for (int i = 0; i < 10; ++i) add(scene, make_sphere(somewhere(), 0.05), emissive);
    for (int i = 0; i < 10; ++i) {
      const Vec3 at = somewhere();
      add(scene, make_box(at, at + Vec3(0.1, 0.2, 0.1)), emissive);
    }
    for (int i = 0; i < 10; ++i) {
      const Vec3 at = somewhere();
      add(scene, make_disk(at, random.direction(), 0.1), front);
    }
    add_point_light(scene, {0.5, 1.5, 0.2}, Vec3(0.02), Falloff::inverse_square);
    add_spot(scene, {{-0.5, 1.2, 0.2}, glm::normalize(Vec3(0.2, -1, 0)), Vec3(0.02), 0.2, 0.6});
    add_sun(scene, {1, 1, 0}, Vec3(0.01));
    return scene;
  };
  for (const Backend backend : {Backend::twin, Backend::reference}) {
    const Estimate by_power = estimate(heap(LightSampler::power), backend);
    for (const LightSampler sampler : {LightSampler::uniform, LightSampler::bvh}) {
      const Estimate other = estimate(heap(sampler), backend);
      CAPTURE(int(backend));
      CAPTURE(int(sampler));
      CAPTURE(by_power.mean);
      CAPTURE(other.mean);
      CHECK(other.error < greatest_error() * other.mean);
      CHECK(by_power.error < greatest_error() * by_power.mean);
      CHECK(std::abs(other.mean - by_power.mean) < 5 * std::hypot(other.error, by_power.error));
    }
  }
}
