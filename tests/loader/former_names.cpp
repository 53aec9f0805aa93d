// Former names of keys are read like today's names, in files and by -D.
#include "host/loader/scene_file.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

namespace {

// Two CSG objects, the second with one in it; `csg`: the name of their tables.
std::string scene_with(const std::string& csg) {
  std::string text = "[[material]]\nname = \"wall\"\ntype = \"phong\"\n";
  for (const std::string& table : {csg, csg, csg + "." + csg})
    text +=
        "[[" + table + "]]\nmaterial = \"wall\"\n[[" + table + ".sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";
  return text;
}

}  // namespace

TEST_CASE("[[solid]] is an alias of [[csg]], wherever it is nested") {
  const Scene then = parse_scene(scene_with("solid"), "scene.toml");
  const Scene now = parse_scene(scene_with("csg"), "scene.toml");
  REQUIRE(then.shapes.size() == 2);
  REQUIRE(now.shapes.size() == 2);
  for (const size_t i : {0, 1}) CHECK(then.shapes[i]->type == now.shapes[i]->type);
  // Tables under both names in one file make one list.
  CHECK(parse_scene(scene_with("solid") + "[[csg]]\nmaterial = \"wall\"\n[[csg.sphere]]\ncenter = [0, 0, "
                                          "0]\nradius = 1\n",
                    "scene.toml")
            .shapes.size() == 3);
}

TEST_CASE("min_weight is an alias of min_throughput, in a file and by -D") {
  CHECK(parse_scene("[render]\nmin_weight = 0.25\n", "scene.toml").render.min_throughput == 0.25);
  const std::vector<Override> change{{"render.min_weight=0.5"}};
  CHECK(parse_scene("", "scene.toml", change).render.min_throughput == 0.5);
}
