// Tests of hits on the border of a surface that is 1 wide in u and v.
#include "host/records/packer.hpp"
#include "host/shapes/make.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::records;

namespace {

struct Case {
  std::string_view what;
  std::unique_ptr<Shape> shape;
};

std::vector<Case> unit_squares() {
  std::array<Vec3, 16> net;
  for (size_t i = 0; i < 16; ++i) net[i] = {double(i % 4) / 3, 1, double(i / 4) / 3};
  std::vector<Case> cases;
  cases.push_back({"bezier", make_bezier(net)});
  cases.push_back({"bilinear", make_bilinear({Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(1, 1, 1), Vec3(0, 1, 1)})});
  cases.push_back({"parallelogram", make_parallelogram({0, 1, 0}, {1, 0, 0}, {0, 0, 1})});
  return cases;
}

}  // namespace

TEST_CASE("a hit on the border u = v = 1 has uv just below 1, in both halves") {
  for (const Case& each : unit_squares()) {
    CAPTURE(each.what);
    Packer packer(Vec3(0));
    each.shape->pack(packer);
    const PackedScene scene = std::move(packer.scene);
    const shader::Binding binding(twin::view_of(scene));
    const shader::Ray down = shader::make_ray(glm::vec3(1, 2, 1), glm::vec3(0, -1, 0));
    shader::Hit hit{};
    hit.t = 1;
    hit.uv = glm::vec2(1, 1);
    shader::Surface surface{};
#define SURFACE(name, number)                 \
  if (kind_of(scene.primitives[0]) == number) \
    surface = shader::name##_surface(scene.primitives[0], down, hit);
    SHAPES(SURFACE)
    const Vec2 exact = each.shape->surface({{1, 2, 1}, {0, -1, 0}}, {.t = 1, .u = 1, .v = 1}).uv;
    for (const Vec2& uv : {Vec2(surface.uv), exact})
      for (const double part : {uv.x, uv.y}) {
        CHECK(part < 1);
        CHECK(part > 0.9999);
      }
  }
}
