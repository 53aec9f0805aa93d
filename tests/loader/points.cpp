// Points: [[points]], files of points in [[mesh]], and in place of scenes.
#include <algorithm>
#include <cmath>

#include "folder.hpp"
#include "host/core/error.hpp"
#include "host/loader/scene_file.hpp"
#include "host/scene/integrator.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

namespace {

using test::Folder;

// A grid of 20 × 20 points with a width of 0.5, and the same with colours.
std::string grid(const std::string& more = "") {
  std::string text;
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < 20; ++k) text += fmt::format("{} 0 {}{}\n", i * 0.5, k * 0.5, more);
  return text;
}

std::string complaint(const std::string& file, std::span<const Override> overrides = {}) {
  try {
    load_scene(file, overrides);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const Shape& last_shape(const Scene& scene) {
  REQUIRE(!scene.shapes.empty());
  CHECK(scene.shapes.back()->type == "points");
  return *scene.shapes.back();
}

double width(const Shape& shape) {
  return shape.bounds().max.x - shape.bounds().min.x;
}

}  // namespace

TEST_CASE("[[mesh]] shows lines as capsules, among those of the scene, with its material and transform") {
  const Folder folder;
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n");
  const auto text = [](const std::string& keys) {
    return R"(
[[light]]
type = "directional"
direction = [0, -1, -1]
[[material]]
name = "m"
type = "phong"
[[material]]
name = "glass"
type = "dielectric"
[[sphere]]
center = [0, 0, 0]
radius = 1
material = "m"
[[capsule]]
from = [0, 0, 0]
to = [0, 9, 0]
radius = 0.5
material = "m"
[[mesh]]
file = "a.obj"
name = "wires"
)" + keys;
  };
  const Scene scene = load_scene(folder.write(
      "scene.toml", text("line_width = 0.5\nmaterial = 'm'\ntransform = [{ scale = [2, 4, 2] }]\n")));
  REQUIRE(scene.shapes.size() == 4);
  CHECK(scene.shapes[0]->type == "sphere");
  for (size_t i = 1; i < 4; ++i) CHECK(scene.shapes[i]->type == "capsule");
  CHECK(scene.shapes[1]->bounds().max.y == doctest::Approx(9.5));
  CHECK(scene.shapes[2]->bounds().max.x == doctest::Approx(2.5));
  CHECK(scene.shapes[2]->bounds().max.y == doctest::Approx(1));
  CHECK(scene.shapes[3]->bounds().max.y == doctest::Approx(5));
  CHECK(scene.shapes[3]->material == scene.shapes[0]->material);
  const auto why = [&](const std::string& keys) { return complaint(folder.write("scene.toml", text(keys))); };
  CHECK(contains(why("line_width = 0.5\nmaterial = 'glass'\n"), "points and lines may overlap"));
  CHECK(contains(why("line_width = 0.5\ntransform = [{ scale = 1e13 }]\n"),
                 "the transformed lines are out of range"));
  CHECK(contains(why("line_width = 0\n"), "`line_width` must be a number above 0"));
  CHECK(
      load_scene(folder / "a.obj", std::vector<Override>{{"line_width=0.1"}, {"look=plain"}}).shapes.size() ==
      2);
  CHECK(contains(complaint(folder / "a.obj", std::vector<Override>{{"line_width=-1"}}),
                 "a line width is a number above 0"));
}

TEST_CASE("[[mesh]] shows files of points as one shape each, behind those of all other kinds") {
  const Folder folder;
  folder.write("scan.xyz", grid(" 200 10 30"));
  const std::string file = folder.write("scene.toml", R"(
[[light]]
type = "directional"
direction = [0, -1, -1]
[[material]]
name = "m"
type = "phong"
[[mesh]]
name = "scan"
file = "scan.xyz"
[[mesh]]
file = "scan.xyz"
material = "m"
point_size = 0.25
transform = [{ scale = [-2, 2, 2] }]
[[points]]
points = [[0, 0, 0]]
radius = 3
material = "m"
[[sphere]]
center = [0, 0, 0]
radius = 1
material = "m"
[[group]]
[[group.mesh]]
file = "scan.xyz"
transform = [{ translate = [100, 0, 0] }]
)");
  const Scene scene = load_scene(file);
  CHECK(scene.warnings.empty());
  CHECK(scene.meshes.empty());
  CHECK(scene.instances.empty());
  REQUIRE(scene.shapes.size() == 5);
  CHECK(scene.shapes[0]->type == "sphere");
  for (size_t i = 1; i < 5; ++i) CHECK(scene.shapes[i]->type == "points");
  CHECK(width(*scene.shapes[1]) == 6);
  CHECK(width(*scene.shapes[2]) == doctest::Approx(9.5 + 2 * 0.375));
  CHECK(width(*scene.shapes[3]) == doctest::Approx(2 * (9.5 + 0.25)));
  CHECK(scene.shapes[4]->bounds().min.x == doctest::Approx(100 - 0.375));
  CHECK(scene.materials[size_t(scene.shapes[2]->material)]->name == "colored");
  CHECK(scene.materials[size_t(scene.shapes[3]->material)]->name == "m");
  CHECK(scene.names.path(scene.shapes[2]->name.index) == "scan");
  CHECK(std::ranges::count(scene.files, folder.path() / "scan.xyz") == 1);
}

