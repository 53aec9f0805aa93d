// triangle.glsl: closed meshes do not leak, and rays that leave a triangle do not hit it again.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "host/core/parallel_for.hpp"
#include "host/records/packer.hpp"
#include "host/twin/shader_functions.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::records;
using test::Random;

namespace {

constexpr int chunks = 64;

struct ClosedMesh {
  std::vector<glm::vec3> vertices;
  std::vector<std::array<int, 3>> faces;
};

// A sphere made from an icosahedron with each face split in four, stretched along y.
ClosedMesh closed_mesh(const Vec3& centre, double radius, double stretch) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3> v = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                         {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<std::array<int, 3>> faces = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                           {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                           {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                           {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [entry, fresh] = middles.try_emplace(std::minmax(a, b), int(v.size()));
    if (fresh) v.push_back((v[size_t(a)] + v[size_t(b)]) * 0.5);
    return entry->second;
  };
  ClosedMesh mesh;
  for (const auto& [a, b, c] : faces) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& face : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
      mesh.faces.push_back(face);
  }
  for (const Vec3& p : v)
    mesh.vertices.push_back(glm::vec3(centre + glm::normalize(p) * radius * Vec3(1, stretch, 1)));
  return mesh;
}

shader::Primitive make_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const Vec3 n = glm::normalize(glm::cross(Vec3(b) - Vec3(a), Vec3(c) - Vec3(a)));
  shader::Primitive triangle{};
  triangle.extra = NONE;
  triangle.a = to_vec4(Vec3(a), n.x);
  triangle.b = to_vec4(Vec3(b), n.y);
  triangle.c = to_vec4(Vec3(c), n.z);
  return triangle;
}

using Intersect = float (*)(shader::Primitive, shader::Ray, shader::vec2&);

// The number of `count` rays from inside the mesh that escape it, aimed at random, at its edges or at its
// vertices.
enum class Aim { random, edges, vertices };
int leaks(const ClosedMesh& mesh, const Vec3& centre, const Vec3& reach, Aim aim, Intersect intersect,
          int count) {
  std::vector<shader::Primitive> triangles;
  for (const auto& [a, b, c] : mesh.faces)
    triangles.push_back(
        make_triangle(mesh.vertices[size_t(a)], mesh.vertices[size_t(b)], mesh.vertices[size_t(c)]));
  std::atomic<int> escaped = 0;
  parallel_for(0, chunks, [&](int chunk) {
    Random random{uint64_t(chunk) * 31 + uint64_t(aim)};
    for (int i = 0; i < count / chunks; ++i) {
      const glm::vec3 origin(centre + random.point(0.2) * reach);
      const auto& face = mesh.faces[size_t(random.below(int(mesh.faces.size())))];
      const Vec3 p(mesh.vertices[size_t(face[0])]);
      const Vec3 q(mesh.vertices[size_t(face[1])]);
      const Vec3 target = aim == Aim::random     ? Vec3(origin) + random.direction()
                          : aim == Aim::vertices ? p
                                                 : glm::mix(p, q, random.uniform());
      const shader::Ray ray = shader::make_ray(origin, glm::vec3(glm::normalize(target - Vec3(origin))));
      bool hit = false;
      shader::vec2 uv{};
      for (size_t k = 0; k < triangles.size() && !hit; ++k) hit = intersect(triangles[k], ray, uv) > 0;
      escaped += !hit;
    }
  });
  return escaped;
}

}  // namespace

TEST_CASE("closed meshes: 0 of 12 million rays leak, at the origin, far away, tiny, and as needles" *
          doctest::test_suite("long")) {
  constexpr int count = 1'000'000;
  const struct {
    const char* name;
    Vec3 centre;
    double radius;
    double stretch;
  } meshes[] = {{"at the origin", {0, 0, 0}, 1, 1},
                {"far away", {148376, 1234, -223423}, 1000, 1},
                {"radius 0.01", {0, 0, 0}, 0.01, 1},
                {"needles", {0, 0, 0}, 1, 0.001}};
  for (const auto& m : meshes) {
    const ClosedMesh mesh = closed_mesh(m.centre, m.radius, m.stretch);
    for (const Aim aim : {Aim::random, Aim::edges, Aim::vertices}) {
      const int escaped = leaks(mesh, m.centre, m.radius * Vec3(1, m.stretch, 1), aim,
                                shader::triangle_intersect_woop, count);
      MESSAGE(fmt::format("Woop, {}, aimed {}: {} of {} leak", m.name,
                          aim == Aim::random  ? "at random"
                          : aim == Aim::edges ? "at edges"
                                              : "at vertices",
                          escaped, count));
      CHECK(escaped == 0);
    }
  }
}

