// Scenes and rays that are hard on BVHs: boxes without extent, needles, duplicates, ties, and rays that only
// just touch.
#pragma once

#include <numbers>

#include "host/reference/media.hpp"
#include "ray_targets.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/random_scene.hpp"

namespace eyeray::engine::test {

class HardScene {
 public:
  explicit HardScene(uint64_t seed) : random_(seed) { build(); }

  const Scene& scene() const { return scene_; }

  // Rays that start at any kind of point and go towards critical points. The scene's eye is the records'
  // origin.
  std::vector<shader::QueryRay> rays(size_t count) {
    std::vector<shader::QueryRay> rays(count);
    for (shader::QueryRay& ray : rays) ray = some_ray();
    return rays;
  }

 private:
  bool coin(double share) { return random_.uniform() < share; }
  size_t index(size_t count) { return size_t(random_.below(int(count))); }

  void build() {
    size_ = coin(0.5) ? 1 : random_.log_uniform(1e-5, 1e5);
    apart_ = coin(0.15) ? random_.direction() * size_ * random_.log_uniform(1e5, 1e7) : Vec3(0);
    center_ = coin(0.5) ? Vec3(0) : random_.direction() * size_ * random_.log_uniform(1, 1e4);
    grid_ = coin(0.4) ? size_ / 4 : 0;
    scene_.camera.eye = coin(0.5) ? Vec3(0) : center_ + random_.point(2) * size_;
    scene_.camera.target = scene_.camera.eye + Vec3(0, 0, -1);
    if (coin(0.2)) scene_.render.triangle_method = TriangleMethod::moller_trumbore;
    add(scene_, materials::make_phong({}));
    add(scene_, materials::make_dielectric({.shadow = 0.7}));
    glass_ = coin(0.5) ? 0.5 : 0;
    const int kind = random_.below(12);
    if (kind == 0) {
      add_single();
    } else if (kind == 1) {
      add_nest();
    } else {
      add_spheres(random_.below(8));
      if (coin(0.3)) add(scene_, shapes::make_plane(point(center_, size_), random_.direction()), material());
      if (coin(0.4)) add_object_shapes(1 + random_.below(4));
      if (coin(0.25)) add_csg_objects(1 + random_.below(4));
      if (coin(0.7)) add_shapes(hard_triangles(1 + random_.below(20)));
      if (coin(0.3)) add_polygons(1 + random_.below(5));
      if (coin(0.6)) add_instances(1);
      if (coin(0.6)) add_instances(2 + random_.below(4));
      if (scene_.shapes.empty() && scene_.instances.empty()) add_single();
    }
    if (coin(0.4)) add_groups(1 + random_.below(4));
    sort_shapes();
    // If more media are around the eye than a ray can carry, everything becomes opaque.
    if (reference::media_at(scene_, scene_.camera.eye).size() > 4) {
      const auto erase_csg_objects = [](auto& shapes) {
        std::erase_if(shapes, [](const auto& shape) { return is_csg(*shape); });
      };
      erase_csg_objects(scene_.shapes);
      for (const auto& shape : scene_.shapes) shape->material = 0;
      for (Instance& instance : scene_.instances) instance.material = 0;
      for (Group& group : scene_.groups) {
        erase_csg_objects(group.shapes);
        for (const auto& shape : group.shapes) shape->material = 0;
        for (Instance& instance : group.instances) instance.material = 0;
      }
    }
    targets_ = ray_targets(scene_, random_);
  }

  // Sorts the shapes into the order of the registry.
  void sort_shapes() {
    std::ranges::stable_sort(scene_.shapes, {}, [](const std::unique_ptr<Shape>& shape) {
      records::Packer packer(Vec3(0));
      shape->pack(packer);
      return kind_of(packer.scene.primitives[0]);
    });
  }

  static bool is_csg(const Shape& shape) { return std::holds_alternative<CsgForm>(shape.form()); }

  int material() { return coin(glass_) ? 1 : 0; }