TEST_CASE("points need an opaque material and a transform that keeps spheres") {
  const Folder folder;
  folder.write("scan.xyz", grid());
  const auto refused = [&](const std::string& table, const std::string& material) {
    return complaint(folder.write("scene.toml", "[[material]]\nname = \"m\"\n" + material + "\n" + table));
  };
  const std::string mesh = "[[mesh]]\nfile = \"scan.xyz\"\nmaterial = \"m\"\n";
  const std::string points = "[[points]]\npoints = [[0, 0, 0]]\nradius = 1\nmaterial = \"m\"\n";
  for (const std::string& table : {mesh, points}) {
    CHECK(refused(table, "type = \"phong\"") == "accepted");
    CHECK(contains(
        refused(table, "type = \"dielectric\""),
        "points and lines may overlap, so their material must be opaque: light passes through this one"));
    CHECK(
        contains(refused(table, "type = \"phong\"\nalpha = 0.5"),
                 "points and lines may overlap, so their material must be opaque: this one has an `alpha`"));
    CHECK(contains(refused(table + "transform = [{ scale = [1, 2, 1] }]\n", "type = \"phong\""),
                   "cannot be sheared or scaled unevenly"));
    CHECK(contains(refused(table + "transform = [{ translate = [1e12, 0, 0] }]\n", "type = \"phong\""),
                   "the transformed points are out of range"));
  }
  CHECK(contains(refused(points + "colors = [[1, 1, 1], [0, 0, 0]]\n", "type = \"phong\""),
                 "there are 1 points and 2 colors; each point needs one"));
  CHECK(contains(refused("[[points]]\npoints = []\nradius = 1\nmaterial = \"m\"\n", "type = \"phong\""),
                 "there must be a point at least"));
}

TEST_CASE("a group of points is read again where it may not fit, so that instancing decides nothing") {
  const Folder folder;
  folder.write("scan.xyz", grid());
  const auto group = [&](const std::string& transform) {
    return folder.write("scene.toml",
                        "[render]\ngroups = \"instanced\"\n[[group]]\nbatch = { transform = [[], [" +
                            transform + "]] }\n[[group.mesh]]\nfile = \"scan.xyz\"\n");
  };
  const Scene scene = load_scene(group("{ scale = 2 }"));
  CHECK(scene.group_instances.size() == 2);
  CHECK(scene.groups.at(0).shapes.size() == 1);
  CHECK(scene.shapes.empty());
  CHECK(contains(complaint(group("{ scale = [1, 1, 2] }")), "cannot be sheared or scaled unevenly"));
}

TEST_CASE("a file of points alone has every look, turns, and is framed with the size of its points") {
  const Folder folder;
  const std::string file = folder.write("scan.xyz", grid(" 200 10 30"));
  const auto load = [&](std::vector<Override> overrides) { return load_scene(file, overrides); };
  const Scene studio = load({});
  CHECK(studio.render.integrator == IntegratorType::path);
  CHECK(studio.is_mesh_alone);
  CHECK(width(last_shape(studio)) == doctest::Approx(9.5 + 2 * 0.375));
  const auto floor =
      std::ranges::find_if(studio.shapes, [](const auto& shape) { return shape->type == "disk"; });
  REQUIRE(floor != studio.shapes.end());
  CHECK((*floor)->bounds().max.y < last_shape(studio).bounds().min.y);
  for (const char* look : {"look=plain", "look=clay", "look=sky"}) last_shape(load({{look}}));

  const Scene turning = load({{"look=plain"}, {"turntable=8"}, {"animation.frame=2"}});
  CHECK(turning.animation.tracks == 1);
  CHECK(last_shape(turning).bounds().min.x == doctest::Approx(-0.375));

  const Scene large = load({{"look=plain"}, {"point_size=4"}});
  CHECK(width(last_shape(large)) == doctest::Approx(9.5 + 4));
  const Scene plain = load({{"look=plain"}});
  CHECK(glm::length(large.camera.eye - large.camera.target) >
        1.05 * glm::length(plain.camera.eye - plain.camera.target));
}

