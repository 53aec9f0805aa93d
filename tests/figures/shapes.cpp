// Every shape's float32 half, as the shaders have it, against its float64 half: first hits from all
// distances, and rays that leave. docs/numerics.md has the figures. EYERAY_FULL_TESTS=1 makes them, with ten
// times as many rays.
#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <set>

#include "host/core/parallel_for.hpp"
#include "host/reference/crossings.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/registry.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
#include "makers.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::records;
using test::MakeShape;
using test::Random;
using test::shape_makers;

namespace {

constexpr int parts = 64;

int rays_a_part() {
  return test::amount(10'000, 100'000, 1'000'000) / parts;
}

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
    hit.t = T_MISS;
    for (uint32_t slot = 0; slot < scene.primitives.size(); ++slot) {
      const shader::Primitive& primitive = scene.primitives[slot];
      shader::vec2 uv{};
      float t = -1;
#define INTERSECT(name, number)                                               \
  if (kind_of(primitive) == number && !shader::name##_reject(primitive, ray)) \
    t = shader::name##_intersect(primitive, ray, uv);
      SHAPES(INTERSECT)
      gave_up += t == T_ITERATION_LIMIT;
      if (!(t > 0) || !(t < hit.t)) continue;
      hit.t = t;
      hit.slot = slot;
      hit.uv = uv;
    }
    return hit;
  }
  shader::Surface surface(const shader::Ray& ray, const shader::Hit& hit) const {
#define SURFACE(name, number)                 \
  if (kind_of(scene.primitives[0]) == number) \
    return shader::name##_surface(scene.primitives[hit.slot], ray, hit);
    SHAPES(SURFACE)
    return {};
  }
  double exact(const Vec3& o, const Vec3& d) const {
    const auto hit = shape->intersect({o, d});
    return hit && !hit->iteration_limit ? hit->t : HUGE_VAL;
  }

  std::unique_ptr<Shape> shape;
  double size;
  PackedScene scene;
  Vec3 center;
  double radius;
  mutable int gave_up = 0;  // how often a search reached its limit
};

// Calls `body(sample, random)` once for each ray, several times for each shape, with shapes of all sizes.
template <typename Make, typename Body>
void for_shapes(const Make& make, const Body& body) {
  parallel_for(0, parts, [&](int part) {
    Random random{uint64_t(part) + 1000 * test::seed()};
    constexpr int rays_a_shape = 32;
    for (int i = 0; i < rays_a_part(); i += rays_a_shape) {
      const double size = random.log_uniform(1e-4, 1e4);
      const Sample sample(make(random, size), size);
      const shader::Binding binding(twin::view_of(sample.scene));
      for (int k = 0; k < rays_a_shape; ++k) body(sample, random);
    }
  });
}

