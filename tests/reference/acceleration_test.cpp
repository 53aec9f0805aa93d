// The reference's BVH finds the same hit as testing every shape, to the last bit.
#include <fmt/format.h>

#include <bit>

#include "tests/support/empty_scene.hpp"
#include "tests/support/meshes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::test;

namespace {

// A mesh of triangles whose boxes are difficult: flat ones, needles, coplanar ones, duplicates, of all sizes.
Mesh hard_mesh(Dice& dice, double size) {
  Mesh mesh;
  const Vec3 center = dice.in_box(1) * size * dice.scale(-3, 3);
  const int count = int(dice.between(1, 40));
  const double grid = dice.between(0, 1) < 0.5 ? size / 4 : 0;
  const auto point = [&](const Vec3& at, double reach) {
    Vec3 p = at + reach * dice.in_box(1);
    if (grid > 0) p = glm::round(p / grid) * grid;  // so that corners, planes and boxes coincide
    return p;
  };
  for (int i = 0; i < count; ++i) {
    Corners v;
    const int kind = int(dice.between(0, 6));
    const Vec3 at = point(center, size);
    const double reach = size * dice.scale(-2, 0);
    for (Vec3& corner : v) corner = point(at, reach);
    if (kind == 0) v[1].y = v[2].y = v[0].y;  // flat, in an axis' plane
    if (kind == 1)
      v[2] = glm::mix(v[0], v[1], 0.4) + reach * dice.scale(-9, -7) * dice.in_box(1);  // a needle
    if (kind == 2 && i > 0) v = corners(mesh, size_t(dice.between(0, i)));             // a duplicate
    if (kind == 3 && i > 0) {                                                          // coplanar
      const Corners other = corners(mesh, size_t(dice.between(0, i)));
      v = {other[0], other[1], other[1] + 2.0 * (other[2] - other[0])};
    }
    if (thickness(v) < thinnest_triangle) v = {at, at + Vec3(size, 0, 0), at + Vec3(0, 0, size)};
    const auto first = uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), v.begin(), v.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

struct HardScene {
  Scene scene = test::empty_scene();
  std::vector<Corners> triangles;  // in the world, of shapes and of instances

  const Corners& some(Dice& dice) const {
    return triangles[size_t(dice.between(0, double(triangles.size())))];
  }
};

// Meshes, shared by instances that are moved, sheared, mirrored and repeated, and shapes between them.
HardScene hard_scene(Dice& dice) {
  HardScene result;
  Scene& scene = result.scene;
  const auto keep = [&](const Mesh& mesh, const Mat4& map) {
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
      Corners v = corners(mesh, i);
      for (Vec3& corner : v) corner = Affine(map).point(corner);
      result.triangles.push_back(v);
    }
  };
  const double size = dice.scale(-6, 6);
  const int opaque = add(scene, make_phong({}));
  const int glass = add(scene, make_dielectric({.shadow = 0.7}));
  const auto material = [&] { return dice.between(0, 4) < 1 ? opaque : glass; };
  for (int i = int(dice.between(0, 6)); i > 0; --i)
    add(scene, make_sphere(size * dice.in_box(2), size * dice.scale(-3, 0)), material());
  if (dice.between(0, 1) < 0.3) add(scene, make_plane(size * dice.in_box(1), {0, 1, 0}), material());
  for (int i = int(dice.between(0, 4)); i > 0; --i) {
    const Mesh mesh = hard_mesh(dice, size);
    add_triangles(scene, mesh, material());
    keep(mesh, Mat4(1.0));
  }
  for (int i = int(dice.between(0, 3)); i >= 0; --i) {
    const int mesh = add(scene, hard_mesh(dice, size));
    for (int k = int(dice.between(0, 4)); k >= 0; --k) {
      const bool repeat = dice.between(0, 3) < 1 && !scene.instances.empty();
      const Mat4 map = repeat ? scene.instances.back().transform
                              : random_map(dice, dice.between(0, 1), dice.between(0, 2) < 1 ? 0 : size);
      add_instance(scene, mesh, material(), map);
      keep(scene.meshes.back(), map);
    }
  }
  if (dice.between(0, 2) < 1) {
    // Adds a group of spheres and a mesh, shown more than once.
    Group& group = scene.groups.emplace_back();
    for (int i = int(dice.between(0, 4)); i > 0; --i) {
      group.shapes.push_back(make_sphere(size * dice.in_box(2), size * dice.scale(-3, 0)));
      group.shapes.back()->material = material();
    }
    const int mesh = add(scene, hard_mesh(dice, size));
    const Mat4 in_group = random_map(dice, dice.between(0, 1), size);
    group.instances.push_back({mesh, in_group, material(), {}});
    for (int k = int(dice.between(0, 3)); k >= 0; --k) {
      const bool repeat = dice.between(0, 3) < 1 && !scene.group_instances.empty();
      const Mat4 map = repeat ? scene.group_instances.back().transform
                              : random_map(dice, dice.between(0, 1), dice.between(0, 2) < 1 ? 0 : size);
      scene.group_instances.push_back({0, map, scene.shapes.size(), scene.instances.size(), {}});
      keep(scene.meshes.back(), map * in_group);
    }
  }
  return result;
}

Vec3 at(const Corners& v, double u, double w) {
  return v[0] + u * (v[1] - v[0]) + w * (v[2] - v[0]);
}

// A point of a random triangle: inside, on an edge, or a corner.
Vec3 some_point(const HardScene& scene, Dice& dice) {
  const double u = dice.between(0, 2) < 1 ? 0 : dice.between(0, 1);
  const double w = dice.between(0, 2) < 1 ? 0 : dice.between(0, 1 - u);
  return at(scene.some(dice), u, w);
}

// A ray from anywhere or from one triangle to another, along an axis, or exactly in the plane of a triangle.
Ray some_ray(const HardScene& scene, Dice& dice) {
  const Vec3 target = some_point(scene, dice);
  switch (int(dice.between(0, 4))) {
    case 0: {
      const Vec3 origin = some_point(scene, dice);
      return {origin, target - origin};
    }
    case 1:
      return {target - Vec3(0, 0, dice.scale(-2, 3)), {0, 0, 1}};
    case 2: {
      const Corners& v = scene.some(dice);
      const Vec3 origin = at(v, dice.between(-3, 4), dice.between(-3, 4));
      return {origin, at(v, dice.between(-3, 4), dice.between(-3, 4)) - origin};
    }
    default: {
      const Vec3 from_origin = dice.scale(-2, 7) * dice.direction();
      return {target - from_origin, from_origin};
    }
  }
}

bool same_bits(double a, double b) {
  return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b);
}

