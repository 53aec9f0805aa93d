// Polygons, parallelograms and triangles that share vertices: no ray passes between them.
#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include "host/shapes/make.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::records;
using test::Random;

namespace {

int rays_a_placement() {
  return test::amount(10'000, 10'000, 100'000);
}

constexpr int teeth = 36;
constexpr int corners = 4 * teeth;

// The face of a gear of the Standard Procedural Databases, about the y axis.
Outline gear_face(double radius, double y) {
  constexpr double radii[] = {0.995, 0.995, 0.9, 0.9};
  constexpr double offsets[] = {-0.19, 0.19, 0.3, 0.7};
  Outline outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi / teeth * (i / 4 + offsets[i % 4]);
    const double r = radius * radii[i % 4];
    outline.push_back({r * std::cos(angle), y, -r * std::sin(angle)});
  }
  return outline;
}

Outline mapped(Outline outline, const Mat4& map) {
  return PlanarRegion{std::move(outline)}.transformed(Affine(map)).outer;
}

// Shapes as float64 objects and as packed records.
struct Shapes {
  void add(std::unique_ptr<Shape> shape) {
    shape->pack(packer);
    shapes.push_back(std::move(shape));
  }
  void add(const PlanarRegion& region) { add(make_polygon(region)); }

  int hits(const shader::Ray& ray) const {
    int count = 0;
    for (const shader::Primitive& primitive : packer.scene.primitives) {
      shader::vec2 uv;
      float t = -1;
#define INTERSECT(name, number) \
  if (kind_of(primitive) == number) t = shader::name##_intersect(primitive, ray, uv);
      SHAPES(INTERSECT)
      count += t > 0 && t < T_MISS;
    }
    return count;
  }
  int hits(const Ray& ray) const {
    int count = 0;
    for (const auto& shape : shapes) count += shape->intersect(ray).has_value();
    return count;
  }

  Packer packer{Vec3(0)};
  std::vector<std::unique_ptr<Shape>> shapes;
};

// Counts of rays from `origin()` towards points of `edges` and towards their ends. A leak is a ray without a
// hit, `several` counts rays with more than one, and the exact counts are those of the float64 halves.
struct Count {
  int rays = 0, leaks = 0, several = 0, exact_leaks = 0, exact_several = 0;
};
template <typename Origin>
Count shoot(const Shapes& shapes, const std::vector<std::array<Vec3, 2>>& edges, Random& random, int rays,
            const Origin& origin) {
  const shader::Binding binding(twin::view_of(shapes.packer.scene));
  Count count;
  for (int i = 0; i < rays; ++i) {
    const auto& [a, b] = edges[size_t(random.below(int(edges.size())))];
    const Vec3 target = random.below(2) == 0 ? a : glm::mix(a, b, random.uniform());
    const glm::vec3 from(origin());
    const shader::Ray ray = shader::make_ray(from, glm::vec3(glm::normalize(target - Vec3(from))));
    const int found = shapes.hits(ray);
    const int exact = shapes.hits(Ray{Vec3(from), target - Vec3(from)});
    ++count.rays;
    count.leaks += found == 0;
    count.several += found > 1;
    count.exact_leaks += exact == 0;
    count.exact_several += exact > 1;
  }
  return count;
}

struct Placement {
  const char* name;
  Vec3 center;
  double size;
};
constexpr Placement placements[] = {{"at the origin", {0, 0, 0}, 1},
                                    {"far away", {148376, 1234, -223423}, 1000},
                                    {"of size 0.01", {0, 0, 0}, 0.01}};

Mat4 turned(const Placement& placement, double degrees) {
  return glm::scale(
      glm::rotate(glm::translate(Mat4(1), placement.center), glm::radians(degrees), Vec3(0.6, 0, 0.8)),
      Vec3(placement.size));
}

}  // namespace

TEST_CASE("each ray at the seams of a 36-tooth gear's teeth, ring and hub hits exactly one of them") {
  for (const Placement& placement : placements) {
    for (const double degrees : {0.0, 40.0}) {
      const Mat4 map = turned(placement, degrees);
      const Outline rim = mapped(gear_face(1, 0), map);
      const Outline ring = mapped(gear_face(0.6, 0), map);
      Outline hub;
      for (int i = 0; i < corners; i += 4)
        hub.push_back(Vec3(map * Vec4(Vec3(gear_face(0.3, 0)[size_t(i)]), 1)));
      Shapes shapes;
      std::vector<std::array<Vec3, 2>> seams;
      for (size_t k = 0; k < teeth; ++k) {
        Outline tooth;
        for (size_t i = 0; i <= 4; ++i) tooth.push_back(rim[(4 * k + i) % corners]);
        for (size_t i = 0; i <= 4; ++i) tooth.push_back(ring[(4 * k + 4 - i) % corners]);
        shapes.add({tooth});
        seams.push_back({ring[4 * k], glm::mix(ring[4 * k], rim[4 * k], 0.99)});  // beyond is the border
        seams.push_back({hub[k], hub[(k + 1) % hub.size()]});
      }
      for (size_t i = 0; i < corners; ++i) seams.push_back({ring[i], ring[(i + 1) % corners]});
      shapes.add({ring, {hub}});
      shapes.add({hub});

      Random random(uint64_t(degrees) + 7);
      const Count count = shoot(shapes, seams, random, rays_a_placement(), [&] {
        return Vec3(map * Vec4(random.point(0.7) + Vec3(0, random.below(2) == 0 ? 0.8 : -1.5, 0), 1));
      });
      MESSAGE(fmt::format(
          "{}, turned by {}°: {} rays, {} pass, {} hit several; in float64 {} pass, {} hit several",
          placement.name, degrees, count.rays, count.leaks, count.several, count.exact_leaks,
          count.exact_several));
      CHECK(count.leaks == 0);
      CHECK(count.several == 0);
      CHECK(count.exact_leaks == 0);
      CHECK(count.exact_several == 0);
    }
  }
}

