// Tests of shapes and materials made from their tables in a scene file, and of refusals.
#include "host/loader/scene_file.hpp"
#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::test;

namespace {

const std::string of_paint = "[[material]]\nname = 'm'\ntype = 'phong'\n";

Scene scene_of(const std::string& tables) {
  return parse_scene(of_paint + tables, "scene.toml");
}

// "line: message" of the only error in a scene whose first shape's table starts at line 1.
std::string refused(const std::string& shape) {
  try {
    parse_scene(shape + "\nmaterial = 'm'\n" + of_paint, "scene.toml");
  } catch (const InputError& error) {
    REQUIRE(error.diagnostics().size() == 1);
    const Diagnostic& diagnostic = error.diagnostics()[0];
    return std::to_string(diagnostic.position.line) + ": " + diagnostic.message;
  }
  return "accepted";
}

// The first hit of the camera ray.
FirstHit surface_hit(Scene scene, const Vec3& from, const Vec3& target) {
  const Scene one = one_pixel(from, target);
  scene.image = one.image;
  scene.camera = one.camera;
  return reference::Renderer(scene).first_hit(0, 0);
}

}  // namespace

TEST_CASE("shapes have the positions that their tables set") {
  const std::string sphere = R"(
    [[sphere]]
    center = [1, 0, 0]
    radius = 2
    material = 'm'
    transform = [{ scale = 3 }, { rotate = { axis = [0, 1, 0], degrees = 90 } }]
  )";
  CHECK(near(surface_hit(scene_of(sphere), {0, 0, 20}, {0, 0, 0}).position, Vec3(0, 0, 3), 1e-14));

  const std::string plane = R"(
    [[plane]]
    point = [0, 2, 0]
    normal = [0, 5, 0]
    u_axis = [0, 0, 1]
    material = 'm'
  )";
  const FirstHit floor = surface_hit(scene_of(plane), {3, 4, 7}, {3, 0, 7});
  CHECK(floor.position == Vec3(3, 2, 7));
  CHECK(floor.uv == Vec2(7, 3));

  const std::string triangle = R"(
    [[triangle]]
    vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    normals = [[0, 0, 1], [0, 0, 1], [0, 3, 4]]
    uv = [[0, 0], [0, 0], [8, 9]]
    material = 'm'
  )";
  const FirstHit corner = surface_hit(scene_of(triangle), {0, 1, 7}, {0, 1, 0});
  CHECK(near(corner.normal, Vec3(0, 0.6, 0.8), 1e-15));
  CHECK(corner.uv == Vec2(8, 9));
}