// True if moving the ray by at most `room` changes the exact t to `t`: then the ray grazes an edge or a side.
bool is_grazing(const Sample& sample, const shader::Ray& ray, double t, double room, int probes) {
  const Vec3 o(ray.o), d = glm::normalize(Vec3(ray.d));
  const Vec3 x = glm::normalize(glm::cross(d, std::fabs(d.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  const Vec3 y = glm::cross(d, x);
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  bool misses = false;
  for (int step = 0; step < probes; ++step) {
    const double angle = step * 2.399963;  // the golden angle, which spreads the probes over the disc
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

// The exact t of the first hit on a part that is, along the ray, thicker than `room`.
double first_thick(const Sample& sample, const shader::Ray& ray, double room) {
  for (const Span& span : sample.shape->spans({Vec3(ray.o), Vec3(ray.d)})) {
    const double t = span.in.t > 0 ? span.in.t : span.out.t;
    if (t > 0 && span.out.t - span.in.t > room) return t;
  }
  return HUGE_VAL;
}

// The numbers needed to shoot the ray again, without loss of digits. With another compiler, the same seed
// makes other shapes.
std::string describe(const Sample& sample, const shader::Ray& ray, double t, double exact) {
  const auto digits = [](const auto& v) {
    return fmt::format("{{{:.17g}, {:.17g}, {:.17g}}}", v.x, v.y, v.z);
  };
  std::string text = fmt::format("from {} along {}: t is {:.9g}, exactly {:.17g}", digits(Vec3(ray.o)),
                                 digits(Vec3(ray.d)), t, exact);
  const ShapeForm form = sample.shape->form();
  if (const auto* patch = std::get_if<BezierForm>(&form))
    for (const Vec3& p : patch->net) text += (&p == patch->net.data() ? "; points " : ", ") + digits(p);
  return text;
}

// Shoots at shapes from a distance, measured in the shape's size. Half of the rays aim at the shape, half
// past it.
template <typename Make>
void check_first_hits(const std::string& name, const Make& make, double distance) {
  std::atomic<int> rays = 0, hits = 0, misses = 0, grazing = 0, thin = 0, wrong = 0;
  std::mutex mutex;
  std::string first_wrong;
  for_shapes(make, [&](const Sample& sample, Random& random) {
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
    // A surface seen almost edge-on is so thin that few of the probes hit it.
    if (is_grazing(sample, ray, t, room, 500) || is_grazing(sample, ray, t, room, 100'000)) {
      ++grazing;
    } else if (const double thick = first_thick(sample, ray, room); std::fabs(t - thick) <= 1e-6 * thick) {
      ++thin;
    } else {
      ++wrong;
      const std::lock_guard lock(mutex);
      if (first_wrong.empty()) first_wrong = describe(sample, ray, t, exact);
    }
  });
  MESSAGE(
      fmt::format("{} at {:g}: {} rays, {} hits, {} misses of them ({:.1f} ppm), {} grazing, {} behind "
                  "walls thinner than rounding, {} wrong",
                  name, distance, rays.load(), hits.load(), misses.load(), 1e6 * misses / hits,
                  grazing.load(), thin.load(), wrong.load()));
  CHECK(hits > rays / 20);
  CHECK_MESSAGE(wrong == 0, first_wrong);
}

}  // namespace

TEST_CASE("first hits at distances 1 … 1e4 are right, except where a ray grazes") {
  for (const auto& [name, make] : shape_makers()) {
    for (const double distance : {1.5, 1e1, 1e2, 1e3, 1e4}) check_first_hits(name, make, distance);
  }
}

TEST_CASE("first hits of CSG objects with every closed shape are right, except where a ray grazes") {
  std::set<std::string> closed;
  for (const auto& [name, make] : shape_makers()) {
    Random random{1};
    for (int i = 0; i < 10 && name != "csg"; ++i)
      if (make(random, 1)->is_closed()) closed.insert(name);
    if (!closed.contains(name)) continue;
    // The shape joined with a ball, cut to the ball, less the ball, and cut out of the ball.
    const MakeShape& make_part = make;
    const auto make_pair = [&make_part](Random& some, double size) {
      shapes::ShapeType::Shapes both;
      do {
        both.clear();
        both.push_back(make_part(some, size));
      } while (!both[0]->is_closed());
      const Bounds bounds = both[0]->bounds();
      const Vec3 half = (bounds.max - bounds.min) * 0.5;
      both.push_back(make_sphere(bounds.min + half + some.point(1) * half, 0.6 * glm::length(half)));
      const int kind = some.below(4);
      if (kind < 2) return make_csg(kind == 0, std::move(both));
      shapes::ShapeType::Shapes removed;
      removed.push_back(std::move(both[kind == 2 ? 0 : 1]));
      both.erase(both.begin() + (kind == 2 ? 0 : 1));
      return make_csg(false, std::move(both), std::move(removed));
    };
    for (const double distance : {1.5, 1e2, 1e4}) check_first_hits(name + " and ball", make_pair, distance);
  }

  // The closed kinds are those that the shaders list.
  std::set<std::string> listed;
#define NAME(name, number) listed.insert(#name);
  CLOSED_SHAPES(NAME)
  CHECK(closed == listed);
}

TEST_CASE("no leaving ray hits its surface again, and every hit is on it, for sizes 1e-4 … 1e4") {
  for (const auto& [name, make] : shape_makers()) {
    std::atomic<int> left = 0, rehits = 0, bent_back = 0, off = 0, along = 0;
    for_shapes(make, [&](const Sample& sample, Random& random) {
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
        // Near an edge the two halves may have hit different sides.
        if (glm::dot(at.normal_geometric, Vec3(surface.normal_geometric)) < 0.99) continue;
        if (glm::length(at.position - Vec3(surface.p)) > 1e-3 * sample.radius) continue;
        ++left;
        off += std::fabs(glm::dot(at.normal_geometric, Vec3(surface.p) - at.position)) >
               4 * double(surface.offset) + 1e-4 * glm::length(Vec3(surface.p) - at.position);

        // Along the surface, up to the rounding of its normal, a ray may leave to either side.
        const glm::vec3 away(random.direction());
        if ((glm::dot(away, surface.normal_geometric) > 0) !=
            (glm::dot(Vec3(away), at.normal_geometric) > 0)) {
          ++along;
          continue;
        }
        const double again = double(sample.shoot(shader::spawn_ray(surface, away)).t);
        const double truly = sample.exact(reference::spawn_origin(at, Vec3(away)), Vec3(away));
        // A sheet may bend to both sides. Where it bends back, a ray that starts a little off the sheet may
        // hit it again, though a ray that starts on it does not.
        const shader::Ray next = shader::spawn_ray(surface, away);
        const bool hits_again =
            again < 0.01 * sample.radius && again < 0.5 * truly && !(truly < 1e3 * double(surface.offset));
        const bool may_bend_back = hits_again && sample.shape->counts_crossings() &&
                                   std::fabs(glm::dot(away, surface.normal_geometric)) < 0.1f &&
                                   is_grazing(sample, next, again, 2 * double(surface.offset), 500);
        bent_back += may_bend_back;
        rehits += hits_again && !may_bend_back;
      }
    });
    MESSAGE(
        fmt::format("{}: {} left, {} hits off the surface, {} re-hits, {} where it bends back, {} along it",
                    name, left.load(), off.load(), rehits.load(), bent_back.load(), along.load()));
    CHECK(left > parts * rays_a_part() / 4);
    CHECK(along <= 1 + left / 50'000);
    CHECK(off == 0);
    CHECK(rehits == 0);
  }
}

TEST_CASE("every shape with bounds has a test maker") {
  for (const shapes::ShapeType* type : shapes::types())
    if (type->name != "plane") CHECK_MESSAGE(shape_makers().contains(std::string(type->name)), type->name);
}
