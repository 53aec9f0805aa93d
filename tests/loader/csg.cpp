// CSG objects in scene files: parts, materials, transforms and batches.
#include <fmt/format.h>

#include "host/loader/scene_file.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

namespace {

Scene parse(const std::string& text) {
  return parse_scene(
      "[[material]]\nname = \"wall\"\ntype = \"phong\"\n[[material]]\nname = \"ink\"\ntype = \"phong\"\n" +
          text,
      "scene.toml");
}

std::string material_at(const Scene& scene, const Shape& shape, const Ray& ray) {
  const auto hit = shape.intersect(ray);
  REQUIRE(hit);
  return scene.materials[size_t(shape.part(*hit).material)]->name;
}

constexpr std::string_view box = "min = [-1, -1, -1]\nmax = [1, 1, 1]\n";
const Ray from_left{{-10, 0, 0}, {1, 0, 0}};

}  // namespace

TEST_CASE("a part without a material takes that of the nearest CSG object around it") {
  const Scene scene =
      parse(fmt::format("[[csg]]\nmaterial = \"wall\"\n[[csg.csg]]\n[[csg.csg.box]]\n{}"
                        "[[csg.minus.csg]]\nmaterial = \"ink\"\n[[csg.minus.csg.sphere]]\ncenter = "
                        "[-1, 0, 0]\nradius = 0.5\n",
                        box));
  REQUIRE(scene.shapes.size() == 1);
  CHECK(material_at(scene, *scene.shapes[0], from_left) == "ink");
  CHECK(material_at(scene, *scene.shapes[0], {{-10, 0.7, 0}, {1, 0, 0}}) == "wall");
}

TEST_CASE("the transforms of a part, its CSG object and its group are applied in that order") {
  const Scene scene =
      parse(fmt::format("[[group]]\ntransform = [{{ translate = [100, 0, 0] }}]\n"
                        "[[group.csg]]\ntransform = [{{ scale = 10 }}]\nmaterial = \"wall\"\n"
                        "[[group.csg.box]]\ntransform = [{{ translate = [2, 0, 0] }}]\n{}",
                        box));
  REQUIRE(scene.shapes.size() == 1);
  CHECK(scene.shapes[0]->bounds().min.x == doctest::Approx(110));
  CHECK(scene.shapes[0]->bounds().max.x == doctest::Approx(130));
}

TEST_CASE("an intersection of separate parts is empty") {
  const Scene scene = parse(
      "[[csg]]\noperation = \"intersection\"\nmaterial = \"wall\"\n[[csg.sphere]]\nradius = 1\n"
      "batch = { center = [[0, 0, 0], [2.5, 0, 0]] }\n");
  REQUIRE(scene.shapes.size() == 1);
  CHECK_FALSE(scene.shapes[0]->intersect(from_left));
  // Its bounds are a point rather than empty, so code that sorts bounds need not check.
  const Bounds bounds = scene.shapes[0]->bounds();
  CHECK(bounds.min == bounds.max);
  CHECK(bounds.min == Vec3(1.25, 0, 0));
}

TEST_CASE("a part's batch adds parts; a CSG object's batch adds CSG objects, each with its own material") {
  const Scene scene = parse(
      "[[csg]]\nbatch = { transform = [[], [{ translate = [0, 50, 0] }]], material = [\"wall\", \"ink\"] "
      "}\n"
      "[[csg.sphere]]\nradius = 1\nbatch = { center = [[0, 0, 0], [5, 0, 0], [10, 0, 0]] }\n");
  REQUIRE(scene.shapes.size() == 2);
  CHECK(scene.shapes[0]->spans(from_left).size() == 3);
  CHECK(scene.shapes[1]->spans({{-10, 50, 0}, {1, 0, 0}}).size() == 3);
  CHECK(material_at(scene, *scene.shapes[0], from_left) == "wall");
  CHECK(material_at(scene, *scene.shapes[1], {{-10, 50, 0}, {1, 0, 0}}) == "ink");
}

TEST_CASE("parts below `minus` are subtracted, whatever the order of the tables") {
  const std::string minus = "[[csg.minus.box]]\nmin = [-9, -9, -9]\nmax = [0, 9, 9]\n";
  const std::string ball = "[[csg.sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";
  for (const std::string& parts : {ball + minus, minus + ball}) {
    const Scene scene = parse("[[csg]]\nmaterial = \"wall\"\n" + parts);
    const auto hit = scene.shapes[0]->intersect(from_left);
    REQUIRE(hit);
    CHECK(hit->t == doctest::Approx(10));
  }
}
