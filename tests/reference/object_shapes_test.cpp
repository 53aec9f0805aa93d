// Shapes in object space against numbers computed by hand.
#include "tests/support/random.hpp"
#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::test;

TEST_CASE("box: from outside, inside, behind, beside, and along a face") {
  const auto box = make_box({-1, 0, 2}, {1, 4, 3});
  CHECK(near(distance(*box, {{0, 1, 9}, {0, 0, -1}}), 6, 1e-14));
  CHECK(near(distance(*box, {{0, 1, 2.5}, {0, 0, -2}}), 0.25, 1e-14));
  CHECK(distance(*box, {{0, 1, 0}, {0, 0, -1}}) == -1);
  CHECK(distance(*box, {{1.001, 1, 9}, {0, 0, -1}}) == -1);
  CHECK(near(distance(*box, {{1, 1, 9}, {0, 0, -1}}), 6, 1e-14));
  CHECK(near(distance(*box, {{-5, 4, 2.5}, {1, 0, 0}}), 4, 1e-14));
  CHECK(near(surface_hit(*box, {{0.5, 9, 2.25}, {0, -1, 0}}).position, Vec3(0.5, 4, 2.25), 1e-14));
  CHECK(box->bounds().min == Vec3(-1, 0, 2));
  CHECK(box->bounds().max == Vec3(1, 4, 3));
}

TEST_CASE("box: uv are upright on every face, seen from outside") {
  const auto box = make_box({0, 0, 0}, {1, 1, 1});
  const auto uv = [&](const Vec3& at, const Vec3& outward) {
    const SurfacePoint point = surface_hit(*box, {at + outward, -outward});
    CHECK(near(point.normal_geometric, outward, 1e-15));
    return point.uv;
  };
  CHECK(near(uv({0.25, 0.75, 1}, {0, 0, 1}), Vec2(0.25, 0.75), 1e-14));
  CHECK(near(uv({0.25, 0.75, 0}, {0, 0, -1}), Vec2(0.75, 0.75), 1e-14));
  CHECK(near(uv({1, 0.75, 0.25}, {1, 0, 0}), Vec2(0.75, 0.75), 1e-14));
  CHECK(near(uv({0, 0.75, 0.25}, {-1, 0, 0}), Vec2(0.25, 0.75), 1e-14));
  CHECK(near(uv({0.25, 1, 0.75}, {0, 1, 0}), Vec2(0.25, 0.25), 1e-14));
  CHECK(near(uv({0.25, 0, 0.75}, {0, -1, 0}), Vec2(0.25, 0.75), 1e-14));
}

TEST_CASE("ellipsoid: each radius along its axis, normals by the gradient, bounds touch it under any map") {
  const auto ellipsoid = make_ellipsoid({1, 0, 0}, {3, 2, 1});
  CHECK(near(distance(*ellipsoid, {{9, 0, 0}, {-1, 0, 0}}), 5, 1e-14));
  CHECK(near(distance(*ellipsoid, {{1, 0, 0}, {0, 0, 1}}), 1, 1e-14));
  CHECK(distance(*ellipsoid, {{1, 2.001, 9}, {0, 0, -1}}) == -1);
  // x = 1 + 3·0.6, y = 2·0.8: the gradient is (0.6/3, 0.8/2, 0).
  const SurfacePoint point = surface_hit(*ellipsoid, {{2.8, 9, 0}, {0, -1, 0}});
  CHECK(near(point.position, Vec3(2.8, 1.6, 0), 1e-14));
  CHECK(near(point.normal, glm::normalize(Vec3(0.2, 0.4, 0)), 1e-14));

  Mat4 shear(1.0);
  shear[1][0] = 1;  // x += y
  const Bounds bounds = make_ellipsoid({0, 0, 0}, {1, 1, 1}, shear)->bounds();
  CHECK(near(bounds.max, Vec3(std::sqrt(2.0), 1, 1), 1e-15));
}

TEST_CASE("a sphere under a transform that is no similarity is the transformed surface, uv included") {
  const Mat4 map{{2, 0, 0, 0}, {1, 3, 0, 0}, {0, 0, -0.5, 0}, {5, 6, 7, 1}};
  const auto plain = make_sphere({1, 2, 3}, 0.7), mapped = make_sphere({1, 2, 3}, 0.7, map);
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 out = random.direction(), from = Vec3(1, 2, 3) + out * 2.0;
    const SurfacePoint here = surface_hit(*plain, {from, -out});
    const SurfacePoint there = surface_hit(*mapped, {Vec3(map * Vec4(from, 1)), Vec3(map * Vec4(-out, 0))});
    CHECK(near(there.position, Vec3(map * Vec4(here.position, 1)), 1e-13));
    CHECK(near(Vec3(there.uv, 0), Vec3(here.uv, 0), 1e-12));
  }
}