bool same(const std::optional<reference::Hit>& a, const std::optional<reference::Hit>& b) {
  if (!a || !b) return !a == !b;
  return a->primitive == b->primitive && a->material == b->material && same_bits(a->at.t, b->at.t) &&
         same_bits(a->at.u, b->at.u) && same_bits(a->at.v, b->at.v);
}

// The nearest hit by its definition, without any boxes.
std::optional<Intersection> plain_search(const Scene& scene, const Ray& ray) {
  std::optional<Intersection> nearest;
  const auto offer = [&](const std::optional<Intersection>& hit) {
    if (hit && (!nearest || hit->t < nearest->t)) nearest = hit;
  };
  const auto offer_mesh = [&](const Instance& instance, const Ray& from) {
    const Affine map(instance.transform);
    const Ray in_mesh{(from.o - map.offset) * map.cotangent, from.d * map.cotangent};
    const Mesh& mesh = scene.meshes[size_t(instance.mesh)];
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
      offer(intersect_triangle(corners(mesh, i), geometric_normal(corners(mesh, i)), in_mesh));
  };
  for (const auto& shape : scene.shapes) offer(shape->intersect(ray));
  for (const Instance& instance : scene.instances) offer_mesh(instance, ray);
  for (const GroupInstance& copy : scene.group_instances) {
    const Affine map(copy.transform);
    const Ray in_group{(ray.o - map.offset) * map.cotangent, ray.d * map.cotangent};
    const Group& group = scene.groups[size_t(copy.group)];
    for (const auto& shape : group.shapes) offer(shape->intersect(in_group));
    for (const Instance& instance : group.instances) offer_mesh(instance, in_group);
  }
  return nearest;
}

}  // namespace

TEST_CASE("10 000 hard scenes: the BVH finds what brute force finds, to the last bit" *
          doctest::test_suite("long")) {
  Dice dice;
  int rays = 0, hits = 0, different = 0, different_light = 0, dimmed = 0, beside_boxes = 0;
  for (int i = 0; i < 10000; ++i) {
    const HardScene hard = hard_scene(dice);
    const Scene& scene = hard.scene;
    const reference::Tracer bvh(scene, Acceleration::bvh);
    const reference::Tracer brute(scene, Acceleration::brute_force);
    for (int k = 0; k < 24; ++k) {
      const Ray ray = some_ray(hard, dice);
      if (ray.d == Vec3(0)) continue;
      ++rays;
      const auto hit = bvh.trace(ray);
      const auto expected = brute.trace(ray);
      different += !same(hit, expected);
      hits += hit.has_value();
      const auto plain = plain_search(scene, ray);
      beside_boxes +=
          plain.has_value() != hit.has_value() || (hit && plain && !same_bits(plain->t, hit->at.t));

      const double t_end = dice.between(0, 3) < 1 ? std::numeric_limits<double>::infinity() : 1.0;
      uint32_t flags = 0;
      const double light = bvh.transmittance(ray, t_end, flags);
      different_light += !same_bits(light, brute.transmittance(ray, t_end, flags));
      dimmed += light > 0 && light < 1;
    }
  }
  MESSAGE(fmt::format("{} rays, {} hits, {} dimmed; {} of a plain search are beside the boxes", rays, hits,
                      dimmed, beside_boxes));
  CHECK(hits > 100'000);
  CHECK(dimmed > 20'000);
  CHECK(different == 0);
  CHECK(different_light == 0);
  CHECK(beside_boxes < rays / 1000);
}