  Vec3 point(const Vec3& at, double reach) {
    const Vec3 p = at + random_.point(1) * reach + (reach == size_ && coin(0.5) ? apart_ : Vec3(0));
    return grid_ > 0 ? glm::round(p / grid_) * grid_ : p;
  }

  // A mesh of triangles of every bad kind.
  Mesh hard_triangles(int count) {
    Mesh mesh;
    const bool at_one_point = coin(0.05);
    const Vec3 only = point(center_, size_);
    for (int i = 0; i < count; ++i) {
      const Vec3 at = at_one_point ? only : point(center_, size_);
      const double reach = size_ * random_.log_uniform(1e-3, 1);
      Corners v = {point(at, reach), point(at, reach), point(at, reach)};
      switch (random_.below(7)) {
        case 0:
          v[1].y = v[2].y = v[0].y;
          break;  // a box without height
        case 1:
          v[2] = glm::mix(v[0], v[1], 0.4) + random_.point(random_.log_uniform(1e-8, 1e-2)) * reach;
          break;  // a needle
        case 2:
          v[2] = v[1] + random_.point(random_.log_uniform(1e-8, 1e-2)) * reach;
          break;  // two corners close together
        case 3:
          if (i > 0) v = corners(mesh, index(mesh.triangles.size()));
          break;  // a duplicate
        case 4:   // coplanar, overlapping
          if (i > 0) {
            const Corners other = corners(mesh, index(mesh.triangles.size()));
            v = {other[0], other[1], other[1] + 2.0 * (other[2] - other[0])};
          }
          break;
        default:
          break;
      }
      if (!(thickness(v) >= thinnest_triangle)) v = {at, at + Vec3(size_, 0, 0), at + Vec3(0, 0, size_)};
      const auto first = uint32_t(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(), v.begin(), v.end());
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
  }

  void add_shapes(const Mesh& mesh) { add_triangles(scene_, mesh, material()); }

  // Adds stars and parallelograms, some as thin as needles, some with flat boxes.
  void add_polygons(int count) {
    for (int i = 0; i < count; ++i) {
      const Mat4 map = coin(0.5) ? some_map() : Mat4(1.0);
      const Vec3 at = point(center_, size_);
      const double reach = size_ * random_.log_uniform(1e-3, 1);
      const Vec3 thin(1, 1, coin(0.3) ? random_.log_uniform(1e-6, 1) : 1);
      if (coin(0.3)) {
        add(scene_, shapes::make_parallelogram(at, Vec3(reach, 0, 0), reach * thin * Vec3(0.3, 0, 1), map),
            material());
        continue;
      }
      shapes::PlanarRegion star;
      const int corners = 3 + random_.below(12);
      for (int k = 0; k < corners; ++k) {
        const double angle = 2 * std::numbers::pi * k / corners;
        star.outer.push_back(at +
                             (k % 2 ? 0.6 : 1) * reach * thin * Vec3(std::sin(angle), 0, std::cos(angle)));
      }
      if (star.normal() != Vec3(0)) add(scene_, shapes::make_polygon(star, map), material());
    }
  }

  void add_single() {
    if (coin(0.5)) {
      add_shapes(hard_triangles(1));
    } else {
      add(scene_, shapes::make_sphere(point(center_, size_), size_ * random_.uniform(0.1, 1)), material());
    }
  }

  void add_spheres(int count) {
    for (int i = 0; i < count; ++i) {
      const bool again = i > 0 && coin(0.2);
      if (!again) {
        sphere_center_ = point(center_, size_);
        sphere_radius_ = size_ * random_.log_uniform(1e-4, 1);
      }
      add(scene_, shapes::make_sphere(sphere_center_, sphere_radius_), material());
    }
  }

  // Adds shapes in object spaces, distorted up to 1 : 100.
  void add_object_shapes(int count) {
    Mat4 map(1.0);
    for (int i = 0; i < count; ++i) {
      if (i == 0 || !coin(0.2)) {
        // These shapes are not as far away or as small as the others: at a million times its size, such a
        // shape would have no digits left.
        map = some_map() * translation(center_ + random_.point(1) * size_);
        map = glm::scale(map, Vec3(size_ * random_.log_uniform(0.03, 1)));
      }
      const bool open = coin(0.5);
      switch (random_.below(4)) {
        case 0:
          add(scene_, shapes::make_box(Vec3(-1), Vec3(1), map), material());
          break;
        case 1:
          add(scene_, shapes::make_ellipsoid(Vec3(0), Vec3(1), map), material());
          break;
        case 2:
          add(scene_, shapes::make_cylinder({0, -1, 0}, {0, 1, 0}, 1, open, map), material());
          break;
        default:
          add(scene_, shapes::make_cone({0, -1, 0}, {0, 1, 0}, 1, random_.below(2) * 0.5, open, map),
              material());
      }
    }
  }

  // Adds CSG objects of parts that touch, are equal or lie side by side; some of them lie within others.
  void add_csg_objects(int count) {
    for (int i = 0; i < count; ++i) {
      Scene parts = test::empty_scene();
      std::swap(parts.shapes, scene_.shapes);
      add_spheres(1 + random_.below(3));
      add_object_shapes(1 + random_.below(4));
      std::swap(parts.shapes, scene_.shapes);
      shapes::ShapeType::Shapes operands, removed;
      for (auto& part : parts.shapes) {
        if (!part->is_closed()) continue;
        if (!operands.empty() && coin(0.2))
          removed.push_back(std::move(part));
        else
          operands.push_back(std::move(part));
        if (operands.size() == 2 && coin(0.3)) {
          auto inner = shapes::make_csg(coin(0.5), std::move(operands));
          operands.clear();
          operands.push_back(std::move(inner));
        }
      }
      // Most intersections of three or more operands would be empty.
      const bool all = operands.size() < 3 && coin(0.4);
      auto csg = shapes::make_csg(all, std::move(operands), std::move(removed));
      if (glm::all(glm::lessThan(csg->bounds().min, csg->bounds().max))) add(scene_, std::move(csg), 0);
    }
  }

  // Adds nested spheres, each around the next and nearly as large: they make the deepest BVHs.
  void add_nest() {
    const int count = 30 + random_.below(100);
    const double factor = random_.uniform(1.05, 1.5);
    for (int i = 0; i < count; ++i) {
      const double radius = size_ * std::pow(factor, -i);
      if (radius < 1e-9 * size_) break;
      add(scene_, shapes::make_sphere(center_ + Vec3(radius, 0, 0), radius), material());
    }
  }

  void add_instances(int count) {
    const int mesh = add(scene_, hard_triangles(1 + random_.below(30)));
    Mat4 map(1.0);
    for (int i = 0; i < count; ++i) {
      if (i == 0 || !coin(0.2)) map = some_map();
      add_instance(scene_, mesh, material(), map);
    }
  }

  // Adds a group of shapes of one kind or of many, perhaps with a mesh, and shows it `count` times.
  void add_groups(int count) {
    std::vector<std::unique_ptr<Shape>> own;
    std::swap(own, scene_.shapes);
    add_spheres(random_.below(5));
    if (coin(0.7)) add_object_shapes(1 + random_.below(4));
    if (coin(0.3)) add_csg_objects(1 + random_.below(2));
    if (coin(0.5)) add_shapes(hard_triangles(1 + random_.below(6)));
    if (coin(0.3)) add_polygons(1 + random_.below(3));
    Group group;
    std::swap(group.shapes, scene_.shapes);
    std::swap(scene_.shapes, own);
    if (coin(0.4) || group.shapes.empty())
      group.instances.push_back(
          {add(scene_, hard_triangles(1 + random_.below(10))), some_map(), material(), {}});
    scene_.groups.push_back(std::move(group));
    Mat4 map(1.0);
    for (int i = 0; i < count; ++i) {
      if (i == 0 || !coin(0.2)) map = some_map();
      scene_.group_instances.push_back(
          {int(scene_.groups.size()) - 1, map, scene_.shapes.size(), index(scene_.instances.size() + 1), {}});
    }
    std::ranges::stable_sort(scene_.group_instances, {}, &GroupInstance::instances_before);
  }

  // A map that turns, stretches, mirrors, shears, shrinks or enlarges, and moves.
  Mat4 some_map() {
    if (coin(0.1)) return Mat4(1.0);
    const double strongest = coin(0.3) ? 100 : 2;
    const auto factor = [&] { return random_.log_uniform(1 / strongest, strongest) * (coin(0.2) ? -1 : 1); };
    Mat4 map = translation(center_ + random_.point(1) * size_);
    for (int i = 0; i < 2; ++i) {
      map = glm::rotate(map, random_.uniform(0, 7), random_.direction());
      if (coin(0.7)) map = glm::scale(map, Vec3(factor(), factor(), factor()));
    }
    if (coin(0.2)) map = glm::scale(map, Vec3(random_.log_uniform(1e-3, 1e3)));
    return map * translation(-center_);
  }

  glm::vec3 some_point() {
    const RayTarget& t = targets_[index(targets_.size())];
    const auto u = float(random_.uniform()), v = float(random_.uniform());
    switch (random_.below(5)) {
      case 0:
        return t.a;
      case 1:
        return t.b;
      case 2:
        return t.a + (t.b - t.a) * u;
      case 3:
        return t.b + (t.c - t.b) * u;
      default:
        return t.a + (t.b - t.a) * (u * v) + (t.c - t.a) * (u * (1 - v));
    }
  }

  shader::QueryRay some_ray() {
    const glm::vec3 target = some_point();
    Vec3 origin = Vec3(target) + random_.direction() * size_ * random_.log_uniform(1e-2, 1e2);
    Vec3 direction = Vec3(target) - origin;
    const RayTarget& other = targets_[index(targets_.size())];
    switch (random_.below(10)) {
      case 0:  // along an axis
      case 1: {
        direction = Vec3(0);
        direction[random_.below(3)] = coin(0.5) ? 1 : -1;
        if (coin(0.3)) direction[random_.below(3)] += random_.log_uniform(1e-16, 1e-5);
        origin = Vec3(target) - direction * (coin(0.3) ? 0.0 : size_ * random_.log_uniform(1e-2, 1e2));
        break;
      }
      case 2:  // from one point to another
      case 3:
        origin = Vec3(some_point());
        direction = Vec3(target) - origin;
        break;
      case 4:  // along an edge, or tangent to a sphere, from within or from its extension
      case 5:
        direction = Vec3(other.b) - Vec3(other.a);
        if (coin(0.5)) direction = Vec3(other.c) - Vec3(other.b);
        origin = Vec3(other.b) - direction * random_.log_uniform(1e-3, 1e6) * (coin(0.5) ? 1.0 : -1.0);
        break;
      case 6:  // past the end of a long edge, at any angle
        direction = random_.direction();
        origin = Vec3(other.b) + (Vec3(other.b) - Vec3(other.a)) * random_.log_uniform(1e-3, 1e6);
        origin -= direction * size_ * random_.uniform();
        break;
      case 7:  // from far away
        origin = Vec3(target) + random_.direction() * size_ * random_.log_uniform(1e2, 1e8);
        direction = Vec3(target) - origin;
        break;
      case 8:  // from a surface
        origin = Vec3(target);
        direction = random_.direction();
        break;
      default:
        break;
    }
    if (direction == Vec3(0)) direction = {0, 0, 1};
    direction = unit(direction);
    // Half of the rays end, some close to their target.
    const double distance = glm::length(Vec3(target) - origin);
    const double t_max = coin(0.5) ? 3e38 : coin(0.5) ? distance : distance * random_.log_uniform(0.1, 10);
    return query_ray(origin, direction, t_max);
  }

  Random random_;
  Scene scene_ = test::empty_scene();
  double size_ = 1;
  Vec3 center_{0};
  double grid_ = 0;
  Vec3 apart_{0};  // offset of half of the objects: compared with it, each object is tiny
  double glass_ = 0;
  Vec3 sphere_center_{0};
  double sphere_radius_ = 1;
  std::vector<RayTarget> targets_;
};

}  // namespace eyeray::engine::test