TEST_CASE("shapes refuse invalid values") {
  const std::string sphere = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";
  CHECK(refused(sphere) == "accepted");
  CHECK(refused(sphere + "transform = [{ scale = [2, -2, 2] }]") == "accepted");
  CHECK(refused(sphere + "transform = [{ matrix = [[1, 0.5, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]] }]") ==
        "accepted");
  CHECK(refused("[[sphere]]\ncenter = [1e12, 0, 0]\nradius = 1\ntransform = [{ scale = 2 }]") ==
        "4: the transformed sphere is out of range (radius 1e-12 to 1e12, centre up to 1e12)");

  CHECK(refused("[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 0]") == "3: the normal has no length");
  const std::string plane = "[[plane]]\npoint = [0, 0, 1e12]\nnormal = [0, 2, 0]\n";
  CHECK(refused(plane) == "accepted");
  CHECK(refused(plane + "u_axis = [0, -3, 0]") == "4: the axis must not be parallel to the normal");
  CHECK(refused(plane + "u_axis = [0, 0, 0]") == "4: the axis has no length");
  CHECK(refused(plane + "transform = [{ scale = 2 }]") ==
        "4: the transformed point is out of range (coordinates up to 1e12)");

  const std::string triangle = "[[triangle]]\nvertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n";
  CHECK(refused(triangle) == "accepted");
  CHECK(refused("[[triangle]]\nvertices = [[0, 0, 0], [1, 0, 0]]") == "2: a triangle needs exactly 3, not 2");
  CHECK(refused("[[triangle]]\nvertices = [[1, 1, 1], [1, 0, 0], [1, 1, 1]]") ==
        "2: the triangle has no area: its vertices coincide or lie on one line");
  CHECK(refused("[[triangle]]\nvertices = [[1e-9, 0, 0], [0, 1e-9, 0], [0, 0, 1e-9]]") == "accepted");
  CHECK(refused(triangle + "uv = [[0, 0], [1, 1]]") == "3: a triangle needs exactly 3, not 2");
  CHECK(refused(triangle + "normals = [[0, 0, 1], [0, 0, 0], [0, 0, 1]]") == "3: a normal has no length");
  CHECK(refused(triangle + "normals = [[0, 0, 1], [0, 0, 1], [1, 0, -0.01]]")
            .starts_with("3: a normal points to the inside"));
  CHECK(
      refused(
          "[[triangle]]\nvertices = [[0, 0, 0], [1e12, 0, 0], [0, 1, 1e12]]\ntransform = [{ scale = 2 }]") ==
      "3: the transformed vertices are out of range (coordinates up to 1e12)");

  // The triangle is 5e-9 thin along x, and a hundredth of that after the map.
  CHECK(refused("[[triangle]]\nvertices = [[0, 0, 0], [0, 1, 0], [5e-9, 0.5, 0]]\ntransform = [{ scale = "
                "[0.01, 1, 1] }]") == "3: the transform leaves the triangle without area");

  // After a stretch ×100 along y, the shading normal points to the inside; but it is right in the space in
  // which it is written.
  const std::string slope =
      "[[triangle]]\nvertices = [[0, 0, 0], [1, 1, 0], [0, 0, -1]]\nnormals = [[1, 1.5, 0], [0, 1, 0], [0, "
      "1, 0]]\n";
  CHECK(refused(slope) == "accepted");
  CHECK(refused(slope + "transform = [{ scale = [1, 100, 1] }]") == "accepted");
}

TEST_CASE("materials read their keys, and have defaults for the others") {
  const Scene scene = parse_scene(R"(
    [[material]]
    name = 'plain'
    type = 'phong'
    [[material]]
    name = 'paint'
    type = 'phong'
    diffuse = [1, 0, 0]
    ambient = [0, 1, 0]
    specular = 0.25
    shininess = 7
    highlight = 'blinn'
    reflectance = [0, 0, 1]
    [[material]]
    name = 'mirror'
    type = 'mirror'
    [[material]]
    name = 'glass'
    type = 'dielectric'
    [[material]]
    name = 'dark'
    type = 'dielectric'
    ior = 2
    absorption = [1, 2, 3]
    shadow = 0.125
  )",
                                  "scene.toml");
  const auto seen = [&](size_t i) { return scene.materials.at(i)->scattering({Vec2(0), 1, 1, 1}); };
  CHECK(seen(0).diffuse == Vec3(0.8));
  CHECK(seen(0).ambient == Vec3(0.8));
  CHECK(seen(0).specular == Vec3(0));
  CHECK(seen(0).reflected == Vec3(0));
  CHECK(!scene.materials[0]->medium());
  CHECK(scene.materials[0]->shadow_transmittance() == 0);
  CHECK(seen(1).diffuse == Vec3(1, 0, 0));
  CHECK(seen(1).ambient == Vec3(0, 1, 0));
  CHECK(seen(1).specular == Vec3(0.25));
  CHECK(seen(1).shininess == 7);
  CHECK(seen(1).blinn);
  CHECK(seen(1).reflected == Vec3(0, 0, 1));
  CHECK(scene.materials[1]->base_color(Vec2(0)) == Vec3(1, 0, 0));
  CHECK(seen(2).reflected == Vec3(0.95));
  CHECK(seen(2).diffuse == Vec3(0));
  CHECK(scene.materials[2]->base_color(Vec2(0)) == Vec3(0.95));
  CHECK(scene.materials[3]->medium()->ior == 1.5);
  CHECK(near(scene.materials[3]->shadow_transmittance(), 0.96, 1e-15));
  CHECK(scene.materials[3]->base_color(Vec2(0)) == Vec3(1));
  CHECK(scene.materials[4]->medium()->ior == 2);
  CHECK(scene.materials[4]->medium()->absorption == Vec3(1, 2, 3));
  CHECK(scene.materials[4]->shadow_transmittance() == 0.125);
}
