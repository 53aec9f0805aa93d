// Looks of a mesh alone: lights, a floor below the model, and who decides.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/error.hpp"
#include "host/loader/scene_file.hpp"
#include "host/scene/integrator.hpp"

#include "tests/support/camera.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

namespace {

Scene look(const std::string& name, std::vector<Override> others = {}, const Trust& trust = {}) {
  others.insert(others.begin(), {"look=" + name});
  return load_scene("scenes/meshes/knot.ply", others, trust);
}

size_t emitters(const Scene& scene) {
  return size_t(std::ranges::count_if(scene.shapes, [&](const auto& shape) {
    return scene.materials[size_t(shape->material)]->constant_emission().value_or(Vec3(0.0)) != Vec3(0.0);
  }));
}

// The message of the error; empty if there is no error.
template <typename Load>
std::string complaint(const Load& load) {
  try {
    load();
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::bad_input);
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("studio and clay have three area lights and a floor that touches the model; sky has a sky") {
  const Scene plain = look("plain"), studio = look("studio"), clay = look("clay"), sky = look("sky");
  CHECK(plain.shapes.empty());
  CHECK(plain.render.integrator == IntegratorType::whitted);
  CHECK(emitters(studio) == 3);
  CHECK(emitters(clay) == 3);
  CHECK(emitters(sky) == 0);
  CHECK(sky.environment != nullptr);
  double lowest = 1e9;
  for (const Vec3& p : plain.meshes[0].positions)
    lowest = std::min(lowest, (plain.instances[0].transform * Vec4(p, 1)).y);
  for (const Scene* scene : {&studio, &clay, &sky}) {
    CHECK(scene->render.integrator == IntegratorType::path);
    CHECK(scene->lights.size() == (scene == &sky ? 1 : 0));  // the sun
    const auto floor =
        std::ranges::find_if(scene->shapes, [](const auto& shape) { return shape->type == "disk"; });
    REQUIRE(floor != scene->shapes.end());
    CHECK((*floor)->bounds().min.y == doctest::Approx(lowest).epsilon(1e-3));
    CHECK(scene->camera.eye == plain.camera.eye);
  }
}

TEST_CASE("an environment replaces a look's lights, and other options change it") {
  const Scene around = look("studio", {{"environment.type=sky"}, {"environment.sun=[0,1,0]"}});
  CHECK(emitters(around) == 0);
  CHECK(look("studio", {{"image.samples=7"}}).image.samples == 7);
  CHECK(look("studio", {{"look=\"plain\""}}).shapes.empty());
}

TEST_CASE(
    "the floor fades into the background: it emits a constant one, blends with others, and needs formulas") {
  const auto floor = [](const Scene& scene) -> const Material& {
    return *std::ranges::find(scene.materials, "studio floor", &Material::name)->get();
  };
  const auto seen = [](const Material& material, double radius) {
    const TextureContext point{Vec2(0.5 + radius / 2, 0.5), Vec3(0)};
    const Scattering at =
        material.scattering({.point = point, .cos_view = 1, .ior_from = 1, .ior_to = 1, .color = Vec3(1)});
    return std::pair(at.emitted, at.diffuse);
  };
  const Scene studio = look("studio");
  CHECK(!floor(studio).mask);
  CHECK(!floor(studio).samples_emission);
  const Vec3 background = studio.render.background, color = seen(floor(studio), 0).second;
  CHECK(seen(floor(studio), 0).first == Vec3(0));
  CHECK(glm::length(seen(floor(studio), 1).first - background) < 1e-7);
  CHECK(seen(floor(studio), 1).second == Vec3(0));
  // In between, the shares of both add up to 1.
  const auto [emitted, reflected] = seen(floor(studio), 0.6);
  CHECK(emitted.x / background.x + reflected.x / color.x == doctest::Approx(1));
  CHECK(reflected.x > 0);
  CHECK(reflected.x < color.x);

  for (const char* other : {"render.background=1", "render.integrator=sppm", "medium.absorption=0.1"})
    CHECK(floor(look("studio", {{other}})).mask);
  CHECK(floor(look("studio", {{"environment.type=sky"}, {"environment.sun=[0,1,0]"}})).mask);
  CHECK(floor(look("sky")).mask);
  const Scene unfaded = look("studio", {}, {.formulas = false});
  CHECK(!floor(unfaded).mask);
  CHECK(!floor(unfaded).emits());
}

TEST_CASE("a mesh alone has the look of a studio, but a plain one under integrators without random paths") {
  const auto shapes_under = [](std::vector<Override> overrides) {
    return load_scene("scenes/meshes/knot.ply", overrides).shapes.size();
  };
  CHECK(shapes_under({}) == 4);
  CHECK(shapes_under({{"render.integrator=path"}}) == 4);
  CHECK(shapes_under({{"render.integrator=sppm"}}) == 4);
  CHECK(shapes_under({{"render.integrator=whitted"}}) == 0);
  CHECK(shapes_under({{"render.integrator=\"raycast\""}}) == 0);
  CHECK(shapes_under({{"render.integrator=whitted"}, {"render.integrator=path"}}) == 4);
  CHECK(shapes_under({{"look=studio"}, {"render.integrator=whitted"}}) == 4);
  CHECK(shapes_under({{"look=plain"}}) == 0);

  const Scene studio = load_scene("scenes/meshes/knot.ply");
  CHECK(studio.render.integrator == IntegratorType::path);
  CHECK(studio.render.denoise);
  CHECK(studio.image.meters);
  CHECK(!load_scene("scenes/meshes/knot.ply", std::vector<Override>{{"image.exposure=1"}}).image.meters);
  CHECK(complaint([] {
          load_scene("scenes/meshes/knot.ply", std::vector<Override>{{"render.integrator=pth"}});
        }).find("`integrator` must be") != std::string::npos);
}

TEST_CASE("a turntable turns the model once, all of it within the picture") {
  const Scene still = load_scene("scenes/meshes/knot.ply");
  const auto turned = [](int frame) {
    return load_scene("scenes/meshes/knot.ply",
                      std::vector<Override>{{"turntable=8"}, {fmt::format("animation.frame={}", frame)}});
  };
  CHECK(turned(0).animation.tracks == 1);
  CHECK(still.animation.tracks == 0);
  const auto& positions = still.meshes[0].positions;
  Vec3 low = positions[0], high = positions[0];
  for (const Vec3& p : positions) low = glm::min(low, p), high = glm::max(high, p);
  const Vec3 centre = (low + high) / 2.0;
  for (int frame = 0; frame < 8; ++frame) {
    const Scene scene = turned(frame);
    CHECK(scene.camera.eye == turned(0).camera.eye);
    const double angle = glm::radians(45.0 * frame);
    for (const Vec3& p : positions) {
      const Vec3 d = p - centre;
      const Vec3 expected = centre + Vec3(std::cos(angle) * d.x + std::sin(angle) * d.z, d.y,
                                          std::cos(angle) * d.z - std::sin(angle) * d.x);
      const Vec3 world = scene.instances[0].transform * Vec4(p, 1);
      REQUIRE(glm::length(world - expected) < 1e-6);
      const Vec2 seen = test::position_seen(scene, world);
      REQUIRE(std::abs(seen.x) < 1);
      REQUIRE(std::abs(seen.y) * scene.image.width < scene.image.height);
    }
  }
  for (const char* wrong :
       {"turntable=1", "turntable=", "turntable=x", "turntable=2.5", "turntable=99999999999"})
    CHECK(complaint([&] { load_scene("scenes/meshes/knot.ply", std::vector<Override>{{wrong}}); }) ==
          fmt::format("-D {}: a turntable has 2 to 1000000 frames", wrong));
}

TEST_CASE("an unknown look, and a look of a scene, are refused") {
  CHECK(complaint([] { look("studios"); }) == "-D look=studios: a look is plain, studio, clay, sky");
  CHECK(complaint([] {
          load_scene("scenes/whitted.toml", std::vector<Override>{{"look=clay", "--look clay"}});
        }) == "--look clay: a look is for a mesh alone, and scenes/whitted.toml is a scene");
  CHECK(complaint([] { load_scene("scenes/whitted.toml", std::vector<Override>{{"camera=front"}}); }) ==
        "-D camera=front: a camera by name is for a mesh alone, and scenes/whitted.toml is a scene");
}
