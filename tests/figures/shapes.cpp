// Every shape's float32 half, as the shaders have it, against its float64 half: first hits from all
// distances, and rays that leave. docs/numerics.md has the figures; EYERAY_FULL_TESTS=1 makes them, with ten
// times as many rays.
#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>

#include "core/parallel_for.hpp"
#include "reference/tracer.hpp"
#include "shapes/make.hpp"
#include "support/random.hpp"
#include "twin/shader_functions.hpp"

#include "support/doctest.hpp"

using namespace eyeray;
using test::Random;

namespace {

constexpr int parts = 64;

int rays_a_part() {
  return (std::getenv("EYERAY_FULL_TESTS") ? 1'000'000 : 100'000) / parts;
}

// Other shapes and rays, with EYERAY_SEED set.
uint64_t seed() {
  const char* set = std::getenv("EYERAY_SEED");
  return set ? std::strtoull(set, nullptr, 10) : 0;
}

// Any affine map that float32 can bear: not nearly flat. Places it around one at most 3 `size` away.
Mat4 some_map(Random& random, double size) {
  Mat3 linear;
  do {
    for (int axis = 0; axis < 3; ++axis) linear[axis] = random.direction() * random.uniform(0.25, 1);
  } while (std::fabs(glm::determinant(linear)) < 0.1);
  return {{linear[0] * size, 0}, {linear[1] * size, 0}, {linear[2] * size, 0}, {random.point(3 * size), 1}};
}

// Within 1 about the origin, in a plane near it: a regular one, a star, a gear, with a hole or without.
PlanarRegion some_region(Random& random) {
  const int corners = 3 + random.below(40);
  const double waist = random.below(2) == 0 ? 1 : random.uniform(0.5, 1);
  const auto ring = [&](double radius, double turn) {
    Outline outline;
    for (int i = 0; i < corners; ++i) {
      const double angle = turn + 2 * std::numbers::pi * i / corners;
      const double r = i % 2 == 0 ? radius : radius * waist;
      outline.push_back({r * std::cos(angle), r * std::sin(angle), 0.1});
    }
    return outline;
  };
  const double turn = random.uniform(0, 6);
  PlanarRegion region{ring(1, turn)};
  if (random.below(2) == 0) region.holes.push_back(ring(0.25, -turn));
  return region;
}

// Whether a quadric's terms of degree two have one sign everywhere (Sylvester's criterion).
bool is_definite(const QuadricValues& quadric) {
  const Vec3 p = quadric.product * 0.5;
  const Mat3 form{{quadric.square.x, p.x, p.y}, {p.x, quadric.square.y, p.z}, {p.y, p.z, quadric.square.z}};
  const double sign = quadric.square.x < 0 ? -1 : 1;
  return quadric.square.x * quadric.square.y > p.x * p.x && sign * glm::determinant(form) > 0;
}

// A shape about as large as `size`.
using MakeShape = std::unique_ptr<Shape> (*)(Random& random, double size);
const std::map<std::string, MakeShape> makers = {
    {"sphere",
     [](Random& random, double size) {
       return make_sphere(random.point(3 * size), size * random.uniform(0.3, 1));
     }},
    {"triangle",
     [](Random& random, double size) {
       return make_triangle({{Vec3(1, 0, 0), Vec3(-0.5, 0.8, 0), Vec3(-0.5, -0.8, 0)}},
                            some_map(random, size));
     }},
    {"box", [](Random& random, double size) { return make_box(Vec3(-1), Vec3(1), some_map(random, size)); }},
    {"ellipsoid",
     [](Random& random, double size) { return make_ellipsoid(Vec3(0), Vec3(1), some_map(random, size)); }},
    {"cylinder",
     [](Random& random, double size) {
       return make_cylinder({0, -1, 0}, {0, 1, 0}, 0.7, random.below(2) == 0, some_map(random, size));
     }},
    {"cone",
     [](Random& random, double size) {
       return make_cone({0, -1, 0}, {0, 1, 0}, 0.7, random.below(2) * random.uniform(0, 1.4),
                        random.below(2) == 0, some_map(random, size));
     }},
    {"polygon",
     [](Random& random, double size) { return make_polygon(some_region(random), some_map(random, size)); }},
    {"parallelogram",
     [](Random& random, double size) {
       return make_parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, some_map(random, size));
     }},
    {"prism",
     [](Random& random, double size) {
       return make_prism(some_region(random), {0, random.uniform(-0.5, 0.5), random.uniform(0.3, 1.4)},
                         some_map(random, size));
     }},
    {"disk",
     [](Random& random, double size) {
       return make_disk(Vec3(0), {0, 1, 0}, 1, random.below(2) * random.uniform(0, 0.9),
                        some_map(random, size));
     }},
    {"paraboloid",
     [](Random& random, double size) {
       return make_paraboloid({0, -1, 0}, {0, random.uniform(-0.5, 1), 0}, 0.9, random.below(2) == 0,
                              some_map(random, size));
     }},
    {"hyperboloid",
     [](Random& random, double size) {
       const double waist = random.uniform(0.1, 0.5);
       const double narrow = random.below(4) == 0 ? waist : waist + random.uniform(0, 0.4);
       return make_hyperboloid({0, -1, 0}, {0, 1, 0}, 0.9, narrow, waist, random.below(2) == 0,
                               some_map(random, size));
     }},
    {"capsule",
     [](Random& random, double size) {
       return make_capsule({0, -0.7, 0}, {0, 0.7, 0}, random.log_uniform(0.1, 0.7), some_map(random, size));
     }},
    {"quadric",
     [](Random& random, double size) {
       // One in four is a cone, its apex in the box. Where all squares have one sign, a cone may be its apex
       // alone: which rays meet that point is a matter of rounding, and nothing to be asked.
       const bool cone = random.below(4) == 0;
       QuadricValues values{.square = random.point(1),
                            .product = random.point(1),
                            .linear = cone ? Vec3(0) : random.point(1),
                            .constant = cone ? 0 : random.uniform(-0.5, 0.5)};
       if (cone && is_definite(values)) values.square.x = -values.square.x;
       return make_quadric(values, Vec3(-1), Vec3(1), random.below(2) == 0, some_map(random, size));
     }},
    {"torus",
     [](Random& random, double size) {
       return make_torus(Vec3(0), {0, 1, 0}, 1, random.below(2) == 0 ? 0.4 : random.log_uniform(0.01, 0.99),
                         some_map(random, size));
     }},
    {"superellipsoid",
     [](Random& random, double size) {
       return make_superellipsoid(Vec3(0), Vec3(1), random.log_uniform(0.1, 2), random.log_uniform(0.1, 2),
                                  some_map(random, size));
     }},
    {"bilinear",
     [](Random& random, double size) {
       const double bend = random.log_uniform(0.03, 1);
       return make_bilinear({Vec3(-1, 0, -1), Vec3(1, bend, -1), Vec3(random.uniform(0.5, 1.5), 0, 1),
                             Vec3(-1, 0.5 * bend, 1)},
                            some_map(random, size));
     }},
};

// One shape as a scene, in both forms.
struct Sample {
  Sample(std::unique_ptr<Shape> made, double about) : shape(std::move(made)), size(about) {
    Packer packer(Vec3(0));
    shape->pack(packer);
    scene = std::move(packer.scene);
    const Bounds bounds = shape->bounds();
    center = (bounds.min + bounds.max) * 0.5;
    radius = glm::length(bounds.max - bounds.min) * 0.5;
  }

