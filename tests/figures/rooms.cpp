// Closed rooms of every kind: paths that bounce about within them, at random and from edge to edge, stay in.
// docs/experiments/rooms.md has the figures; EYERAY_FULL_TESTS=1 makes them.
#include <fmt/format.h>

#include <atomic>
#include <set>
#include <string>

#include "host/core/parallel_for.hpp"
#include "host/pack/pack.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/random.hpp"
#include "tests/support/rooms.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::records;
using test::Random;

namespace {

// Rooms that still lose some paths (docs/experiments/rooms.md), at most 1 of 10 000.
const std::set<std::string> leaking = {"polygons with holes", "bilinear"};

constexpr const char* dark = R"(
[camera]
eye = [0, 0, 0]
target = [0, 0, -1]
[[material]]
name = 'm'
type = 'diffuse'
)";

// The hit of a ray, and the surface there; no slot if it hits nothing.
struct Seen {
  shader::Hit hit;
  shader::Surface surface;
};
Seen look(const shader::Ray& ray) {
  uint32_t flags = 0;
  Seen seen{};
  seen.hit = shader::trace(ray, flags);
  if (seen.hit.slot != NONE) seen.surface = shader::surface_at(shader::primitive_at(seen.hit), ray, seen.hit);
  return seen;
}

bool same_face(const Seen& a, const Seen& b) {
  return a.hit.id == b.hit.id &&
         glm::dot(Vec3(a.surface.normal_geometric), Vec3(b.surface.normal_geometric)) > 0.9;
}

// A direction towards the edge between the faces that `a` and `b` see, where these differ.
glm::vec3 towards_edge(const auto& start, const Vec3& a, const Vec3& b) {
  Vec3 low = a, high = b;
  const Seen there = look(start(glm::vec3(a)));
  for (int i = 0; i < 26; ++i) {
    const Vec3 middle = glm::normalize(low + high);
    (same_face(look(start(glm::vec3(middle))), there) ? low : high) = middle;
  }
  return glm::vec3(low);
}

struct Count {
  std::atomic<int64_t> rays = 0, leaks = 0;
};

// Follows paths of eight rays from points around `position`. Directions are random; if `at_edges`, two of
// three rays go towards an edge.
void follow_paths(const PackedScene& scene, const Vec3& position, bool at_edges, int paths, Count& count) {
  constexpr int parts = 64;
  parallel_for(0, parts, [&](int part) {
    const shader::Binding binding(twin::view_of(scene));
    Random random{uint64_t(part) + 1000 * test::seed() + 7};
    for (int i = 0; i < paths / parts; ++i) {
      const glm::vec3 middle(position + random.point(0.01));
      shader::Surface from{};
      for (int bounce = 0; bounce < 8; ++bounce) {
        const auto direction = [&] {
          const Vec3 d = random.direction();
          return bounce == 0 || glm::dot(d, Vec3(from.normal_geometric)) > 0 ? d : -d;
        };
        const auto start = [&](const glm::vec3& d) {
          return bounce == 0 ? shader::make_ray(middle, d) : shader::spawn_ray(from, d);
        };
        glm::vec3 d(direction());
        if (at_edges && bounce % 3 < 2) d = towards_edge(start, Vec3(d), direction());
        const Seen seen = look(start(d));
        ++count.rays;
        // A ray along a wall may hit either side of the wall. CSG objects turn its normal by 1e-6 then.
        const bool outside = seen.hit.slot == NONE || glm::dot(d, seen.surface.normal_geometric) < -2e-6f;
        count.leaks += outside;
        if (outside) break;
        from = shader::face_viewer(seen.surface, false);
      }
    }
  });
}

}  // namespace

// --subcase=NAME follows only the paths in one room.
TEST_CASE("paths that bounce within closed rooms stay inside, at random and from edge to edge") {
  const int paths = test::amount(500, 2'000, 1'250'000);
  for (const auto& [name, text] : test::rooms_with_cuts()) {
    SUBCASE(name.c_str()) {
      for (const Vec3& position : test::room_positions) {
        const PackedScene scene = pack::pack(test::scene_of_room(dark, text, position));
        for (const bool at_edges : {false, true}) {
          Count count;
          follow_paths(scene, position, at_edges, at_edges ? paths / 16 : paths, count);
          MESSAGE(fmt::format("{}, {}, {:.0f} away: {} rays, {} leak", name,
                              at_edges ? "at edges" : "at random", glm::length(position), count.rays.load(),
                              count.leaks.load()));
          CHECK(count.leaks <= (leaking.contains(name) ? 1 + paths / 10'000 : 0));
        }
      }
    }
  }
}
