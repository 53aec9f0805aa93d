#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::test;

TEST_CASE("torus: four successive crossings, the hole and the pole") {
  // About the x axis through (1, 2, 3): the tube runs at the distance 2 and is 0.5 thick.
  const auto torus = make_torus({1, 2, 3}, {2, 0, 0}, 2, 0.5);
  CHECK(near(distance(*torus, {{1, 12, 3}, {0, -1, 0}}), 7.5, 1e-13));
  CHECK(near(distance(*torus, {{1, 4, 3}, {0, -1, 0}}), 0.5, 1e-13));
  CHECK(near(distance(*torus, {{1, 2, 3}, {0, -2, 0}}), 0.75, 1e-13));
  CHECK(near(distance(*torus, {{1, 0, 3}, {0, -1, 0}}), 0.5, 1e-13));
  CHECK(distance(*torus, {{1, -1, 3}, {0, -1, 0}}) == -1);
  CHECK(distance(*torus, {{9, 2, 3}, {-1, 0, 0}}) == -1);
  CHECK(distance(*torus, {{9, 3.49, 3}, {-1, 0, 0}}) == -1);
  CHECK(near(distance(*torus, {{9, 4, 3}, {-1, 0, 0}}), 7.5, 1e-13));
  // A ray in the middle plane of the hole, at distance 1 from the axis: (y − 2)² = (2 ± 0.5)² − 1.
  CHECK(near(distance(*torus, {{1, 12, 4}, {0, -1, 0}}), 10 - std::sqrt(5.25), 1e-13));
  CHECK(near(distance(*torus, {{1, 2, 4}, {0, -1, 0}}), std::sqrt(1.25), 1e-13));

  const SurfacePoint point = surface_hit(*torus, {{9, 4, 3}, {-1, 0, 0}});
  CHECK(near(point.position, Vec3(1.5, 4, 3), 1e-13));
  CHECK(near(point.normal_geometric, Vec3(1, 0, 0), 1e-13));
  const SurfacePoint hole = surface_hit(*torus, {{1, 2, 3}, {0, 0, -1}});
  CHECK(near(hole.position, Vec3(1, 2, 1.5), 1e-13));
  CHECK(near(hole.normal_geometric, Vec3(0, 0, 1), 1e-13));
  CHECK(near(torus->bounds().min, Vec3(0.5, -0.5, 0.5), 1e-14));
  CHECK(near(torus->bounds().max, Vec3(1.5, 4.5, 5.5), 1e-14));
}

TEST_CASE("torus: uv and the outside are kept under a mirror that stretches") {
  const auto torus = make_torus({0, 0, 0}, {0, 1, 0}, 2, 0.5);
  CHECK(near(Vec3(surface_hit(*torus, {{9, 0, 0}, {-1, 0, 0}}).uv, 0), Vec3(0.5, 0.5, 0), 1e-14));
  CHECK(near(Vec3(surface_hit(*torus, {{0, 0, 9}, {0, 0, -1}}).uv, 0), Vec3(0.25, 0.5, 0), 1e-14));
  CHECK(near(Vec3(surface_hit(*torus, {{2, 9, 0}, {0, -1, 0}}).uv, 0), Vec3(0.5, 0.75, 0), 1e-14));
  CHECK(near(Vec3(surface_hit(*torus, {{2, -9, 0}, {0, 1, 0}}).uv, 0), Vec3(0.5, 0.25, 0), 1e-14));
  CHECK(near(Vec3(surface_hit(*torus, {{0, 0, 0}, {1, 0, 0}}).uv, 0), Vec3(0.5, 0, 0), 1e-14));

  const auto other = make_torus({0, 0, 0}, {0, 1, 0}, 2, 0.5,
                                glm::translate(glm::scale(Mat4(1.0), Vec3(-3, 2, 1)), Vec3(1, 0, 0)));
  const SurfacePoint point = surface_hit(*other, {{-20, 0, 0}, {1, 0, 0}});
  CHECK(near(point.position, Vec3(-10.5, 0, 0), 1e-12));
  CHECK(near(point.normal_geometric, Vec3(-1, 0, 0), 1e-13));
  const SurfacePoint top = surface_hit(*other, {{-9, 9, 0}, {0, -1, 0}});
  CHECK(near(top.position, Vec3(-9, 1, 0), 1e-12));
  CHECK(near(top.normal_geometric, Vec3(0, 1, 0), 1e-13));
}

TEST_CASE("torus: a point aimed at is a point hit, however thin, from all distances") {
  Dice dice;
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const double minor = dice.scale(-4, -0.01);
    const auto torus = make_torus({0, 0, 0}, {0, 1, 0}, 1, minor);
    const double u = dice.between(0, 6.28), v = dice.between(0, 6.28);
    const Vec3 around(std::cos(u), 0, std::sin(u));
    const Vec3 normal = around * std::cos(v) + Vec3(0, std::sin(v), 0);
    const Vec3 target = around + normal * minor;
    // From within the tube: surfaces beyond cannot be nearer.
    const Vec3 from = around + normal * (minor * dice.between(0, 0.99));
    const double expected = glm::length(target - from);
    worst = std::max(worst, std::abs(distance(*torus, {from, normal}) - expected));
    // A ray back along the same line from afar hits the torus, at the target or before it.
    const double far = dice.scale(0, 4);
    const double first = distance(*torus, {target + normal * far, -normal});
    CHECK(first > 0);
    CHECK(first < far + 1e-10);
  }
  MESSAGE("greatest error of t: " << worst);
  CHECK(worst < 1e-12);
}
