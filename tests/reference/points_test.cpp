// The float64 half of `points`.
#include <cmath>

#include "host/reference/tracer.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/sphere_roots.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using test::Random;

namespace {

std::shared_ptr<PointCloud> some_cloud(Random& random, int count) {
  auto cloud = std::make_shared<PointCloud>();
  for (int i = 0; i < count; ++i) {
    cloud->positions.push_back(random.point(1));
    cloud->colors.emplace_back(float(i), 0.0f, 1.0f);
  }
  return cloud;
}

}  // namespace

TEST_CASE("the BVH of points finds the hits that testing every point finds") {
  for (const double radius : {0.003, 0.05, 0.5}) {
    Random random{7};
    const auto cloud = some_cloud(random, 2000);
    const auto points = shapes::make_points(cloud, radius);
    int hits = 0, wrong = 0;
    for (int k = 0; k < 4000; ++k) {
      const Vec3 target = random.point(1);
      const Vec3 from = target + random.direction() * random.log_uniform(0.1, 30);
      const Ray ray{from, target - from};
      double nearest = HUGE_VAL;
      size_t which = 0;
      for (size_t i = 0; i < cloud->positions.size(); ++i) {
        const auto roots = shapes::sphere_roots(cloud->positions[i], radius, ray);
        if (!roots) continue;
        const double t = roots->first > 0 ? roots->first : roots->second;
        if (t > 0 && t < nearest) nearest = t, which = i;
      }
      const auto hit = points->intersect(ray);
      hits += hit.has_value();
      wrong += hit.has_value() != (nearest < HUGE_VAL);
      if (!hit) continue;
      wrong += hit->part != which || std::fabs(hit->t - nearest) > 1e-12 * nearest;
      wrong += points->surface(ray, *hit).color != Vec3(double(which), 0, 1);
    }
    CHECK(hits > 20);
    CHECK(wrong == 0);
  }
}

TEST_CASE("of points at one position the first is hit") {
  auto cloud = std::make_shared<PointCloud>();
  cloud->positions.assign(50, Vec3(1, 2, 3));
  const auto points = shapes::make_points(cloud, 0.5);
  const auto hit = points->intersect({Vec3(1, 2, 8), Vec3(0, 0, -1)});
  REQUIRE(hit);
  CHECK(hit->t == 4.5);
  CHECK(hit->part == 0);
  CHECK(points->bounds().min == Vec3(0.5, 1.5, 2.5));
  CHECK(points->surface({Vec3(1, 2, 8), Vec3(0, 0, -1)}, *hit).position == Vec3(1, 2, 3.5));
}

TEST_CASE("points turn, move and grow with their transform") {
  auto cloud = std::make_shared<PointCloud>();
  cloud->positions = {Vec3(1, 2, 0)};
  const Mat4 turned{{0, 3, 0, 0}, {-3, 0, 0, 0}, {0, 0, 3, 0}, {100, -50, 7, 1}};
  const auto points = shapes::make_points(cloud, 0.5, turned);
  CHECK(points->bounds().min == Vec3(100 - 6 - 1.5, -50 + 3 - 1.5, 7 - 1.5));
  CHECK(points->bounds().max == Vec3(100 - 6 + 1.5, -50 + 3 + 1.5, 7 + 1.5));
}

TEST_CASE("points have no shape under a map that is no similarity, or out of range") {
  auto cloud = std::make_shared<PointCloud>();
  cloud->positions = {Vec3(1, 0, 0)};
  const auto scaled = [](const Vec3& s) {
    return Mat4{{s.x, 0, 0, 0}, {0, s.y, 0, 0}, {0, 0, s.z, 0}, {0, 0, 0, 1}};
  };
  CHECK(shapes::make_points(cloud, 1, scaled({-2, 2, 2})) != nullptr);
  CHECK(shapes::make_points(cloud, 1, scaled({2, 2, 3})) == nullptr);
  CHECK(shapes::make_points(cloud, 1, scaled(Vec3(1e12))) == nullptr);
  CHECK(shapes::make_points(cloud, 1e-6, scaled(Vec3(1e-9))) == nullptr);
}

TEST_CASE("a point with a normal is the disk of the definition") {
  Random random{9};
  int hits = 0, misses = 0;
  for (int k = 0; k < 4000; ++k) {
    auto cloud = std::make_shared<PointCloud>();
    const Vec3 center = random.point(3), normal = random.direction();
    cloud->positions = {center};
    cloud->normals = {glm::vec3(normal)};
    const double radius = random.log_uniform(0.01, 2);
    const auto points = shapes::make_points(cloud, radius);
    // A point of the plane, inside of the disk or outside of it, and a ray towards it from either side.
    const Vec3 across = glm::normalize(glm::cross(normal, random.direction()));
    const double share = random.uniform(0, 2);
    const Vec3 target = center + across * (share * radius);
    const Vec3 from = target + random.direction() * random.log_uniform(0.1, 30);
    const Ray ray{from, (target - from) * random.log_uniform(0.1, 10)};
    if (std::fabs(share - 1) < 1e-3 || std::fabs(glm::dot(glm::normalize(ray.d), normal)) < 0.01) continue;
    const auto hit = points->intersect(ray);
    CHECK(hit.has_value() == (share < 1));
    (hit ? hits : misses)++;
    if (!hit) continue;
    const Vec3 at = ray.o + ray.d * hit->t;
    CHECK(glm::length(at - target) < 1e-4);  // the normal is rounded to float32
    const SurfacePoint surface = points->surface(ray, *hit);
    CHECK(glm::length(surface.position - at) < 1e-12);
    CHECK(glm::length(surface.normal - normal) < 1e-6);
    // A ray that leaves to either side hits nothing.
    for (const double side : {-1.0, 1.0})
      CHECK_FALSE(points->intersect({surface.position + normal * (side * 1e-3), normal * side}));
  }
  CHECK(hits > 1000);
  CHECK(misses > 1000);
}

TEST_CASE("disks turn with their transform, and a point without a normal is a sphere") {
  auto cloud = std::make_shared<PointCloud>();
  cloud->positions = {Vec3(0, 0, 0), Vec3(10, 0, 0)};
  cloud->normals = {glm::vec3(1, 0, 0), glm::vec3(0)};
  const Mat4 turned{{0, 2, 0, 0}, {-2, 0, 0, 0}, {0, 0, 2, 0}, {0, 0, 7, 1}};  // x becomes y
  const auto points = shapes::make_points(cloud, 0.5, turned);
  const Ray down{Vec3(0.9, 5, 7), Vec3(0, -1, 0)};
  const auto hit = points->intersect(down);
  REQUIRE(hit);
  CHECK(hit->t == 5);
  CHECK(points->surface(down, *hit).normal == Vec3(0, 1, 0));
  CHECK_FALSE(points->intersect({Vec3(1.1, 5, 7), Vec3(0, -1, 0)}));
  CHECK_FALSE(points->intersect({Vec3(5, 0, 7), Vec3(-1, 0, 0)}));  // along the disk
  const auto sphere = points->intersect({Vec3(0, 30, 7), Vec3(0, -1, 0)});
  REQUIRE(sphere);
  CHECK(sphere->part == 1);
  CHECK(sphere->t == 9);
}
