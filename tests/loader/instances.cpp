// Instances of groups: named ones, where they are instanced, and their errors.
#include <fmt/format.h>

#include "host/scene/affine.hpp"
#include "host/scene/objects.hpp"
#include "host/scene/primitive_ids.hpp"
#include "tests/loader/walls.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

bool says(const std::string& text, std::string_view what) {
  return text.find(what) != std::string::npos;
}

// A list of `count` steps along x.
std::string steps(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += fmt::format("[{{ translate = [{}, 0, 0] }}],", i);
  return "transform = [" + text + "]";
}

std::string batch(int count) {
  return "batch = { " + steps(count) + " }\n";
}

double middle_x(const Shape& shape) {
  return (shape.bounds().min.x + shape.bounds().max.x) / 2;
}

}  // namespace

TEST_CASE("a pattern appears only where instances name it, after its own transform") {
  const Scene scene =
      parse_walls("[[group]]\nname = \"ball\"\npattern = true\ntransform = [{ scale = 2 }]\n" +
                  sphere("group.sphere", 1) +
                  "[[instance]]\ngroup = \"ball\"\ntransform = [{ translate = [10, 0, 0] }]\n"
                  "[[group]]\ntransform = [{ translate = [100, 0, 0] }]\n"
                  "[[group.instance]]\nbatch = { group = [\"ball\", \"ball\"], " +
                  steps(2) + " }\n");
  REQUIRE(scene.shapes.size() == 3);
  CHECK(std::abs(middle_x(*scene.shapes[0]) - 102) < 1e-9);
  CHECK(std::abs(middle_x(*scene.shapes[1]) - 103) < 1e-9);
  CHECK(std::abs(middle_x(*scene.shapes[2]) - 12) < 1e-9);
}

