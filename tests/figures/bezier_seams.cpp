// A closed surface of Bézier patches, some of whose edges are points: no ray leaves it where pieces or
// patches join.
#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "host/core/parallel_for.hpp"
#include "host/shapes/bezier_net.hpp"
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

// An eighth of a ball of nearly radius 1, next to the pole (0, ±1, 0): the whole edge v = 1 is that point.
BezierNet eighth(int quarter, double side) {
  constexpr double k = 0.5522847498;
  const double radius[] = {1, 1, k, 0}, height[] = {0, k, 1, 1};
  const double x[] = {1, 1, k, 0}, z[] = {0, k, 1, 1};
  BezierNet net;
  for (size_t i = 0; i < 4; ++i)
    for (size_t j = 0; j < 4; ++j) {
      Vec3 p(radius[i] * x[j], side * height[i], radius[i] * z[j]);
      for (int turn = 0; turn < quarter; ++turn) p = {-p.z, p.y, p.x};
      net[4 * i + j] = p;
    }
  return net;
}

enum class Aim { seams, corners, poles };

}  // namespace

TEST_CASE("no ray leaves a ball of Bézier patches at borders of pieces, corners or poles") {
  const char* names[] = {"borders", "corners", "poles"};
  for (const Aim aim : {Aim::seams, Aim::corners, Aim::poles}) {
    std::atomic<int> rays = 0, leaks = 0, doubtful = 0;
    parallel_for(0, 64, [&](int part) {
      Random random{uint64_t(part)};
      const double size = random.log_uniform(1e-4, 1e4);
      const Vec3 center = random.point(10 * size);
      // Patches whose edges agree except in their last bits.
      std::vector<BezierNet> nets;
      Packer packer(Vec3(0));
      for (const int quarter : {0, 1, 2, 3})
        for (const double side : {1.0, -1.0}) {
          BezierNet net = eighth(quarter, side);
          for (Vec3& p : net) p = center + size * Vec3(p.x, 0.7 * p.y + 0.2 * p.x, p.z);
          make_bezier(net)->pack(packer);
          nets.push_back(net);
        }
      const shader::Binding binding(twin::view_of(packer.scene));
      for (int i = 0; i < test::amount(500, 2000, 2000); ++i) {
        const shader::Primitive& piece =
            packer.scene.primitives[size_t(random.below(int(packer.scene.primitives.size())))];
        const BezierNet& patch = nets[size_t(piece.extra) / 13];
        const shader::vec4 span = shader::bezier_span(piece);
        Vec2 uv(random.uniform(double(span.x), double(span.y)),
                random.uniform(double(span.z), double(span.w)));
        if (aim == Aim::corners || random.below(2) == 0) uv.x = double(random.below(2) ? span.x : span.y);
        if (aim == Aim::corners || uv.x != double(span.x)) uv.y = double(random.below(2) ? span.z : span.w);
        if (aim == Aim::poles) uv.y = 1 - random.log_uniform(1e-9, 1e-2) * random.below(2);
        const glm::vec3 target(bezier_point(patch, uv.x, uv.y).position);
        const glm::vec3 from(center + random.point(0.4) * size);
        const shader::Ray ray = shader::make_ray(from, glm::normalize(target - from));
        bool hit = false, gave_up = false;
        for (const shader::Primitive& each : packer.scene.primitives) {
          shader::vec2 ignored{};
          if (shader::bezier_reject(each, ray)) continue;
          const float t = shader::bezier_intersect(each, ray, ignored);
          hit = hit || (t > 0 && t < T_MISS);
          gave_up = gave_up || t == T_ITERATION_LIMIT;
        }
        ++rays;
        leaks += !hit;
        doubtful += gave_up;
      }
    });
    MESSAGE(fmt::format("{}: {} rays, {} leak, {} reached the iteration limit", names[int(aim)], rays.load(),
                        leaks.load(), doubtful.load()));
    CHECK(leaks == 0);
    CHECK(doubtful == 0);
  }
}