TEST_CASE("the same test detects leaks of Moeller and Trumbore's method") {
  const ClosedMesh mesh = closed_mesh({0, 0, 0}, 1, 1);
  for (const Aim aim : {Aim::edges, Aim::vertices}) {
    const int escaped =
        leaks(mesh, Vec3(0), Vec3(1), aim, shader::triangle_intersect_moller_trumbore, 200'000);
    MESSAGE(fmt::format("Moeller-Trumbore, aimed {}: {} of 200000 leak",
                        aim == Aim::edges ? "at edges" : "at vertices", escaped));
    CHECK(escaped > 0);
  }
}

TEST_CASE("both methods find t and the weights of random triangles to float32") {
  Random random(5);
  double worst_t = 0;
  double worst_uv = 0;
  int hits = 0;
  for (int i = 0; i < 2'000'000; ++i) {
    const glm::vec3 a(random.point(1)), b(random.point(1)), c(random.point(1));
    const Vec3 area = glm::cross(Vec3(b) - Vec3(a), Vec3(c) - Vec3(a));
    const Vec3 n = glm::normalize(area);
    const double u = random.uniform(), v = random.uniform(0, 1 - u);
    const Vec3 target = Vec3(a) * (1 - u - v) + Vec3(b) * u + Vec3(c) * v;
    const glm::vec3 origin(target + random.direction() * random.uniform(0.1, 4));
    const shader::Ray ray = shader::make_ray(origin, glm::vec3(glm::normalize(target - Vec3(origin))));
    const double cosine = std::fabs(glm::dot(Vec3(ray.d), n));
    if (cosine < 0.05 || glm::length(area) < 0.05) continue;  // well-conditioned ones only
    const double exact = glm::dot(Vec3(a) - Vec3(origin), n) / glm::dot(Vec3(ray.d), n);
    for (const Intersect intersect :
         {&shader::triangle_intersect_woop, &shader::triangle_intersect_moller_trumbore}) {
      shader::vec2 uv{};
      const float t = intersect(make_triangle(a, b, c), ray, uv);
      if (!(t > 0)) continue;  // at the border
      ++hits;
      worst_t = std::max(worst_t, std::fabs(double(t) - exact) / exact);
      worst_uv = std::max({worst_uv, std::fabs(double(uv.x) - u), std::fabs(double(uv.y) - v)});
    }
  }
  MESSAGE(fmt::format("{} hits, worst relative error of t {:.1e}, of the weights {:.1e}", hits, worst_t,
                      worst_uv));
  CHECK(hits > 1'000'000);
  CHECK(worst_t < 1e-4);
  CHECK(worst_uv < 1e-3);
}

TEST_CASE("a ray along an edge of a sliver hits the sliver, or nothing, by both methods") {
  // The ray lies in the triangle's plane: seen along the ray, all corners have y = 0. Moeller and Trumbore's
  // rounded weights report a hit.
  shader::Primitive sliver{};
  sliver.extra = NONE;
  sliver.a = {0.836856663F, -1.32419038F, 0.496149808F, -0.328005642F};
  sliver.b = {0.336856663F, -1.32419038F, 0.246149793F, -0.679751098F};
  sliver.c = {0.636856377F, -1.32419074F, 0.396149218F, 0.656011283F};
  const shader::Ray ray =
      shader::make_ray({39.0139923F, -1.32419038F, 19.5847187F}, {-0.89442718F, 0, -0.44721362F});
  const float nearest = (shader::corner_a(sliver).x - ray.o.x) / ray.d.x,
              farthest = (shader::corner_b(sliver).x - ray.o.x) / ray.d.x;
  for (const Intersect intersect :
       {shader::triangle_intersect_woop, shader::triangle_intersect_moller_trumbore}) {
    shader::vec2 uv{};
    const float t = intersect(sliver, ray, uv);
    CHECK((t == -1 || (t > nearest * (1 - 1e-6F) && t < farthest * (1 + 1e-6F))));
  }
}

TEST_CASE("of two triangles behind each other, a ray at their edge hits the nearer one") {
  for (const double away : {0.0, 1000.0}) {
    std::atomic<int> rays = 0, wrong = 0;
    parallel_for(0, chunks, [&](int chunk) {
      Random random{uint64_t(chunk) + 177};
      for (int i = 0; i < 2'000'000 / chunks; ++i) {
        const Vec3 centre = away * random.direction();
        const auto point = [&](double reach) { return glm::vec3(centre + random.point(reach)); };
        const glm::vec3 p = point(1), q = point(1), c[2] = {point(1), point(1)}, o = point(3);
        const Vec3 target = glm::mix(Vec3(p), Vec3(q), random.uniform());
        const shader::Ray ray = shader::make_ray(o, glm::vec3(glm::normalize(target - Vec3(o))));

        // The plane of ray and edge has both triangles on one side. A ray beside it shows which is nearer.
        const Vec3 side = glm::normalize(glm::cross(Vec3(p) - Vec3(o), Vec3(q) - Vec3(o)));
        const double sides[2] = {glm::dot(side, Vec3(c[0]) - Vec3(o)), glm::dot(side, Vec3(c[1]) - Vec3(o))};
        if (sides[0] * sides[1] < 0 || std::min(std::abs(sides[0]), std::abs(sides[1])) < 0.05) continue;
        const Vec3 beside = Vec3(ray.d) + side * std::copysign(1e-3, sides[0]);
        double lean[2];
        float t[2];
        for (int k = 0; k < 2; ++k) {
          const Vec3 n = glm::cross(Vec3(q) - Vec3(p), Vec3(c[k]) - Vec3(p));
          const auto t_along = [&](const Vec3& d) { return glm::dot(Vec3(p) - Vec3(o), n) / glm::dot(d, n); };
          const double slope = (t_along(beside) - t_along(Vec3(ray.d))) * 1e3;
          lean[k] = slope / (1 + std::abs(slope));
          shader::vec2 uv{};
          const auto triangle = k == 0 ? make_triangle(p, q, c[k]) : make_triangle(c[k], q, p);
          t[k] = shader::triangle_intersect_woop(triangle, ray, uv);
        }
        if (std::abs(lean[0] - lean[1]) < 0.75) continue;
        const int near = lean[0] < lean[1] ? 0 : 1;
        if (!(t[1 - near] > 0)) continue;
        ++rays;
        wrong += !(t[near] > 0 && t[near] < t[1 - near]);
      }
    });
    MESSAGE(fmt::format("{} away: {} of {} rays hit the farther one", away, wrong.load(), rays.load()));
    CHECK(rays > 200'000);
    CHECK(wrong < 300);  // 100 000 if rounding alone decides
  }
}

TEST_CASE("2 million rays leave a triangle, size 1e-4 to 1e4: none hits it again") {
  for (const Intersect intersect :
       {&shader::triangle_intersect_woop, &shader::triangle_intersect_moller_trumbore}) {
    std::atomic<int> rehits = 0;
    std::atomic<int> left = 0;
    parallel_for(0, chunks, [&](int chunk) {
      Random random{uint64_t(chunk) + 77};
      for (int i = 0; i < 2'000'000 / chunks; ++i) {
        const double size = random.log_uniform(1e-4, 1e4);
        const Vec3 centre = random.point(10 * size);
        // One in three lies flat on the floor, where only the rounding of the height may matter.
        const Vec3 reach = size * (random.below(3) == 0 ? Vec3(1, 0, 1) : Vec3(1));
        const auto vertex = [&] { return glm::vec3(centre + random.point(1) * reach); };
        const shader::Primitive triangle = make_triangle(vertex(), vertex(), vertex());
        const double u = random.uniform(), v = random.uniform(0, 1 - u);
        const Vec3 target = Vec3(triangle.a) * (1 - u - v) + Vec3(triangle.b) * u + Vec3(triangle.c) * v;
        const glm::vec3 origin(random.point(30 * size));
        const shader::Ray ray = shader::make_ray(origin, glm::vec3(glm::normalize(target - Vec3(origin))));
        shader::Hit hit{};
        hit.t = intersect(triangle, ray, hit.uv);
        if (!(hit.t > 0)) continue;
        ++left;
        const shader::Surface surface = shader::triangle_surface(triangle, ray, hit);
        shader::vec2 uv{};
        rehits += intersect(triangle, shader::spawn_ray(surface, glm::vec3(random.direction())), uv) > 0;
      }
    });
    MESSAGE(fmt::format("{}: {} left, {} re-hits",
                        intersect == &shader::triangle_intersect_woop ? "Woop" : "Moeller-Trumbore",
                        left.load(), rehits.load()));
    CHECK(left > 1'900'000);
    CHECK(rehits == 0);
  }
}
