// Looks of a mesh alone: lights, a floor below the model, and who decides.
#include <algorithm>

#include "host/core/error.hpp"
#include "host/loader/scene_file.hpp"
#include "host/scene/integrator.hpp"

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
  CHECK(plain.render.integrator == load_scene("scenes/meshes/knot.ply").render.integrator);
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
    CHECK((*floor)->bounds().min.y == doctest::Approx(lowest));
    CHECK(scene->camera.eye == plain.camera.eye);
  }
}

TEST_CASE(
    "an environment replaces a look's lights, other options change it, and floors need formulas to fade") {
  const Scene around = look("studio", {{"environment.type=sky"}, {"environment.sun=[0,1,0]"}});
  CHECK(emitters(around) == 0);
  CHECK(look("studio", {{"image.samples=7"}}).image.samples == 7);
  CHECK(look("studio", {{"look=\"plain\""}}).shapes.empty());
  const auto fades = [](const Scene& scene) {
    return std::ranges::any_of(scene.materials,
                               [](const auto& material) { return material->mask.has_value(); });
  };
  CHECK(fades(look("studio")));
  CHECK(!fades(look("studio", {}, {.formulas = false})));
}

TEST_CASE("an unknown look, and a look of a scene, are refused") {
  CHECK(complaint([] { look("studios"); }) == "-D look=studios: a look is plain, studio, clay, sky");
  CHECK(
      complaint(
          [] { load_scene("scenes/whitted.toml", std::vector<Override>{{"look=clay", "--look clay"}}); }) ==
      "--look clay: scenes/whitted.toml is a scene, which has a look of its own; a look is for a mesh alone");
}
