#include "host/reference/crossings.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/triangle.hpp"
#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::test;

namespace {

struct Count {
  int spawned = 0;
  int rehits = 0;
};

// Shoots a ray at `shape`, and spawns others at the hit. A ray that leaves a surface must not hit that
// surface again at once: neither the shape nor a copy of it.
void spawn(const Shape& shape, const Shape& copy, const Ray& ray, double size, Dice& dice, Count& count) {
  const auto hit = shape.intersect(ray);
  if (!hit) return;
  const SurfacePoint point = shape.surface(ray, *hit);
  for (int i = 0; i < 4; ++i) {
    const Vec3 d = dice.direction();
    const Ray next{reference::spawn_origin(point, d), d};
    // A chord of a sphere is short at grazing angles, and is no re-hit.
    const double grazing = std::abs(glm::dot(d, point.normal_geometric));
    for (const Shape* again : {&shape, &copy}) {
      const auto hit_again = again->intersect(next);
      ++count.spawned;
      count.rehits += hit_again && hit_again->t < size * std::min(1e-2, grazing);
    }
  }
}

}  // namespace

TEST_CASE("a ray that leaves a surface does not hit it again") {
  Dice dice;
  Count spheres, planes, triangles, needles, cones, boxes;
  for (int i = 0; i < 30000; ++i) {
    const double size = dice.scale(-4, 4);
    const Vec3 center = dice.in_box(dice.scale(-4, 4));
    const Vec3 eye = center + dice.direction() * size * dice.scale(-1, 2);

    const auto sphere = make_sphere(center, size);
    const Vec3 n = dice.direction();
    spawn(*sphere, *make_sphere(center, size), {eye, center + size * n - eye}, size, dice, spheres);

    const auto plane = make_plane(center, n);
    spawn(*plane, *make_plane(center, 3.0 * n), {eye, dice.direction()}, size, dice, planes);

    // The copy is the same triangle, turned over.
    const Vec3 a = center + size * dice.direction();
    const Vec3 b = center + size * dice.direction();
    const Vec3 c = center + size * dice.direction();
    const auto triangle = make_triangle({.vertices = {a, b, c}});
    spawn(*triangle, *make_triangle({.vertices = {a, c, b}}), {eye, (a + b + c) / 3.0 - eye}, size, dice,
          triangles);

    // The cone and the box stand for all shapes in object space. From the apex and the edges, rays may hit
    // them again close by.
    Mat4 map = glm::translate(Mat4(1.0), center);
    for (int axis = 0; axis < 3; ++axis) map[axis] = Vec4(size * dice.direction(), 0);
    if (why_singular(map).empty()) {
      const auto cone = make_cone({0, -1, 0}, {0, 1, 0}, 1, 0.5, false, map);
      spawn(*cone, *make_cone({0, -1, 0}, {0, 1, 0}, 1, 0.5, true, map), {eye, center - eye}, 1e-4 * size,
            dice, cones);
      const auto box = make_box(Vec3(-1), Vec3(1), map);
      spawn(*box, *make_box(Vec3(-1), Vec3(1), map), {eye, center - eye}, 1e-4 * size, dice, boxes);
    }

    // A needle's normal is so imprecise that the reversed needle would be another one, so the copy is not
    // reversed.
    const Corners needle{
        a, b, glm::mix(a, b, dice.between(-1, 2)) + size * dice.scale(-8, -2) * c / glm::length(c)};
    if (thickness(needle) < thinnest_triangle) continue;
    const auto thin = make_triangle({.vertices = needle});
    spawn(*thin, *make_triangle({.vertices = needle}), {eye, (needle[0] + needle[1] + needle[2]) / 3.0 - eye},
          size, dice, needles);
  }
  const auto check = [](const std::string& name, const Count& count) {
    MESSAGE(name << ": " << count.rehits << " re-hits in " << count.spawned << " spawned");
    CHECK(count.spawned > 100000);
    CHECK(count.rehits == 0);
  };
  check("sphere", spheres);
  check("plane", planes);
  check("cone", cones);
  check("box", boxes);
  check("triangle", triangles);
  check("needle", needles);
}