TEST_CASE("among nested groups, those that leave the fewest objects in memory are instanced") {
  // 2 × 20 000 × 10 spheres: the inner group is instanced. With 20 000 × 2, the outer group is.
  const auto nested = [](int outer, int inner, int spheres) {
    std::string text = "[[group]]\n" + batch(outer) + "[[group.group]]\n" + batch(inner);
    for (int i = 0; i < spheres; ++i) text += sphere("group.group.sphere", 3 * i);
    return parse_walls(text);
  };
  const Scene many_inside = nested(2, 20'000, 10);
  REQUIRE(many_inside.groups.size() == 1);
  CHECK(many_inside.groups[0].shapes.size() == 10);
  CHECK(many_inside.group_instances.size() == 40'000);
  const Scene many_outside = nested(20'000, 2, 10);
  REQUIRE(many_outside.groups.size() == 1);
  CHECK(many_outside.groups[0].shapes.size() == 20);
  CHECK(many_outside.group_instances.size() == 20'000);
  CHECK(many_outside.primitive_count() == 400'000);
  CHECK(std::abs(many_outside.group_instances[7].transform[3].x - 7) < 1e-12);

  // Small groups are copied.
  const Scene small = nested(10, 10, 10);
  CHECK(small.groups.empty());
  CHECK(small.shapes.size() == 1000);
}

TEST_CASE("`groups` decides whether groups are instanced, and changes no id") {
  const std::string text = sphere("sphere", 0) + "[[group]]\n" + batch(3) + sphere("group.sphere", 1) +
                           sphere("group.sphere", 2) + "[[group]]\n" + sphere("group.sphere", 50) +
                           "[[group]]\n" + batch(2) + sphere("group.sphere", 60);
  const Scene flat = parse_walls("[render]\ngroups = \"flat\"\n" + text);
  const Scene once = parse_walls("[render]\ngroups = \"instanced\"\n" + text);
  CHECK(flat.shapes.size() == 10);
  CHECK(flat.groups.empty());
  CHECK(once.groups.size() == 2);
  REQUIRE(once.shapes.size() == 2);
  REQUIRE(once.group_instances.size() == 5);
  CHECK(once.primitive_count() == flat.primitive_count());

  const PrimitiveIds ids(once);
  const auto same = [&](uint64_t id, double x) { return std::abs(middle_x(*flat.shapes[id]) - x) < 1e-9; };
  for (size_t i = 0; i < once.shapes.size(); ++i) CHECK(same(ids.of_shape(i), middle_x(*once.shapes[i])));
  for (size_t i = 0; i < once.group_instances.size(); ++i) {
    const GroupInstance& instance = once.group_instances[i];
    const auto& shapes = once.groups[size_t(instance.group)].shapes;
    for (size_t k = 0; k < shapes.size(); ++k)
      CHECK(same(ids.of_group(i).shape + k, middle_x(*shapes[k]) + instance.transform[3].x));
  }
}

TEST_CASE("a group that contains an unbounded shape is copied") {
  const Scene scene =
      parse_walls("[render]\ngroups = \"instanced\"\n[[group]]\n" + batch(3) + "[[group.group]]\n" +
                  "[[group.group.plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = \"wall\"\n");
  CHECK(scene.groups.empty());
  CHECK(scene.shapes.size() == 3);
}

TEST_CASE("a triangle's normals are checked in its own space, whether its group is copied or instanced") {
  // The group's map, z' = z + 2 x, would turn the first normal to the wrong side, and the second one to the
  // right side.
  const auto verdict = [](const char* groups, const char* normal) {
    const char* const slope = "{ matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [2, 0, 1, 0]] }";
    return refused(fmt::format(R"([render]
groups = "{0}"
[[group]]
batch = {{ transform = [[{1}], [{1}, {{ translate = [9, 0, 0] }}]] }}
[[group.triangle]]
material = "wall"
vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
normals = [{2}, {2}, {2}]
)",
                               groups, slope, normal));
  };
  for (const char* groups : {"flat", "instanced"}) {
    CAPTURE(groups);
    CHECK(verdict(groups, "[1, 0, 0.2]") == "accepted");
    CHECK(says(verdict(groups, "[-1, 0, -0.1]"), "scene.toml:11:11: error: a normal points to the inside"));
  }
}

TEST_CASE("a sphere in a stretched group is an ellipsoid") {
  const Scene scene =
      parse_walls("[[group]]\ntransform = [{ scale = [1, 2, 1] }]\n" + sphere("group.sphere", 1));
  REQUIRE(scene.shapes.size() == 1);
  const Bounds bounds = scene.shapes[0]->bounds();
  CHECK(glm::length(bounds.max - Vec3(2, 2, 1)) < 1e-12);
  CHECK(std::holds_alternative<QuadricForm>(scene.shapes[0]->form()));
  CHECK(says(refused("[[group]]\ntransform = [{ scale = [100, 1, 1] }]\n" + sphere("group.sphere", 1e11)),
             "scene.toml:6:1: error: "));
}

TEST_CASE("errors in patterns and instances are reported at their position") {
  const std::string ball = "[[group]]\nname = \"ball\"\npattern = true\n" + sphere("group.sphere", 1);
  CHECK(says(refused(ball + "[[instance]]\ngroup = \"bal\"\n"),
             "scene.toml:12:9: error: no [[group]] is named \"bal\"; did you mean \"ball\"?"));
  CHECK(says(refused(ball + ball + "[[instance]]\ngroup = \"ball\"\n"),
             "scene.toml:19:9: error: more than one [[group]] is named \"ball\""));
  CHECK(says(refused("[[group]]\npattern = true\n"),
             "scene.toml:5:11: error: a pattern needs a `name`, by which an [[instance]] refers to it"));
  CHECK(says(refused("[[group]]\n[[group.group]]\nname = \"ball\"\npattern = true\n" +
                     sphere("group.group.sphere", 1)),
             "scene.toml:7:11: error: only a [[group]] that is in no other can be a pattern"));
  CHECK(says(refused("[[instance]]\n"), "[[instance]] needs `group`"));
  CHECK(says(refused("[[group]]\nname = \"a\"\n[[group.instance]]\ngroup = \"b\"\n"
                     "[[group]]\nname = \"b\"\n[[group.instance]]\ngroup = \"a\"\n"),
             "scene.toml:5:8: error: group \"a\" contains itself: a → b → a"));
}

TEST_CASE("a named group that is no pattern also appears where it is written") {
  const Scene scene =
      parse_walls("[[group]]\nname = \"ball\"\n" + sphere("group.sphere", 1) +
                  "[[instance]]\ngroup = \"ball\"\ntransform = [{ translate = [10, 0, 0] }]\n");
  REQUIRE(scene.shapes.size() == 2);
  CHECK(std::abs(middle_x(*scene.shapes[0]) - 1) < 1e-9);
  CHECK(std::abs(middle_x(*scene.shapes[1]) - 11) < 1e-9);
}

TEST_CASE("an instanced object has the same name as its copies") {
  const std::string text = sphere("sphere", 0) + "[[group]]\nname = \"cart\"\n" + batch(2) +
                           sphere("group.sphere", 1) + "name = \"wheel\"\n" + sphere("group.sphere", 2) +
                           "[[group]]\n" + batch(2) + sphere("group.sphere", 3);
  const Scene flat = parse_walls("[render]\ngroups = \"flat\"\n" + text);
  const Scene once = parse_walls("[render]\ngroups = \"instanced\"\n" + text);
  REQUIRE(once.group_instances.size() == 4);
  const Objects flat_things(flat), once_things(once);
  REQUIRE(once_things.size() == flat_things.size());
  for (uint64_t id = 0; id < flat.primitive_count(); ++id)
    CHECK(once_things.describe(id) == flat_things.describe(id));
  CHECK(once_things.describe(3) == "sphere \"cart 2/wheel\", scene.toml:13");
  for (size_t i = 0; i < once_things.size(); ++i) CHECK(once_things.of(once_things[i].first) == i);
}

TEST_CASE("a pattern without instances is a warning, and its errors are still reported") {
  const Scene scene = parse_walls("[[group]]\nname = \"ball\"\npattern = true\n" + sphere("group.sphere", 1) +
                                  sphere("sphere", 0));
  CHECK(scene.shapes.size() == 1);
  bool warned = false;
  for (const Diagnostic& warning : scene.warnings)
    warned = warned || warning.message == "group \"ball\" is not shown: no [[instance]] names it";
  CHECK(warned);
  CHECK(says(refused("[[group]]\nname = \"ball\"\npattern = true\n[[group.sphere]]\nradius = 0\n"),
             "scene.toml:8:10: error: "));
}

TEST_CASE("groups nested too deep are an error, not a stack overflow") {
  std::string text = sphere("sphere", 0);
  for (int i = 0; i < 20'000; ++i)
    text += fmt::format("[[group]]\nname = \"{}\"\npattern = true\n[[group.instance]]\ngroup = \"{}\"\n", i,
                        i + 1);
  CHECK(says(refused(text + "[[instance]]\ngroup = \"0\"\n"), "groups are nested more than 64 deep"));
}

TEST_CASE("named groups that double at each level are instanced if that suffices, otherwise refused") {
  const auto doubled = [](int levels) {
    std::string text = "[[group]]\nname = \"0\"\npattern = true\n" + sphere("group.sphere", 1);
    for (int i = 1; i <= levels; ++i)
      text += fmt::format("[[group]]\nname = \"{}\"\npattern = true\n[[group.instance]]\ngroup = \"{}\"\n{}",
                          i, i - 1, batch(2));
    return text + fmt::format("[[instance]]\ngroup = \"{}\"\n", levels);
  };
  const Scene scene = parse_walls(doubled(20));
  CHECK(scene.primitive_count() == 1'048'576);
  CHECK(scene.shapes.size() + scene.group_instances.size() < 20'000);
  CHECK(says(refused(doubled(40)), "objects; at most 2147483647 can have ids"));
}

TEST_CASE("parts of CSG objects count as kept objects") {
  const std::string text =
      "[[group]]\n" + batch(10'000) +
      "[[group.csg]]\nmaterial = \"wall\"\n[[group.csg.minus.sphere]]\ncenter = [0, 0, 0]\n"
      "radius = 1\n" +
      batch(10'000);
  const std::string message = refused("[render]\ngroups = \"flat\"\n" + text);
  CHECK_MESSAGE(says(message, "batches and groups make 100020001 objects; at most 67108864 are possible"),
                message);
}

// Shapes in a group that become too thin, too far or too distorted only under the group's map into the world.
TEST_CASE("a shape under a group's transform is accepted or refused alike, copied or instanced") {
  const struct {
    const char* group_map;
    const char* shape;
    const char* wrong;
  } cases[] = {
      {"{ scale = [1, 1, 1e6] }", "[[group.triangle]]\nvertices = [[0, 0, 0], [0, 1e-4, 1], [0, 0, 1]]\n",
       "the transform leaves the triangle without area"},
      {"{ scale = [1, 1, 1e5] }",
       "[[group.parallelogram]]\norigin = [0, 0, 0]\nedge_u = [1e-6, 0, 1]\nedge_v = [-1e-6, 0, 1]\n",
       "the transform leaves the parallelogram without area"},
      {"{ scale = [1, 1, 1e6] }", "[[group.polygon]]\nvertices = [[0, 0, 0], [0, 1e-4, 1], [0, 0, 1]]\n",
       "the transform leaves the outline without area"},
      {"{ scale = [1, 1, 1000] }",
       "[[group.bilinear]]\ncorners = [[0, 0, 0], [1, 0, 0], [1, 1, 1], [0, 1, 0]]\n",
       "the transform leaves the patch flat"},
      {"{ scale = [1, 1, 1e6] }",
       "[[group.bezier]]\npoints = [[0,0,0],[1,0,0],[2,0,0],[3,0,0],[0,0,1],[1,0,1],[2,0,1],[3,0,1],"
       "[0,0,2],[1,0,2],[2,0,2],[3,0,2],[0,0,3],[1,0,3],[2,0,3],[3,0,3]]\n",
       "the transform leaves the patch without area"},
      {"{ scale = [1, 1, 1e4] }",
       "[[group.sphere]]\ncenter = [0, 0, 0]\nradius = 1\ntransform = [{ scale = [1, 1, 1e4] }]\n",
       "`transform` cannot be inverted"},
      {"{ scale = 1e6 }", "[[group.box]]\nmin = [0, 0, 0]\nmax = [1e7, 1e7, 1e7]\n", "out of range"},
      // A shape just within a limit, and one far from all limits.
      {"{ scale = [1, 1, 90] }", "[[group.bilinear]]\ncorners = [[0,0,0],[1,0,0],[1,1,1],[0,1,0]]\n",
       "accepted"},
      {"{ scale = [1, 1, 2] }", "[[group.bilinear]]\ncorners = [[0,0,0],[1,0,0],[1,1,1],[0,1,0]]\n",
       "accepted"},
  };
  for (const auto& [map, shape, wrong] : cases) {
    const std::string text(shape);
    CAPTURE(text);
    std::string messages[2];
    for (const bool once : {false, true}) {
      messages[once] =
          refused(fmt::format("[render]\ngroups = \"{}\"\n[[group]]\nbatch = {{ transform = [[{}], [{}]] "
                              "}}\n{}material = \"wall\"\n",
                              once ? "instanced" : "flat", map, map, shape));
    }
    CHECK(messages[0] == messages[1]);
    CHECK(says(messages[1], wrong));
  }
}