TEST_CASE("a point size is a number above 0, for points alone") {
  const Folder folder;
  const std::string file = folder.write("scan.xyz", grid());
  for (const char* size : {"0", "-1", "x", "1x", "nan", "1e13", ""})
    CHECK(contains(
        complaint(file, std::vector<Override>{{fmt::format("point_size={}", size), "--point-size X"}}),
        "--point-size X: a point size is a number above 0"));
  const std::vector<Override> half{{"point_size=0.5"}};
  CHECK(contains(complaint("scenes/shapes/sphere.toml", half), "a point size is for a mesh alone"));
  const Scene mesh = load_scene("scenes/meshes/knot.ply", half);
  CHECK(std::ranges::any_of(mesh.warnings, [](const Diagnostic& warning) {
    return contains(warning.message, "has no points, so --point-size changes nothing");
  }));
}

TEST_CASE("points are disks by normals in a scene, by point_shape in a mesh, and by an option alone") {
  const Folder folder;
  folder.write("scan.xyz", grid(" 0 1 0"));
  folder.write("bare.xyz", grid());
  const auto flat = [](const Shape& shape) {
    // A ray along the plane of the disks hits spheres only.
    return !shape.intersect({Vec3(-50, 0.1, 0), Vec3(1, 0, 0)}).has_value();
  };
  const std::string mesh = "[[mesh]]\nfile = \"scan.xyz\"\n";
  const auto shape_of = [&](const std::string& text) -> bool {
    return flat(last_shape(load_scene(folder.write("scene.toml", text))));
  };
  CHECK_FALSE(shape_of(mesh));
  CHECK_FALSE(shape_of(mesh + "point_shape = \"sphere\"\n"));
  CHECK(shape_of(mesh + "point_shape = \"disk\"\n"));
  const std::string table =
      "[[material]]\nname = \"m\"\ntype = \"phong\"\n[[points]]\npoints = [[0, 0, 0], [1, 0, 0]]\nradius = "
      "1\nmaterial = \"m\"\n";
  CHECK_FALSE(shape_of(table));
  CHECK(shape_of(table + "normals = [[0, 3, 0], [0, -1, 0]]\n"));

  const auto alone = [&](const std::string& choice) {
    return load_scene(folder / "scan.xyz",
                      std::vector<Override>{{"look=plain"}, {choice, "--point-shape X"}});
  };
  CHECK(flat(last_shape(alone("point_shape=disk"))));
  CHECK_FALSE(flat(last_shape(alone("point_shape=sphere"))));

  const auto why = [&](const std::string& text) { return complaint(folder.write("scene.toml", text)); };
  CHECK(contains(why("[[mesh]]\nfile = \"bare.xyz\"\npoint_shape = \"disk\"\n"),
                 "bare.xyz: its points have no normals, which disks need"));
  CHECK(contains(why(mesh + "point_shape = \"cube\"\n"), "scene.toml:3:15: error: "));
  CHECK(contains(why(table + "normals = [[0, 1, 0]]\n"),
                 "there are 2 points and 1 normals; each point needs one"));
  CHECK(
      contains(why(table + "normals = [[0, 1, 0], [0, 0, 0]]\n"), ":8:23: error: the normal has no length"));
  CHECK(contains(
      complaint(folder / "scan.xyz", std::vector<Override>{{"point_shape=cube", "--point-shape cube"}}),
      "--point-shape cube: a point shape is sphere, disk"));
  CHECK(contains(complaint("scenes/shapes/sphere.toml", std::vector<Override>{{"point_shape=disk"}}),
                 "a point shape is for a mesh alone"));
  const Scene knot = load_scene("scenes/meshes/knot.ply", std::vector<Override>{{"point_shape=disk"}});
  CHECK(std::ranges::any_of(knot.warnings, [](const Diagnostic& warning) {
    return contains(warning.message, "has no points, so --point-shape changes nothing");
  }));
}