TEST_CASE("cylinder: side, caps, open, and rays along its axis") {
  const auto closed = make_cylinder({0, 1, 0}, {0, 5, 0}, 2);
  const auto open = make_cylinder({0, 1, 0}, {0, 5, 0}, 2, true);
  CHECK(near(distance(*closed, {{9, 3, 0}, {-1, 0, 0}}), 7, 1e-14));
  CHECK(near(distance(*closed, {{1, 9, 0}, {0, -1, 0}}), 4, 1e-14));
  CHECK(near(distance(*closed, {{1, 3, 0}, {0, -1, 0}}), 2, 1e-14));
  CHECK(distance(*open, {{1, 9, 0}, {0, -1, 0}}) == -1);
  CHECK(distance(*closed, {{2.001, 9, 0}, {0, -1, 0}}) == -1);
  // A ray through the open end hits the side from inside.
  const SurfacePoint within = surface_hit(*open, {{0, 7, 0}, {-1, -2, 0}});
  CHECK(near(within.position, Vec3(-2, 3, 0), 1e-14));
  CHECK(near(within.normal_geometric, Vec3(-1, 0, 0), 1e-14));
  CHECK(near(surface_hit(*closed, {{9, 2, 0}, {-1, 0, 0}}).uv, Vec2(0.5, 0.25), 1e-14));
  CHECK(near(surface_hit(*closed, {{0, 2, 9}, {0, 0, -1}}).uv, Vec2(0.25, 0.25), 1e-14));
  CHECK(near(surface_hit(*closed, {{1, 9, 0}, {0, -1, 0}}).uv, Vec2(0.75, 0.5), 1e-14));
}

TEST_CASE("cone: the apex, the slope, and not its mirror image") {
  const auto cone = make_cone({0, 0, 0}, {0, 2, 0}, 1);
  CHECK(near(distance(*cone, {{9, 1, 0}, {-1, 0, 0}}), 8.5, 1e-14));
  CHECK(near(surface_hit(*cone, {{9, 1, 0}, {-1, 0, 0}}).normal, glm::normalize(Vec3(2, 1, 0)), 1e-14));
  CHECK(distance(*cone, {{9, 3, 0}, {-1, 0, 0}}) == -1);  // the other nappe
  CHECK(near(distance(*cone, {{0.5, -3, 0}, {0, 1, 0}}), 3, 1e-14));
  CHECK(near(distance(*cone, {{0.5, 0.5, 0}, {0, 1, 0}}), 0.5, 1e-14));
  // For a ray along a line of the side, the equation is linear.
  CHECK(near(distance(*cone, {{-1, -2, 0}, {1, 2, 0}}), 1, 1e-13));

  // Reversed and cut off: the larger end is at `to`.
  const auto cut = make_cone({0, 0, 0}, {0, 2, 0}, 1, 2, true);
  CHECK(near(distance(*cut, {{9, 1, 0}, {-1, 0, 0}}), 7.5, 1e-14));
  CHECK(distance(*cut, {{0, 9, 0}, {0, -1, 0}}) == -1);
  CHECK(near(surface_hit(*cut, {{9, 1.5, 0}, {-1, 0, 0}}).uv, Vec2(0.5, 0.25), 1e-14));
}

TEST_CASE("an axis keeps u = ½ towards the world's +x, and outside is outside under a mirror") {
  for (const Vec3& to : {Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 3, -4)}) {
    const auto cylinder = make_cylinder({0, 0, 0}, to, 0.5, true);
    CHECK(near(surface_hit(*cylinder, {to * 0.5 + Vec3(9, 0, 0), {-1, 0, 0}}).uv.x, 0.5, 1e-15));
  }
  const auto mirrored = make_cone({0, 0, 0}, {0, 2, 0}, 1, 0, false, glm::scale(Mat4(1.0), Vec3(1, -1, 1)));
  CHECK(near(surface_hit(*mirrored, {{9, -1, 0}, {-1, 0, 0}}).normal, glm::normalize(Vec3(2, -1, 0)), 1e-14));
}
