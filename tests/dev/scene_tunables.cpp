// Tests of the values of a scene that controls move, and of their keys.
#include "host/dev/scene_tunables.hpp"

#include <string>

#include "tests/support/doctest.hpp"

using namespace eyeray::engine::dev;

TEST_CASE("tunables of a scene are named as -D names them") {
  const auto found = scene_tunables(R"(
top = 1.5 # @slider 0 2
[camera]
fov = 45  # @slider 20 90
up = [0, 1, 0]
[[sphere]]      # the first
radius = 1.0  #@slider .5 1e1
[[sphere]]
radius = 2.0  # @slider 0 3
[sphere.extra]
tint = [1, 0.5, 0.25]  # @color
[[material]]
two_sided = false      # @checkbox
)");
  REQUIRE(found.size() == 6);
  CHECK(found[0].key == "top");
  CHECK(found[1].key == "camera.fov");
  CHECK(found[1].type == "int");
  CHECK(found[1].low == 20);
  CHECK(found[2].key == "sphere.0.radius");
  CHECK(found[2].type == "float");
  CHECK(found[2].low == 0.5);
  CHECK(found[2].high == 10);
  CHECK(found[3].key == "sphere.1.radius");
  CHECK(found[3].written[0] == 2);
  CHECK(found[4].key == "sphere.1.extra.tint");
  CHECK(found[4].written == std::array<double, 3>{1, 0.5, 0.25});
  CHECK(found[5].key == "material.0.two_sided");
  CHECK(found[5].type == "bool");
}

TEST_CASE("the label of a tunable names the owner of its value") {
  const auto found = scene_tunables(R"(
top = 1.5                 # @slider 0 2
[camera]
fov = 45                  # @slider 20 90
[[material]]
diffuse = [1, 0.5, 0.25]  # @color
name = "clay"
[[material]]
name = "mosaic"
[material.diffuse.formula]
file = "materials/tiles.glsl"
[material.diffuse.formula.parameters]
tiles = 28                # @slider 1 60
[[sphere]]
radius = 1.0              # @slider 0 3
[[sphere]]
radius = 2.0              # @slider 0 3
[[implicit]]
file = "shapes/column.glsl"
[implicit.parameters]
twist = 1.5               # @slider -2.5 2.5
[[torus]]
major = 1.5               # @slider 0 3
)");
  std::string names;
  for (const SceneTunable& each : found) names += each.owner + ": " + each.name + "\n";
  CHECK(names ==
        ": top\ncamera: fov\nclay: diffuse\nmosaic: diffuse tiles\nsphere 1: radius\nsphere 2: radius\n"
        "column: twist\ntorus: major\n");
}

TEST_CASE("values that no control can change are ignored") {
  for (const char* line : {"a = \"text\"  # @slider 0 1", "a = 1  # @slider 2 1", "a = [1, 2] # @color",
                           "a = 1  # @checkbox", "# a = 1  # @slider 0 1", "a = 1  # slider 0 1"}) {
    CAPTURE(line);
    const auto found = scene_tunables(line);
    CHECK(found.empty());
  }
}

TEST_CASE("a line may have any length") {
  const std::string centers = "batch = { center = [" + std::string(1'000'000, '1') + "] }\n";
  const auto found = scene_tunables("[[sphere]]\n" + centers + "radius = 1  # @slider 0 3\n");
  REQUIRE(found.size() == 1);
  CHECK(found[0].key == "sphere.0.radius");
}

TEST_CASE("a number that no double holds gets no control") {
  CHECK(scene_tunables("a = 1e999  # @slider 0 1").empty());
  CHECK(scene_tunables("a = 0.5  # @slider 0 1e999")[0].high == 1);
}
