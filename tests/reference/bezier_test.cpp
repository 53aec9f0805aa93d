#include "host/reference/crossings.hpp"
#include "host/reference/media.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::test;

namespace {

// A patch over the unit square, where x = u and z = v, from the heights of its control points.
std::array<Vec3, 16> sheet(const std::array<double, 16>& heights) {
  std::array<Vec3, 16> net;
  for (size_t i = 0; i < 16; ++i) net[i] = {double(i % 4) / 3, heights[i], double(i / 4) / 3};
  return net;
}

// y = u(1 − u), the same at all v: the control points of a parabola, raised by a degree.
const std::array<Vec3, 16> arch =
    sheet({0, 1. / 3, 1. / 3, 0, 0, 1. / 3, 1. / 3, 0, 0, 1. / 3, 1. / 3, 0, 0, 1. / 3, 1. / 3, 0});

}  // namespace

TEST_CASE("bezier: a parabolic arch from above, across, twice, along its top, and past it") {
  const auto patch = make_bezier(arch);
  const Ray down{{0.25, 5, 0.4}, {0, -1, 0}};
  const auto hit = patch->intersect(down);
  REQUIRE(hit.has_value());
  CHECK(near(hit->t, 5 - 0.1875, 1e-12));
  const SurfacePoint point = patch->surface(down, *hit);
  CHECK(near(point.position, Vec3(0.25, 0.1875, 0.4), 1e-12));
  CHECK(near(Vec3(point.uv, 0), Vec3(0.25, 0.4, 0), 1e-12));
  // ∂u = (1, 1 − 2u, 0), ∂v = (0, 0, 1).
  CHECK(near(point.normal_geometric, glm::normalize(Vec3(0.5, -1, 0)), 1e-12));

  // At the height 0.16 the arch is crossed at x = 0.2 and x = 0.8.
  CHECK(near(distance(*patch, {{-1, 0.16, 0.5}, {1, 0, 0}}), 1.2, 1e-12));
  CHECK(near(distance(*patch, {{0.5, 0.16, 0.5}, {2, 0, 0}}), 0.15, 1e-12));
  CHECK(near(distance(*patch, {{-1, 0.2499, 0.5}, {1, 0, 0}}), 1.49, 1e-12));
  CHECK(distance(*patch, {{-1, 0.2501, 0.5}, {1, 0, 0}}) == -1);
  CHECK(distance(*patch, {{0.9, 0.16, 0.5}, {1, 0, 0}}) == -1);
  CHECK(distance(*patch, {{0.25, 5, 1.0001}, {0, -1, 0}}) == -1);
}

TEST_CASE("bezier: the edge that is one point has the normal next to it") {
  // A flat patch whose edge v = 0 is all at the origin, where a quarter of a cone's mantle would have no
  // normal.
  std::array<Vec3, 16> net;
  for (size_t i = 0; i < 16; ++i) net[i] = Vec3(double(i % 4) / 3, 0, 1) * (double(i / 4) / 3);
  const auto patch = make_bezier(net);
  const Ray ray{{0, 2, 0}, {0, -1, 0}};
  const auto hit = patch->intersect(ray);
  REQUIRE(hit.has_value());
  CHECK(near(hit->t, 2, 1e-12));
  CHECK(near(patch->surface(ray, *hit).normal_geometric, Vec3(0, -1, 0), 1e-9));
}

TEST_CASE("bezier: the front stays in front under a mirror") {
  const auto patch = make_bezier(arch, glm::scale(Mat4(1.0), Vec3(-2, 1, 1)));
  const Ray down{{-0.5, 5, 0.4}, {0, -1, 0}};
  const auto hit = patch->intersect(down);
  REQUIRE(hit.has_value());
  CHECK(near(patch->surface(down, *hit).normal_geometric, glm::normalize(Vec3(-0.25, -1, 0)), 1e-12));
}

TEST_CASE("bezier: light loses the root of a patch's share at each crossing") {
  Scene scene = test::empty_scene();
  add(scene, make_bezier(arch), add(scene, make_dielectric({.shadow = 0.64})));
  const reference::Tracer tracer(scene);
  uint32_t flags = 0;
  CHECK(near(tracer.transmittance({{0.25, 5, 0.4}, {0, -1, 0}}, 9, flags), 0.8, 1e-12));
  CHECK(near(tracer.transmittance({{-1, 0.16, 0.5}, {1, 0, 0}}, 9, flags), 0.64, 1e-12));
  CHECK(near(tracer.transmittance({{-1, 0.16, 0.5}, {1, 0, 0}}, 1.5, flags), 0.8, 1e-12));
  CHECK(tracer.transmittance({{-1, 0.3, 0.5}, {1, 0, 0}}, 9, flags) == 1);
  CHECK(flags == 0);
}

TEST_CASE(
    "bezier: a patch 1e12 wide, and bent within 1, has no more crossings than its degree, and ends soon") {
  // A patch from a random scene. Rounding moves its points by 1e-4, so a ray that starts behind a crossing
  // finds itself before the crossing again.
  const std::array<Vec3, 16> net = {{{179.999999, 1, 0.2539326768112482},
                                     {0.9623034388921758, 1e12, 1e-15},
                                     {1e12, 1e12, 1e12},
                                     {1.9225030142171686, 1e12, -0.7907667265413876},
                                     {0.27421067733346716, -10000, -2.560252040233446},
                                     {2.0501391842752152, -0.8045385765627555, 2.118808284283485},
                                     {-1e12, 0.30059220687464183, 0},
                                     {-0.7977555923829602, 0.5504038988654751, 1e-05},
                                     {-2.0177938176073105, -1.7521170312322947, 2.1897936561558824},
                                     {-1.462325553570043, -1.7616118046545934, 0.547297368703517},
                                     {-1e12, 0.5341709501178302, 0.19721588912105137},
                                     {0.799210562908971, 2.6032970871683005, 1.7459668156094006},
                                     {1.27445425242102, -1e12, 1e6},
                                     {-2.2231534084685002, -179.999999, 0.7433079666662552},
                                     {-1.7880623871261339, 1.6397190894065377, -1e12},
                                     {1e12, 2.759438103651216, 1e12}}};
  const auto patch = make_bezier(net);
  const Vec3 eye(0.17017863274767997, -1.3617395706097102, 0);
  const Vec3 d = glm::normalize(Vec3(0.3141592653589793, 0.8979323846264338, 0.2718281828459045));
  for (const Vec3& along : {d, -d}) {
    int crossings = 0;
    reference::for_each_crossing(*patch, {eye, along},
                                 [&](double, const auto&, const auto&) { return ++crossings < 1000; });
    CHECK(crossings <= 18);
  }

  // A query of the media around the eye keeps the limit on crossings too.
  Scene scene = test::empty_scene();
  scene.materials.push_back(make_dielectric({}));
  scene.shapes.push_back(make_bezier(net));
  CHECK(reference::media_at(scene, eye).size() <= 36);
}
