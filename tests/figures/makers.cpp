#include "makers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <numbers>

#include "host/formula/formula.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/ready_formulas.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::test {

namespace {

// Any affine map that float32 can bear: not nearly flat. Moves the origin to a point at most 3 `size` away.
Mat4 some_map(Random& random, double size) {
  Mat3 linear;
  do {
    for (int axis = 0; axis < 3; ++axis) linear[axis] = random.direction() * random.uniform(0.25, 1);
  } while (std::fabs(glm::determinant(linear)) < 0.1);
  return {{linear[0] * size, 0}, {linear[1] * size, 0}, {linear[2] * size, 0}, {random.point(3 * size), 1}};
}

// A region within distance 1 of the origin, in a plane near the origin: a regular polygon, a star or a gear,
// with a hole or without.
shapes::PlanarRegion some_region(Random& random) {
  const int corners = 3 + random.below(40);
  const double waist = random.below(2) == 0 ? 1 : random.uniform(0.5, 1);
  const auto ring = [&](double radius, double turn) {
    shapes::Outline outline;
    for (int i = 0; i < corners; ++i) {
      const double angle = turn + 2 * std::numbers::pi * i / corners;
      const double r = i % 2 == 0 ? radius : radius * waist;
      outline.push_back({r * std::cos(angle), r * std::sin(angle), 0.1});
    }
    return outline;
  };
  const double turn = random.uniform(0, 6);
  shapes::PlanarRegion region{ring(1, turn)};
  if (random.below(2) == 0) region.holes.push_back(ring(0.25, -turn));
  return region;
}

// True if a quadric's terms of degree two have one sign everywhere (Sylvester's criterion).
bool is_definite(const shapes::QuadricValues& quadric) {
  const Vec3 p = quadric.product * 0.5;
  const Mat3 form{{quadric.square.x, p.x, p.y}, {p.x, quadric.square.y, p.z}, {p.y, p.z, quadric.square.z}};
  const double sign = quadric.square.x < 0 ? -1 : 1;
  return quadric.square.x * quadric.square.y > p.x * p.x && sign * glm::determinant(form) > 0;
}

// A formula: one of eyeray's own that are found by sphere tracing, or one of two that are found by affine
// bounds.
FormulaUse some_formula(Random& random) {
  static const std::vector<FormulaUse> all = [] {
    std::vector<FormulaUse> uses;
    for (const shapes::ReadyFormula& ready : shapes::ready_formulas())
      if (ready.lipschitz)
        uses.push_back(
            {std::make_shared<const formula::Formula>(formula::FormulaText{std::string(ready.text), {}},
                                                      ready.parameters, std::string(ready.name)),
             {Vec3(-1), Vec3(1)},
             ready.lipschitz(ready.parameters)});
    // Two formulas that are found by affine bounds.
    const char* tanglecube = "float f(vec3 p) { vec3 q = p * p; return dot(q, q - 5.0) + 11.8; }";
    uses.push_back(
        {std::make_shared<const formula::Formula>(formula::FormulaText{tanglecube, {}},
                                                  std::vector<formula::FormulaParameter>{}, "tanglecube"),
         {Vec3(-2.4), Vec3(2.4)},
         0});
    uses.push_back({uses[1].formula, {Vec3(-1), Vec3(1)}, 0});
    return uses;
  }();
  return all[size_t(random.below(int(all.size())))];
}

std::unique_ptr<Shape> some_csg(Random& random, double size);

const std::map<std::string, MakeShape> makers = {
    {"csg", some_csg},
    {"sphere",
     [](Random& random, double size) {
       return shapes::make_sphere(random.point(3 * size), size * random.uniform(0.3, 1));
     }},
    {"triangle",
     [](Random& random, double size) {
       return shapes::make_triangle({{Vec3(1, 0, 0), Vec3(-0.5, 0.8, 0), Vec3(-0.5, -0.8, 0)}},
                                    some_map(random, size));
     }},
    {"box",
     [](Random& random, double size) { return shapes::make_box(Vec3(-1), Vec3(1), some_map(random, size)); }},
    {"ellipsoid",
     [](Random& random, double size) {
       return shapes::make_ellipsoid(Vec3(0), Vec3(1), some_map(random, size));
     }},
    {"cylinder",
     [](Random& random, double size) {
       return shapes::make_cylinder({0, -1, 0}, {0, 1, 0}, 0.7, random.below(2) == 0, some_map(random, size));
     }},
    {"cone",
     [](Random& random, double size) {
       return shapes::make_cone({0, -1, 0}, {0, 1, 0}, 0.7, random.below(2) * random.uniform(0, 1.4),
                                random.below(2) == 0, some_map(random, size));
     }},
    {"polygon",
     [](Random& random, double size) {
       return shapes::make_polygon(some_region(random), some_map(random, size));
     }},
    {"parallelogram",
     [](Random& random, double size) {
       return shapes::make_parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, some_map(random, size));
     }},
    {"prism",
     [](Random& random, double size) {
       return shapes::make_prism(some_region(random),
                                 {0, random.uniform(-0.5, 0.5), random.uniform(0.3, 1.4)},
                                 some_map(random, size));
     }},
    {"disk",
     [](Random& random, double size) {
       return shapes::make_disk(Vec3(0), {0, 1, 0}, 1, random.below(2) * random.uniform(0, 0.9),
                                some_map(random, size));
     }},
    {"paraboloid",
     [](Random& random, double size) {
       return shapes::make_paraboloid({0, -1, 0}, {0, random.uniform(-0.5, 1), 0}, 0.9, random.below(2) == 0,
                                      some_map(random, size));
     }},
    {"hyperboloid",
     [](Random& random, double size) {
       const double waist = random.uniform(0.1, 0.5);
       const double narrow = random.below(4) == 0 ? waist : waist + random.uniform(0, 0.4);
       return shapes::make_hyperboloid({0, -1, 0}, {0, 1, 0}, 0.9, narrow, waist, random.below(2) == 0,
                                       some_map(random, size));
     }},
    {"capsule",
     [](Random& random, double size) {
       // Half of them are round cones, some of them with a tip.
       const double radius = random.log_uniform(0.1, 0.7), high = random.uniform(-0.1, 0.7);
       const bool is_round = random.below(2) == 0;
       return shapes::make_capsule({0, -0.7, 0}, {0, 0.7, 0}, radius, some_map(random, size),
                                   is_round ? std::max(high, 0.0) : radius);
     }},
    {"quadric",
     [](Random& random, double size) {
       // One quadric in four is a cone with its apex in the box. If all squares have one sign, the cone may
       // be only its apex: rounding decides which rays hit that point, so it is not tested.
       const bool cone = random.below(4) == 0;
       shapes::QuadricValues values{.square = random.point(1),
                                    .product = random.point(1),
                                    .linear = cone ? Vec3(0) : random.point(1),
                                    .constant = cone ? 0 : random.uniform(-0.5, 0.5)};
       if (cone && is_definite(values)) values.square.x = -values.square.x;
       return shapes::make_quadric(values, Vec3(-1), Vec3(1), random.below(2) == 0, some_map(random, size));
     }},
    {"torus",
     [](Random& random, double size) {
       return shapes::make_torus(Vec3(0), {0, 1, 0}, 1,
                                 random.below(2) == 0 ? 0.4 : random.log_uniform(0.01, 0.99),
                                 some_map(random, size));
     }},
    {"superellipsoid",
     [](Random& random, double size) {
       return shapes::make_superellipsoid(Vec3(0), Vec3(1), random.log_uniform(0.1, 2),
                                          random.log_uniform(0.1, 2), some_map(random, size));
     }},
    {"implicit",
     [](Random& random, double size) {
       return shapes::make_implicit(some_formula(random), random.below(2) == 0, some_map(random, size));
     }},
    {"bilinear",
     [](Random& random, double size) {
       const double bend = random.log_uniform(0.03, 1);
       return shapes::make_bilinear({Vec3(-1, 0, -1), Vec3(1, bend, -1), Vec3(random.uniform(0.5, 1.5), 0, 1),
                                     Vec3(-1, 0.5 * bend, 1)},
                                    some_map(random, size));
     }},
    {"bezier",
     [](Random& random, double size) {
       // A sheet that is more or less bent; in one of four, an edge is a point.
       std::array<Vec3, 16> net;
       const double bend = random.log_uniform(0.03, 0.4);
       for (int i = 0; i < 16; ++i)
         net[size_t(i)] = Vec3(i % 4 - 1.5, 0, i / 4 - 1.5) / 1.5 + random.point(bend);
       if (random.below(4) == 0) net[1] = net[2] = net[3] = net[0];
       return shapes::make_bezier(net, some_map(random, size));
     }},
    {"points",
     [](Random& random, double size) {
       // Few or many, apart or overlapping.
       auto cloud = std::make_shared<PointCloud>();
       const int count = 1 + random.below(20);
       for (int i = 0; i < count; ++i) cloud->positions.push_back(random.point(0.6 * size));
       return shapes::make_points(cloud, size * random.log_uniform(0.1, 0.6),
                                  glm::translate(Mat4(1.0), random.point(2 * size)));
     }},
    {"points as disks",
     [](Random& random, double size) {
       auto cloud = std::make_shared<PointCloud>();
       const int count = 1 + random.below(20);
       for (int i = 0; i < count; ++i) {
         cloud->positions.push_back(random.point(0.6 * size));
         cloud->normals.emplace_back(random.direction());
       }
       return shapes::make_points(cloud, size * random.log_uniform(0.2, 0.8),
                                  glm::translate(Mat4(1.0), random.point(2 * size)));
     }},
};

