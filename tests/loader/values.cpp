// Values of a scene file arrive in the Scene, to the last bit.
#include <rapidcheck.h>

#include <cmath>

#include "host/loader/scene_file.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/sampler.hpp"
//
#include "tests/support/camera.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

namespace {

Scene parse(const std::string& text) {
  return parse_scene(text, "scene.toml");
}

constexpr std::string_view matter = "[[material]]\nname = \"m\"\ntype = \"phong\"\n";

// The bounds of a unit sphere at [1, 0, 0] under a transform.
Bounds transformed(const std::string& transform) {
  const Scene scene =
      parse(std::string(matter) +
            "[[sphere]]\ncenter = [1, 0, 0]\nradius = 1\nmaterial = \"m\"\ntransform = " + transform);
  REQUIRE(scene.shapes.size() == 1);
  return scene.shapes[0]->bounds();
}

bool near(const Vec3& a, const Vec3& b) {
  return glm::length(a - b) <= 1e-12;
}

}  // namespace

TEST_CASE("an empty scene has the defaults of the model") {
  const Scene scene = parse("");
  const Scene model;
  CHECK(scene.image.width == model.image.width);
  CHECK(scene.image.height == model.image.height);
  CHECK(scene.image.samples == model.image.samples);
  CHECK(scene.image.pattern == model.image.pattern);
  CHECK(scene.camera.eye == model.camera.eye);
  CHECK(scene.camera.target == model.camera.target);
  CHECK(scene.camera.up == model.camera.up);
  const auto perspective = test::camera_as<PerspectiveCamera>(scene);
  CHECK(perspective.fov_degrees == PerspectiveCamera{}.fov_degrees);
  CHECK(perspective.fov_axis == PerspectiveCamera{}.fov_axis);
  CHECK(scene.render.integrator == model.render.integrator);
  CHECK(scene.render.max_depth == model.render.max_depth);
  CHECK(scene.render.min_throughput == model.render.min_throughput);
  CHECK(scene.render.seed == model.render.seed);
  CHECK(scene.render.triangle_method == model.render.triangle_method);
  CHECK(scene.render.background == model.render.background);
  CHECK(scene.render.ambient == model.render.ambient);
}

TEST_CASE("settings are read") {
  const Scene scene = parse(R"(
[image]
width = 65536
height = 4096
samples = 65536
pattern = "jittered"
[camera]
type = "orthographic"
eye = [1, 2, 3]
target = [4, 5, 6.5]
up = [0, 0, -2]
size = 7.25
[render]
integrator = "raycast"
max_depth = 0
min_throughput = 0
seed = 4294967295
triangle = "moller-trumbore"
background = [0.1, 0.2, 0.3]
ambient = 0.5
)");
  CHECK(scene.image.width == 65536);
  CHECK(scene.image.height == 4096);
  CHECK(scene.image.samples == 65536);
  CHECK(scene.image.pattern == SamplePattern::jittered);
  CHECK(scene.camera.eye == Vec3(1, 2, 3));
  CHECK(scene.camera.target == Vec3(4, 5, 6.5));
  CHECK(scene.camera.up == Vec3(0, 0, -2));
  CHECK(test::camera_as<OrthographicCamera>(scene).size == 7.25);
  CHECK(scene.render.integrator == IntegratorType::raycast);
  CHECK(scene.render.max_depth == 0);
  CHECK(scene.render.min_throughput == 0);
  CHECK(scene.render.seed == 4294967295u);
  CHECK(scene.render.triangle_method == TriangleMethod::moller_trumbore);
  CHECK(scene.render.background == Vec3(0.1, 0.2, 0.3));
  CHECK(scene.render.ambient == Vec3(0.5));
  const Scene wide = parse("[camera]\nfov = 179.5\nfov_axis = \"diagonal\"");
  CHECK(test::camera_as<PerspectiveCamera>(wide).fov_axis == FovAxis::diagonal);
}

TEST_CASE("lights are read") {
  const Scene scene = parse(R"(
[[light]]
type = "point"
position = [1, 2, 3]
intensity = [4, 5, 6]
falloff = "none"
[[light]]
type = "directional"
direction = [0, -3, 4]
)");
  REQUIRE(scene.lights.size() == 2);
  const auto point = std::get<PointLight>(scene.lights[0]->form());
  CHECK(point.position == Vec3(1, 2, 3));
  CHECK(point.intensity == Vec3(4, 5, 6));
  CHECK(point.falloff == Falloff::none);
  const auto sun = std::get<DirectionalLight>(scene.lights[1]->form());
  CHECK(near(sun.to_light, Vec3(0, 0.6, -0.8)));
  CHECK(sun.intensity == Vec3(1));
}

TEST_CASE("materials and textures are read") {
  const Scene scene = parse(R"(
[[material]]
name = "checks"
type = "phong"
diffuse = { checker = { even = [1, 2, 3], odd = 0.5, size = [2, 1] } }
[[material]]
name = "grey"
type = "phong"
diffuse = 0.25
[[material]]
name = "glass"
type = "dielectric"
ior = 1.75
)");
  REQUIRE(scene.materials.size() == 3);
  CHECK(scene.materials[0]->name == "checks");
  CHECK(scene.materials[0]->base_color(Vec2{1.5, 0.5}) == Vec3(1, 2, 3));
  CHECK(scene.materials[0]->base_color(Vec2{2.5, 0.5}) == Vec3(0.5));
  CHECK(scene.materials[1]->base_color(Vec2{0, 0}) == Vec3(0.25));
  CHECK(scene.materials[2]->medium()->ior == 1.75);
}

