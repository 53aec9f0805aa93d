// Instanced groups: every kind of shape looks the same in an instanced group as in a copied one.
#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "hard_scene.hpp"
#include "host/loader/scene_file.hpp"
#include "host/reference/tracer.hpp"
#include "host/shapes/registry.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
#include "tests/support/query_kernel.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::records;
using namespace eyeray::engine::test;

namespace {

// The shapes of scenes/shapes/KIND.toml as a group that stands four times, the last time sheared. Points
// cannot be sheared, so they are turned and mirrored instead.
std::string grouped(const shapes::ShapeType& type) {
  std::ifstream file(fmt::format("scenes/shapes/{}.toml", type.name));
  REQUIRE(file);
  std::string text = "[[group]]\nname = \"all\"\npattern = true\n";
  bool kept = false;
  for (std::string line; std::getline(file, line);) {
    if (const size_t at = line.find_first_not_of('['); at == 1 || at == 2) {
      const std::string_view table(line.data() + at, line.find_first_of(".]", at) - at);
      kept = table == "material" || table == type.name;
      if (table == type.name) line.insert(at, "group.");
    }
    if (kept) text += line + '\n';
  }
  const char* last = type.name == "points"
                         ? "{ rotate = { axis = [0, 1, 1], degrees = 70 } }, { scale = -0.5 }"
                         : "{ matrix = [[1, 0.4, 0, 5], [0, 0.6, 0.2, 90], [0.1, 0, -1.5, 3]] }";
  return text + R"(
[[instance]]
group = "all"
batch = { transform = [
  [],
  [{ rotate = { axis = [1, 2, 3], degrees = 50 } }, { scale = 0.3 }, { translate = [30, 4, -9] }],
  [{ scale = [-2, 2, 2] }, { translate = [-80, 10, 20] }],
  [)" + last +
         "],\n] }\n";
}

Scene stored(const std::string& text, std::string_view groups) {
  return parse_scene(fmt::format("[render]\ngroups = \"{}\"\n{}", groups, text), "scene.toml");
}

// The hit of a ray, and the surface there, from any executor.
struct Answer {
  int64_t primitive = -1;
  double t = 0;
  Vec3 position{0.0}, normal{0.0}, normal_geometric{0.0};
  Vec2 uv{0.0};
  uint32_t flags = 0;
};

Answer by_reference(const reference::Tracer& tracer, const Ray& ray) {
  uint32_t flags = 0;
  const auto hit = tracer.trace(ray, flags);
  if (!hit) return {.flags = flags};
  const SurfacePoint s = tracer.surface(ray, *hit);
  return {int64_t(hit->primitive), hit->at.t, s.position, s.normal, s.normal_geometric, s.uv, flags};
}

Answer by_twin(const PackedScene& scene, const Ray& at, const Vec3& eye) {
  const shader::Binding binding(twin::view_of(scene));
  const shader::Ray ray = shader::make_ray(glm::vec3(at.o - eye), glm::vec3(at.d));
  uint32_t flags = 0;
  const shader::Hit hit = shader::trace(ray, flags);
  if (hit.slot == NONE) return {.flags = flags};
  const shader::Surface s = shader::surface_at(shader::primitive_at(hit), ray, hit);
  return {int64_t(hit.id), double(hit.t), Vec3(s.p) + eye, Vec3(s.normal), Vec3(s.normal_geometric),
          Vec2(s.uv),      flags};
}

// The difference of two answers, where 1 is the largest that rounding may cause; infinite for different
// primitives.
double difference(const Answer& a, const Answer& b, double rounding, double size) {
  if (a.primitive != b.primitive || a.flags != b.flags) return HUGE_VAL;
  if (a.primitive < 0) return 0;
  // At the seam of uv that wrap around, a difference of 1 counts as none.
  const Vec2 uv = glm::abs(a.uv - b.uv);
  const double off = std::max(
      {std::abs(a.t - b.t) / size, magnitude(a.position - b.position) / size, magnitude(a.normal - b.normal),
       magnitude(a.normal_geometric - b.normal_geometric), std::min(uv.x, std::abs(1 - uv.x)), uv.y});
  return off / rounding;
}

}  // namespace

TEST_CASE(
    "every kind of shape: instances have their copies' hits, ids, normals and uv, by BVH and brute force") {
  for (const shapes::ShapeType* type : shapes::types()) {
    CAPTURE(type->name);
    const std::string text = grouped(*type);
    const Scene flat = stored(text, "flat");
    const Scene once = stored(text, "instanced");
    REQUIRE(once.primitive_count() == flat.primitive_count());
    if (!type->bounded) {
      CHECK(once.groups.empty());
      continue;
    }
    REQUIRE(once.shapes.empty());
    REQUIRE(once.group_instances.size() == 4);

    const reference::Tracer flat_tracer(flat), once_tracer(once);
    const PackedScene flat_records = pack::pack(flat);
    const PackedScene once_records = pack::pack(once, {.acceleration = Acceleration::bvh});
    const PackedScene once_brute = pack::pack(once, {.acceleration = Acceleration::brute_force});
    REQUIRE(once_records.has_bvh);
    const Vec3 eye = once.camera.eye;
    Random random(3);
    int hits = 0, wrong = 0, wrong_shader = 0, wrong_bvh = 0;
    for (int i = 0; i < 4000; ++i) {
      const Bounds box = flat.shapes[size_t(random.below(int(flat.shapes.size())))]->bounds();
      const Vec3 target =
          glm::mix(box.min, box.max, Vec3(random.uniform(), random.uniform(), random.uniform()));
      const double size = glm::length(box.max - box.min);
      Ray ray{target + random.direction() * size * random.log_uniform(0.1, 10), {}};
      ray.d = glm::normalize(target - ray.o);
      const Answer expected = by_reference(flat_tracer, ray);
      hits += expected.primitive >= 0;
      const double off = difference(by_reference(once_tracer, ray), expected, 1e-6, size);
      const Answer found = by_twin(once_records, ray, eye);
      const double off_shader = difference(found, by_twin(flat_records, ray, eye), 1e-3, size);
      wrong_bvh += difference(found, by_twin(once_brute, ray, eye), 1, size) != 0;
      wrong += off > 1;
      wrong_shader += off_shader > 1;
    }
    MESSAGE(fmt::format("{}: {} hits; reference {} differ, shaders {}, all where rays graze", type->name,
                        hits, wrong, wrong_shader));
    CHECK(hits > 400);
    CHECK(wrong_bvh == 0);
    CHECK(wrong <= 2);
    CHECK(wrong_shader <= 40);
  }
}

TEST_CASE("a ray that leaves a convex shape of a group outward does not hit it again") {
  const std::string shapes = R"(
[[material]]
name = "wall"
type = "phong"
[[group]]
name = "all"
pattern = true
[[group.ellipsoid]]
center = [0, 0, 0]
radii = [1, 0.3, 2]
material = "wall"
[[group.box]]
min = [4, 0, 0]
max = [5, 1, 0.1]
material = "wall"
[[group.capsule]]
from = [-6, 0, 0]
to = [-6, 3, 1]
radius = 0.5
material = "wall"
[[group.cylinder]]
from = [0, 7, 0]
to = [0, 9, 0]
radius = 1
material = "wall"
[[group.superellipsoid]]
center = [0, -7, 0]
radii = [1, 2, 1]
e = 0.5
n = 0.7
material = "wall"
)";
  for (const char* transform :
       {"{ translate = [0, 0, 0] }", "{ scale = 1e-4 }, { translate = [3e-4, 0, 1e-4] }",
        "{ scale = 1e4 }, { translate = [3e4, 1e4, -2e4] }",
        "{ scale = 1000 }, { translate = [148376, 1234, -223423] }",
        "{ matrix = [[1, 0.8, 0, 9], [0, 0.1, 0.5, 2], [0.3, 0, -3, 1]] }"}) {
    const Scene scene = stored(shapes + fmt::format("[[instance]]\ngroup = \"all\"\nbatch = {{ transform = "
                                                    "[[{}], [{{ translate = [0, 5e5, 0] }}]] }}\n",
                                                    transform),
                               "instanced");
    const PackedScene packed = pack::pack(scene);
    REQUIRE(packed.instances.size() == 2);
    const shader::Binding binding(twin::view_of(packed));
    const Bounds local = bounds(scene.groups[0], scene.meshes);
    const Affine map(scene.group_instances[0].transform);
    Random random(4);
    int left = 0, again_hit = 0;
    while (left < 20'000) {
      const Vec3 span(random.uniform(), random.uniform(), random.uniform());
      const Vec3 target = map.point(glm::mix(local.min, local.max, span)) - scene.camera.eye;
      const Vec3 origin = target + map.linear * (random.direction() * random.log_uniform(1, 100));
      const glm::vec3 start(origin);
      const shader::Ray ray = shader::make_ray(start, glm::normalize(glm::vec3(target) - start));
      uint32_t flags = 0;
      const shader::Hit hit = shader::trace(ray, flags);
      if (hit.slot == NONE || hit.id >= 5) continue;
      const shader::Surface surface = shader::surface_at(shader::primitive_at(hit), ray, hit);
      glm::vec3 away(random.direction());
      if (shader::dot3(away, surface.normal_geometric) < 0) away = -away;
      const shader::Hit again = shader::trace(shader::spawn_ray(surface, away), flags);
      ++left;
      again_hit += again.slot != NONE && again.id == hit.id;
    }
    CAPTURE(transform);
    CHECK(again_hit == 0);
  }
}
