// Names of shapes, meshes and groups: the objects that have them, and the names in messages.
#include <fmt/format.h>

#include "host/loader/scene_file.hpp"
#include "host/scene/objects.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

namespace {

constexpr std::string_view material = "[[material]]\nname = \"wall\"\ntype = \"phong\"\n";

Scene parse(const std::string& text) {
  return parse_scene(std::string(material) + text, "scene.toml");
}

std::vector<std::string> refusals(const std::string& text) {
  std::vector<std::string> messages;
  try {
    parse(text);
  } catch (const InputError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) messages.push_back(diagnostic.message);
  }
  return messages;
}

std::vector<std::string> names(const Scene& scene) {
  std::vector<std::string> all;
  for (const auto& shape : scene.shapes) all.push_back(describe(shape->type, shape->name, scene.names));
  return all;
}

constexpr std::string_view sphere = "center = [0, 0, 0]\nradius = 1\nmaterial = \"wall\"\n";

}  // namespace

TEST_CASE("a shape's name follows the names of its groups") {
  const Scene scene =
      parse(fmt::format("[[sphere]]\n{0}[[sphere]]\nname = \"left eye\"\n{0}[[group]]\nname = \"cart\"\n"
                        "[[group.sphere]]\n{0}[[group.group]]\n[[group.group.sphere]]\nname = \"wheel\"\n{0}",
                        sphere));
  CHECK(names(scene) == std::vector<std::string>{"sphere", "sphere \"left eye\"", "sphere in \"cart\"",
                                                 "sphere \"cart/wheel\""});
  const Objects objects(scene);
  CHECK(objects.describe(0) == "sphere, scene.toml:4");
  CHECK(objects.describe(1) == "sphere \"left eye\", scene.toml:8");
}

TEST_CASE("elements of a batch share a name and are numbered, or have names of their own") {
  const Scene scene = parse(
      "[[group]]\nname = \"cart\"\nbatch = { transform = [[], [{ translate = [9, 0, 0] }]] }\n"
      "[[group.sphere]]\nname = \"wheel\"\nradius = 1\nmaterial = \"wall\"\n"
      "batch = { center = [[0, 0, 0], [1, 0, 0]] }\n"
      "[[group.sphere]]\nradius = 1\nmaterial = \"wall\"\n"
      "batch = { center = [[0, 0, 0], [1, 0, 0]], name = [\"front\", \"back\"] }\n");
  CHECK(names(scene) == std::vector<std::string>{"sphere \"cart 1/wheel 1\"", "sphere \"cart 1/wheel 2\"",
                                                 "sphere \"cart 1/front\"", "sphere \"cart 1/back\"",
                                                 "sphere \"cart 2/wheel 1\"", "sphere \"cart 2/wheel 2\"",
                                                 "sphere \"cart 2/front\"", "sphere \"cart 2/back\""});
}

TEST_CASE("messages begin with the object's name, and appear once for all copies") {
  CHECK(refusals(fmt::format(
            "[[sphere]]\nname = \"left eye\"\ncenter = [0, 0, 0]\nradius = -1\nmaterial = \"wall\"\n"
            "[[sphere]]\nname = \"nose\"\ncentre = [0, 0, 0]\nradius = 1\nmaterial = \"wal\"\n"
            "[[sphere]]\ncenter = [0, 0, 0]\nradius = 0\nmaterial = \"wall\"\n")) ==
        std::vector<std::string>{
            "sphere \"left eye\": `radius` must be a number from 1e-12 to 1e12, not -1",
            "sphere \"nose\": [[sphere]] needs `center`, three numbers [x, y, z], each from -1e12 to 1e12",
            "sphere \"nose\": unknown key `centre` in [[sphere]]; did you mean `center`?",
            "sphere \"nose\": no [[material]] is named \"wal\"; did you mean \"wall\"?",
            "`radius` must be a number from 1e-12 to 1e12, not 0"});
  CHECK(refusals("[[group]]\nname = \"cart\"\nbatch = { transform = [[], [], []] }\n[[group.sphere]]\n"
                 "name = \"wheel\"\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"wal\"\n") ==
        std::vector<std::string>{
            "sphere \"cart 1/wheel\": no [[material]] is named \"wal\"; did you mean \"wall\"?"});
  // An error that concerns only one copy names that copy.
  CHECK(refusals(
            fmt::format("[[group]]\nname = \"cart\"\nbatch = {{ transform = [[], [{{ scale = 1e13 }}]] }}\n"
                        "[[group.sphere]]\nname = \"wheel\"\n{}",
                        sphere))
            .at(0)
            .starts_with("sphere \"cart 2/wheel\": "));
}

TEST_CASE("a name is a string, and not empty") {
  CHECK(refusals(
            fmt::format("[[sphere]]\nname = \"\"\n{0}[[group]]\nname = 7\n[[group.sphere]]\n{0}", sphere)) ==
        std::vector<std::string>{"a name must not be empty; leave `name` out instead",
                                 "`name` must be a string, not 7"});
  CHECK(refusals(fmt::format("[[sphere]]\nradius = 1\nmaterial = \"wall\"\n"
                             "batch = {{ center = [[0, 0, 0], [1, 0, 0]], name = [\"a\", \"\"] }}\n"))
            .size() == 1);
}

TEST_CASE("texts of names are stored once, however many copies a group has") {
  std::string transforms;
  for (int i = 0; i < 1000; ++i) transforms += fmt::format("[{{ translate = [{}, 0, 0] }}],", i);
  const Scene scene =
      parse(fmt::format("[[group]]\nname = \"cart\"\nbatch = {{ transform = [{}] }}\n"
                        "[[group.sphere]]\nname = \"wheel\"\n{}",
                        transforms, sphere));
  CHECK(scene.names.size() == 2000);
  CHECK(names(scene).back() == "sphere \"cart 1000/wheel\"");
}