TEST_CASE("shapes are in registry order, then in file order, each with its material and position") {
  const Scene scene = parse(R"(
[[material]]
name = "a"
type = "phong"
[[material]]
name = "b"
type = "mirror"
[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "b"
[[sphere]]
center = [1, 0, 0]
radius = 1
material = "a"
[[sphere]]
center = [2, 0, 0]
radius = 1
material = "b"
)");
  REQUIRE(scene.shapes.size() == 3);
  CHECK(scene.shapes[0]->bounds().max.x == 2);
  CHECK(scene.shapes[1]->bounds().max.x == 3);
  CHECK(std::isinf(scene.shapes[2]->bounds().max.x));
  CHECK(scene.shapes[0]->material == 0);
  CHECK(scene.shapes[1]->material == 1);
  CHECK(scene.shapes[2]->material == 1);
  CHECK(scene.shapes[0]->position.line == 12);
  CHECK(scene.shapes[1]->position.line == 16);
  CHECK(scene.shapes[2]->position.line == 8);
}

TEST_CASE("transform steps are applied in the order written") {
  CHECK(near(transformed("[]").max, Vec3(2, 1, 1)));
  CHECK(near(transformed("[{ translate = [1, 2, 3] }]").max, Vec3(3, 3, 4)));
  CHECK(near(transformed("[{ scale = 2 }]").max, Vec3(4, 2, 2)));
  CHECK(near(transformed("[{ scale = [-1, 1, 1] }]").max, Vec3(0, 1, 1)));
  // A quarter turn about +y takes +x to −z.
  CHECK(near(transformed("[{ rotate = { axis = [0, 9, 0], degrees = 90 } }]").min, Vec3(-1, -1, -2)));
  CHECK(near(transformed("[{ translate = [1, 0, 0] }, { scale = 2 }]").max, Vec3(6, 2, 2)));
  CHECK(near(transformed("[{ scale = 2 }, { translate = [1, 0, 0] }]").max, Vec3(5, 2, 2)));
  CHECK(near(transformed("[{ matrix = [[0, 0, 1, 5], [1, 0, 0, 6], [0, 1, 0, 7]] }]").max, Vec3(6, 8, 8)));
}

TEST_CASE("a batch makes as many shapes as its lists have elements") {
  const Scene scene = parse(std::string(matter) + R"([[material]]
name = "n"
type = "mirror"
[[sphere]]
radius = 0.5
batch = { center = [[1, 0, 0], [2, 0, 0], [3, 0, 0]], material = ["m", "n", "m"], transform = [
  [], [{ scale = 2 }], [{ translate = [1, 0, 0] }] ] }
[[sphere]]
batch = { center = [], radius = [] }
material = "m"
[[sphere]]
center = [9, 0, 0]
radius = 1
material = "n"
)");
  REQUIRE(scene.shapes.size() == 4);
  CHECK(scene.shapes[0]->bounds().max == Vec3(1.5, 0.5, 0.5));
  CHECK(scene.shapes[1]->bounds().max == Vec3(5, 1, 1));
  CHECK(scene.shapes[2]->bounds().max == Vec3(4.5, 0.5, 0.5));
  CHECK(scene.shapes[3]->bounds().max == Vec3(10, 1, 1));
  CHECK(scene.shapes[0]->material == 0);
  CHECK(scene.shapes[1]->material == 1);
  CHECK(scene.shapes[2]->material == 0);
}

TEST_CASE("at most 255 materials let light through") {
  const auto glasses = [](int count) {
    std::string text;
    for (int i = 0; i < count; ++i)
      text += fmt::format("[[material]]\nname = \"g{}\"\ntype = \"dielectric\"\n", i);
    return text;
  };
  CHECK(parse(glasses(255)).materials.size() == 255);
  CHECK_THROWS_WITH_AS(parse(glasses(256)),
                       doctest::Contains("scene.toml:768:8: error: a scene can have at most 255"),
                       InputError);
}

TEST_CASE("numbers are read exactly, to the last bit") {
  const bool ok = rc::check("eye", [] {
    const auto coordinate =
        rc::gen::map(rc::gen::arbitrary<double>(), [](double x) { return std::fmod(x, 1e9); });
    const Vec3 eye(*coordinate, *coordinate, *coordinate);
    const Vec3 target = eye + Vec3(0, 0, 1e10);
    const Scene scene =
        parse(fmt::format("[camera]\neye = [{:.17e}, {:.17e}, {:.17e}]\ntarget = [{:.17e}, {:.17e}, {:.17e}]",
                          eye.x, eye.y, eye.z, target.x, target.y, target.z));
    RC_ASSERT(scene.camera.eye == eye);
    RC_ASSERT(scene.camera.target == target);
  });
  CHECK(ok);
}