TEST_CASE("no ray from within a closed gear passes at edges or vertices, with walls of any kind") {
  constexpr const char* names[] = {"walls of polygons", "walls of polygons and triangles",
                                   "walls of all kinds"};
  for (const int kinds : {1, 2, 3}) {
    for (const Placement& placement : placements) {
      const Mat4 map = turned(placement, 25);
      const Outline top = mapped(gear_face(1, 0.1), map);
      const Outline bottom = mapped(gear_face(1, -0.1), map);
      Shapes shapes;
      std::vector<std::array<Vec3, 2>> edges;
      shapes.add({top});
      shapes.add({Outline(bottom.rbegin(), bottom.rend())});
      for (size_t i = 0; i < corners; ++i) {
        const size_t next = (i + 1) % corners;
        const Vec3 a = bottom[i], b = bottom[next], c = top[next], d = top[i];
        edges.insert(edges.end(), {{a, b}, {d, c}, {a, d}});
        if (i % size_t(kinds) == 0) {
          shapes.add({{a, b, c, d}});
        } else if (i % size_t(kinds) == 1) {
          shapes.add(make_triangle({.vertices = {a, b, c}}));
          shapes.add(make_triangle({.vertices = {a, c, d}}));
        } else {
          shapes.add(make_parallelogram(a, b - a, d - a));
        }
      }
      Random random(11);
      const Count count = shoot(shapes, edges, random, rays_a_placement() / 4,
                                [&] { return Vec3(map * Vec4(random.point(0.5) * Vec3(1, 0.1, 1), 1)); });
      MESSAGE(fmt::format("{}, {}: {} rays, {} pass; in float64 {}", placement.name, names[kinds - 1],
                          count.rays, count.leaks, count.exact_leaks));
      CHECK(count.leaks == 0);
      // The corners of a parallelogram are sums. In float64 their last bits may differ from those of its
      // neighbours' corners.
      if (kinds < 3) CHECK(count.exact_leaks == 0);
    }
  }
}

TEST_CASE("a ray that grazes a polygon or a parallelogram hits it within its outline") {
  const std::vector<Vec2> outlines[] = {{{0, 0}, {1, 0}, {0.2, 0.9}},
                                        {{0, 0}, {1, 0}, {1, 1}, {0.9, 0.1}},
                                        {{0, 0}, {1, 0.1}, {1.3, 1}, {0.3, 0.9}}};
  const auto beyond = [](const std::vector<Vec2>& outline, const Vec2& point) {
    if (winding(outline, point) != 0) return 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < outline.size(); ++i) {
      const Vec2 from = outline[i], along = outline[(i + 1) % outline.size()] - from;
      const double share = glm::clamp(glm::dot(point - from, along) / glm::dot(along, along), 0.0, 1.0);
      least = std::min(least, glm::distance(point, from + share * along));
    }
    return least;
  };
  Random random(3);
  int hits = 0;
  double farthest = 0;
  for (int i = 0; i < rays_a_placement() / 4; ++i) {
    const Vec3 n = random.direction(), u = glm::normalize(glm::cross(n, random.direction()));
    const Vec3 origin = random.point(1), v = glm::cross(n, u);
    const auto on_plane = [&](const Vec2& p) { return origin + p.x * u + p.y * v; };
    const size_t chosen = size_t(random.below(3));
    const std::vector<Vec2>& outline = outlines[chosen];
    Shapes shapes;
    Outline vertices;
    for (const Vec2& p : outline) vertices.push_back(on_plane(p));
    if (chosen == 2)
      shapes.add(make_parallelogram(vertices[0], vertices[1] - vertices[0], vertices[3] - vertices[0]));
    else
      shapes.add({vertices});
    const shader::Binding binding(twin::view_of(shapes.packer.scene));
    const shader::Primitive& primitive = shapes.packer.scene.primitives[0];
    for (int ray = 0; ray < 40; ++ray) {
      const Vec2 target(random.uniform(0, 1), random.uniform(0, 1));
      const double angle = random.uniform(0, 2 * std::numbers::pi);
      const Vec3 from =
          on_plane(target + 2.0 * Vec2(std::cos(angle), std::sin(angle))) + random.log_uniform(1e-8, 0.3) * n;
      const shader::Ray r =
          shader::make_ray(glm::vec3(from), glm::vec3(glm::normalize(on_plane(target) - from)));
      shader::Hit hit{};
      hit.t = -1;
      shader::Surface surface{};
#define HIT(name, number)                                               \
  if (kind_of(primitive) == number) {                                   \
    hit.t = shader::name##_intersect(primitive, r, hit.uv);             \
    if (hit.t > 0) surface = shader::name##_surface(primitive, r, hit); \
  }
      SHAPES(HIT)
      if (!(hit.t > 0)) continue;
      ++hits;
      const Vec3 offset = Vec3(surface.p) - origin;
      farthest = std::max(farthest, beyond(outline, {glm::dot(offset, u), glm::dot(offset, v)}));
    }
  }
  MESSAGE(fmt::format("{} hits, at most {:.2g} beyond the outline", hits, farthest));
  CHECK(hits > rays_a_placement());
  CHECK(farthest < 4e-6);
}