  shader::Hit shoot(const shader::Ray& ray) const {
    shader::Hit hit{};
    hit.t = -1;
#define INTERSECT(name, number)               \
  if (kind_of(scene.primitives[0]) == number) \
    hit.t = shader::name##_intersect(scene.primitives[0], ray, hit.uv);
    SHAPES(INTERSECT)
    if (!(hit.t > 0) || !(hit.t < T_MISS)) hit.t = T_MISS;
    return hit;
  }
  shader::Surface surface(const shader::Ray& ray, const shader::Hit& hit) const {
#define SURFACE(name, number) \
  if (kind_of(scene.primitives[0]) == number) return shader::name##_surface(scene.primitives[0], ray, hit);
    SHAPES(SURFACE)
    return {};
  }
  double exact(const Vec3& o, const Vec3& d) const {
    const auto hit = shape->intersect({o, d});
    return hit ? hit->t : HUGE_VAL;
  }

  std::unique_ptr<Shape> shape;
  double size;
  PackedScene scene;
  Vec3 center;
  double radius;
};

// What `body(sample, random)` says of as many rays, several a shape, of all sizes.
template <typename Body>
void for_shapes(const std::string& name, const Body& body) {
  parallel_for(0, parts, [&](int part) {
    Random random{uint64_t(part) + 1000 * seed()};
    constexpr int rays_a_shape = 32;
    for (int i = 0; i < rays_a_part(); i += rays_a_shape) {
      const double size = random.log_uniform(1e-4, 1e4);
      const Sample sample(makers.at(name)(random, size), size);
      const shader::Binding binding(sample.scene);
      for (int k = 0; k < rays_a_shape; ++k) body(sample, random);
    }
  });
}

// Whether the exact t varies to `t` when the ray is moved by as little as `room`: then it grazes an edge or a
// side.
bool is_grazing(const Sample& sample, const shader::Ray& ray, double t, double room, int probes) {
  const Vec3 o(ray.o), d = glm::normalize(Vec3(ray.d));
  const Vec3 x = glm::normalize(glm::cross(d, std::fabs(d.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  const Vec3 y = glm::cross(d, x);
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  bool misses = false;
  for (int step = 0; step < probes; ++step) {
    const double angle = step * 2.399963;  // the golden one: all over the disc
    const double far = room * std::sqrt((step + 1.0) / probes);
    const double moved =
        sample.exact(o + (x * std::cos(angle) + y * std::sin(angle)) * far, d) / glm::length(Vec3(ray.d));
    misses = misses || moved == HUGE_VAL;
    if (moved == HUGE_VAL) continue;
    least = std::min(least, moved);
    greatest = std::max(greatest, moved);
  }
  if (t >= double(T_MISS)) return misses;
  const double spread = 1e-6 * std::fabs(t) + (greatest - least);
  return t >= least - spread && t <= greatest + spread;
}

}  // namespace

TEST_CASE("first hits at distances 1 … 1e4: no wrong answer but where a ray grazes") {
  for (const auto& [name, make] : makers) {
    for (const double distance : {1.5, 1e1, 1e2, 1e3, 1e4}) {
      std::atomic<int> rays = 0, hits = 0, misses = 0, grazing = 0, wrong = 0;
      for_shapes(name, [&](const Sample& sample, Random& random) {
        // Half of them aimed at the shape, half past it; from a distance, or at a distance from the eye.
        const Vec3 target = sample.center + random.direction() * sample.radius * random.uniform(0, 1.1);
        const Vec3 from = target + random.direction() * sample.radius * distance;
        const shader::Ray ray = shader::make_ray(glm::vec3(from), glm::vec3(glm::normalize(target - from)));
        const shader::Hit hit = sample.shoot(ray);
        const double exact = sample.exact(Vec3(ray.o), Vec3(ray.d));
        ++rays;
        hits += exact < HUGE_VAL;
        misses += exact < HUGE_VAL && hit.t == T_MISS;
        const double t = double(hit.t);
        if (exact == HUGE_VAL ? hit.t == T_MISS : std::fabs(t - exact) <= 1e-6 * exact) return;
        const double room = 32 * 0x1p-24 * (glm::length(from) + glm::length(sample.center) + sample.radius);
        // What is seen all but edge-on is so thin that few of the probes meet it.
        if (is_grazing(sample, ray, t, room, 500) || is_grazing(sample, ray, t, room, 100'000))
          ++grazing;
        else
          ++wrong;
      });
      MESSAGE(
          fmt::format("{} at {:g}: {} rays, {} hits, {} misses of them ({:.1f} ppm), {} grazing, {} wrong",
                      name, distance, rays.load(), hits.load(), misses.load(), 1e6 * misses / hits,
                      grazing.load(), wrong.load()));
      CHECK(hits > rays / 20);
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("rays that leave, sizes 1e-4 … 1e4: none meets its surface again, every hit is on it") {
  for (const auto& [name, make] : makers) {
    std::atomic<int> left = 0, rehits = 0, off = 0;
    for_shapes(name, [&](const Sample& sample, Random& random) {
      const Vec3 target = sample.center + random.direction() * sample.radius * random.uniform(0, 1);
      const Vec3 from = target + random.direction() * sample.radius * random.log_uniform(0.1, 10);
      const shader::Ray ray = shader::make_ray(glm::vec3(from), glm::vec3(random.direction()));
      const shader::Ray aimed = shader::make_ray(glm::vec3(from), glm::vec3(glm::normalize(target - from)));
      for (const shader::Ray& arriving : {aimed, ray}) {
        const shader::Hit hit = sample.shoot(arriving);
        const auto exact = sample.shape->intersect({Vec3(arriving.o), Vec3(arriving.d)});
        if (hit.t == T_MISS || !exact) continue;
        const SurfacePoint at = sample.shape->surface({Vec3(arriving.o), Vec3(arriving.d)}, *exact);
        const shader::Surface surface = sample.surface(arriving, hit);
        // Past an edge the two may have met different sides.
        if (glm::dot(at.normal_geometric, Vec3(surface.normal_geometric)) < 0.99) continue;
        if (glm::length(at.position - Vec3(surface.p)) > 1e-3 * sample.radius) continue;
        ++left;
        off += std::fabs(glm::dot(at.normal_geometric, Vec3(surface.p) - at.position)) >
               4 * double(surface.offset) + 1e-4 * glm::length(Vec3(surface.p) - at.position);

        const glm::vec3 away(random.direction());
        const double again = double(sample.shoot(shader::leave(surface, away)).t);
        const double truly = sample.exact(reference::departure(at, Vec3(away)), Vec3(away));
        rehits +=
            again < 0.01 * sample.radius && again < 0.5 * truly && !(truly < 1e3 * double(surface.offset));
      }
    });
    MESSAGE(fmt::format("{}: {} left, {} hits off the surface, {} re-hits", name, left.load(), off.load(),
                        rehits.load()));
    CHECK(left > parts * rays_a_part() / 4);
    CHECK(off == 0);
    CHECK(rehits == 0);
  }
}

TEST_CASE("every shape that has bounds has its figures") {
  for (const ShapeType* type : shape_types())
    if (type->name != "plane") CHECK_MESSAGE(makers.contains(std::string(type->name)), type->name);
}