std::unique_ptr<Shape> some_closed_shape(Random& random, double size) {
  for (;;) {
    const auto [name, make] = *std::next(makers.begin(), random.below(int(makers.size())));
    if (name == "csg") continue;
    auto shape = make(random, size);
    if (shape->is_closed()) return shape;
  }
}

// A CSG object of at most 5 closed shapes of any kind, nested now and then.
std::unique_ptr<Shape> some_csg(Random& random, double size) {
  for (;;) {
    shapes::ShapeType::Shapes operands, removed;
    for (int i = 2 + random.below(2); i > 0; --i) {
      operands.push_back(some_closed_shape(random, size));
      if (random.below(4) == 0) {
        shapes::ShapeType::Shapes inner;
        for (int k = 0; k < 2; ++k) inner.push_back(some_closed_shape(random, size));
        operands.back() = shapes::make_csg(random.below(2) == 0, std::move(inner));
      }
    }
    if (random.below(2) == 0) removed.push_back(some_closed_shape(random, size));
    auto csg = shapes::make_csg(random.below(2) == 0, std::move(operands), std::move(removed));
    // The intersection of its parts may be next to nothing.
    const Bounds bounds = csg->bounds();
    const Vec3 extent = bounds.max - bounds.min;
    if (std::min({extent.x, extent.y, extent.z}) < 0.3 * size) continue;
    int hits = 0;
    const Vec3 center = (bounds.min + bounds.max) * 0.5;
    for (int i = 0; i < 20; ++i) {
      const Vec3 target = center + random.direction() * glm::length(extent) * 0.25;
      const Vec3 from = target + random.direction() * glm::length(extent);
      hits += csg->intersect({from, target - from}).has_value();
    }
    if (hits > 4) return csg;
  }
}

}  // namespace

const std::map<std::string, MakeShape>& shape_makers() {
  return makers;
}

}  // namespace eyeray::engine::test
