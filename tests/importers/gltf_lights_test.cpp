// The cameras and lights of glTF files.
#include <cmath>
#include <numbers>

#include "gltf_files.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

TEST_CASE("the first camera and all lights are imported") {
  GltfFile file = square_file();
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"intensity", std::numbers::pi}, {"color", {1, 0.5, 0}}},
      {{"type", "directional"}, {"intensity", 2 * std::numbers::pi}},
      {{"type", "spot"}, {"range", 3}}};
  const auto light = [](int index) { return Json{{"KHR_lights_punctual", {{"light", index}}}}; };
  file.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", std::numbers::pi / 4}, {"znear", 1}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2}}}, {"name", "plan"}}};
  file.json["nodes"] = {{{"mesh", 0}},
                        {{"camera", 0}, {"name", "front"}, {"translation", {1, 2, 3}}},
                        {{"camera", 1}},
                        {{"extensions", light(0)}, {"translation", {4, 5, 6}}},
                        {{"extensions", light(1)}, {"rotation", {-0.70710678, 0, 0, 0.70710678}}},
                        {{"extensions", light(2)}}};
  file.json.erase("scenes");
  const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  REQUIRE(scene.cameras.size() == 2);
  const ImportedCamera& camera = scene.cameras[0];
  CHECK(camera.eye == Vec3(1, 2, 3));
  CHECK(glm::normalize(camera.target - camera.eye) == Vec3(0, 0, -1));
  CHECK(camera.up == Vec3(0, 1, 0));
  CHECK(camera.name == "front");
  CHECK(scene.cameras[1].name == "plan");
  const auto perspective = std::get<PerspectiveCamera>(camera.form);
  CHECK(perspective.fov_axis == FovAxis::vertical);
  CHECK(perspective.fov_degrees == doctest::Approx(45));
  REQUIRE(scene.lights.size() == 3);
  const auto& point = std::get<PointLight>(scene.lights[0]);
  CHECK(point.position == Vec3(4, 5, 6));
  CHECK(glm::length(point.intensity - Vec3(1, 0.5, 0)) < 1e-12);
  const auto& sun = std::get<DirectionalLight>(scene.lights[1]);
  CHECK(glm::length(sun.to_light - Vec3(0, 1, 0)) < 1e-6);  // it shines along −z, turned to −y
  CHECK(sun.intensity.x == doctest::Approx(2));
  CHECK(std::get<SpotLight>(scene.lights[2]).outer == doctest::Approx(std::numbers::pi / 4));
  CHECK(warns(scene, "spot lights whose angles"));
  CHECK(warns(scene, "ranges of lights"));

  file.json["extensions"]["KHR_lights_punctual"]["lights"][2] = {
      {"type", "spot"}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.6}}}};
  file.json["nodes"][5]["translation"] = {7, 8, 9};
  file.json["nodes"][1].erase("camera");
  const ImportedScene second = import_sound(file.gltf(), "a.gltf");
  CHECK(std::get<OrthographicCamera>(second.cameras.at(0).form).size == 3);
  const auto& spot = std::get<SpotLight>(second.lights[2]);
  CHECK(spot.position == Vec3(7, 8, 9));
  CHECK(spot.direction == Vec3(0, 0, -1));
  CHECK(spot.inner == 0.2);
  CHECK(spot.outer == 0.6);
}

TEST_CASE("a spot stays a spot, whatever its angles are") {
  GltfFile file = square_file();
  file.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  const auto spot = [&](double inner, double outer) {
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}}};
    return std::get<SpotLight>(import_sound(file.gltf(), "a.gltf").lights.at(0));
  };
  for (const auto& [narrow, wide] :
       {std::pair(0.3, 0.3), {0.5, 0.3}, {0.3, std::nextafter(0.3f, 1.0f)}, {0.3, 0.3 + 1e-9}}) {
    const double inner = narrow, outer = wide;  // CAPTURE takes no structured bindings
    CAPTURE(inner);
    CHECK(spot(inner, outer).outer == outer);
    CHECK(spot(inner, outer).inner == doctest::Approx(outer).epsilon(1e-4));
    CHECK(spot(inner, outer).inner < outer);
  }
  CHECK(spot(0.3, 2).outer == std::numbers::pi / 2);
  CHECK(spot(-1, 0.3).inner == 0);
  CHECK(spot(0, -1).outer > 0);
  CHECK(spot(0, -1).outer < 1e-4);
}