TEST_CASE("a ray crosses each of its surfaces once, in order") {
  Dice dice;
  for (int i = 0; i < 10000; ++i) {
    const double radius = dice.scale(-4, 4);
    const Vec3 center = dice.in_box(100);
    const auto sphere = make_sphere(center, radius);
    const Vec3 eye = center + dice.direction() * 3.0 * radius;
    const Vec3 d = glm::normalize(center + 0.99 * radius * dice.direction() - eye);
    std::vector<double> crossings;
    reference::for_each_crossing(*sphere, {eye, d}, [&](double t, const auto&, const SurfacePoint&) {
      crossings.push_back(t);
      return true;
    });
    REQUIRE(crossings.size() == 2);
    const double middle = glm::dot(center - eye, d);
    const double half =
        std::sqrt(radius * radius - glm::dot(center - eye - middle * d, center - eye - middle * d));
    CHECK(near(crossings[0], middle - half, 1e-9 * (radius + 1)));
    CHECK(near(crossings[1], middle + half, 1e-9 * (radius + 1)));
  }
}

TEST_CASE("the lowest primitive wins among equal hits") {
  Scene scene = one_pixel({0, 0, 5}, {0, 0, 0});
  const int paint = add(scene, make_phong({}));
  add(scene, make_sphere({0, 0, -3}, 1), paint);
  for (int i = 0; i < 3; ++i) add(scene, make_sphere({0, 0, 0}, 1), paint);
  const FirstHit hit = reference::Renderer(scene).first_hit(0, 0);
  CHECK(hit.primitive == 1);
  CHECK(hit.t == 4);
  CHECK(hit.position == Vec3(0, 0, 1));
  CHECK(hit.material == paint);

  scene.camera.target = {0, 9, 5};
  CHECK(reference::Renderer(scene).first_hit(0, 0).primitive == -1);
}

TEST_CASE("a surface that float32 cannot distinguish from the nearest one is coincident with it") {
  const auto coincident = [](double behind) {
    Scene scene = one_pixel({0, 0, 5}, {0, 0, 0});
    const int paint = add(scene, make_phong({}));
    add(scene, make_sphere({0, 0, 0}, 1), paint);
    add(scene, make_sphere({0, 0, -behind}, 1), paint);
    return reference::Renderer(scene).first_hit(0, 0, {0, 0}, {.coincident = true});
  };
  for (const double behind : {1e-10, 1e-8, 1e-6}) {
    const FirstHit hit = coincident(behind);
    CHECK(hit.primitive == 1);
    CHECK(near(hit.t, 4 + behind, 1e-12));
  }
  CHECK(coincident(-1e-8).primitive == 0);
  CHECK(coincident(-1e-4).primitive == 1);
  CHECK(coincident(1e-4).primitive == 0);
}

TEST_CASE("crossings end, whatever a shape returns") {
  // A shape that is hit again and again: after each `step` along the ray, or at one point that no step gets
  // away from.
  struct Endless {
    double step;
    std::optional<Intersection> intersect(const Ray&) const { return Intersection{step}; }
    SurfacePoint surface(const Ray& ray, const Intersection& hit) const {
      return {ray.o + hit.t * ray.d, 0, -ray.d, -ray.d, {}};
    }
  };
  const auto count = [](double step) {
    int crossings = 0;
    reference::for_each_crossing(Endless{step}, {{1, 0, 0}, {1, 0, 0}},
                                 [&](double, const auto&, const SurfacePoint&) {
                                   ++crossings;
                                   return true;
                                 });
    return crossings;
  };
  CHECK(count(0.5) == reference::most_crossings);
  CHECK(count(1e-300) == 1);
}
