// Groups move their members as one, and show them once for each transform of their batch.
#include <fmt/format.h>

#include "host/scene/affine.hpp"
#include "tests/loader/walls.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

double middle_x(const Shape& shape) {
  return (shape.bounds().min.x + shape.bounds().max.x) / 2;
}

}  // namespace

TEST_CASE("a group's transform is applied after its members', and before that of the enclosing group") {
  const Scene scene = parse_walls(
      "[[group]]\ntransform = [{ translate = [100, 0, 0] }]\n"
      "[[group.group]]\ntransform = [{ scale = 10 }]\n" +
      sphere("group.group.sphere", 1) + "transform = [{ translate = [2, 0, 0] }]\n");
  REQUIRE(scene.shapes.size() == 1);
  CHECK(std::abs(middle_x(*scene.shapes[0]) - 130) < 1e-9);
  CHECK(std::abs(scene.shapes[0]->bounds().max.x - 140) < 1e-9);
}

TEST_CASE("a batch copies a group once for each transform; nested batches multiply") {
  const Scene scene = parse_walls(
      "[[group]]\nbatch = { transform = [[], [{ translate = [10, 0, 0] }], [{ translate = [20, 0, 0] }]] "
      "}\n" +
      sphere("group.sphere", 1) +
      "[[group.box]]\nmin = [0, 0, 0]\nmaterial = \"wall\"\nbatch = { max = [[1, 1, 1], [2, 2, 2]] }\n");
  REQUIRE(scene.shapes.size() == 9);
  double sum = 0;
  for (const auto& shape : scene.shapes) sum += middle_x(*shape);
  CHECK(std::abs(sum - (3 * (1 + 0.5 + 1) + 3 * 30)) < 1e-6);
}

TEST_CASE("objects in no group come first, so that their ids do not depend on groups") {
  const Scene scene = parse_walls("[[group]]\n" + sphere("group.sphere", 5) + sphere("sphere", 1));
  REQUIRE(scene.shapes.size() == 2);
  CHECK(std::abs(middle_x(*scene.shapes[0]) - 1) < 1e-12);
}

TEST_CASE("a mistake in a group is reported once, at its position, however many copies the group has") {
  CHECK(refused("[[group]]\nbatch = { transform = [[], [], []] }\n[[group.sphere]]\nradius = 1\n"
                "center = [0, 0, 0]\nmaterial = \"wal\"\n") ==
        "scene.toml:9:12: error: no [[material]] is named \"wal\"; did you mean \"wall\"?\n"
        "  material = \"wal\"\n"
        "             ^");
}

TEST_CASE("groups that multiply beyond all memory are refused before they fill it") {
  std::string text;
  std::string table = "group";
  for (int level = 0; level < 6; ++level, table += ".group") {
    text += fmt::format("[[{}]]\nbatch = {{ transform = [", table);
    for (int i = 0; i < 100; ++i) text += fmt::format("[{{ translate = [{}, 0, 0] }}],", i);
    text += "] }\n";
  }
  const std::string message = refused(text + sphere(table + ".sphere", 1));
  CHECK_MESSAGE(message.find("objects; at most 67108864 are possible") != std::string::npos, message);
}
