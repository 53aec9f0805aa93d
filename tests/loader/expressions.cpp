// Numbers that are computed: expressions, the variables of [let], and the counters of `repeat`.
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "host/reading/number_expression.hpp"
#include "tests/loader/walls.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;
using loader::parse_scene;

namespace {

double value_of(std::string_view text, const reading::Variables& variables = {}) {
  const auto values = reading::evaluate(text, variables);
  REQUIRE(values.size() == 1);
  return values[0];
}

constexpr std::string_view wall = "[[material]]\nname = \"wall\"\ntype = \"phong\"\n";

// The fault's offset and message.
std::string fault_in(std::string_view text, const reading::Variables& variables = {}) {
  try {
    reading::evaluate(text, variables);
  } catch (const reading::ExpressionFault& fault) {
    return fmt::format("{}: {}", fault.offset, fault.what());
  }
  return "none";
}

Vec3 middle(const Scene& scene, size_t shape) {
  const Bounds bounds = scene.shapes.at(shape)->bounds();
  return (bounds.min + bounds.max) * 0.5;
}

}  // namespace

TEST_CASE("an expression has the operators and precedences of C") {
  const auto check = [](std::string_view text, double value) {
    CAPTURE(text);
    CHECK(value_of(text) == value);
  };
  check("=1+2*3", 7);
  check("= (1 + 2) * 3 ", 9);
  check("= 7 - 2 - 1", 4);
  check("= 12 / 2 / 3", 2);
  check("= -2 * -3", 6);
  check("= 2 - -3", 5);
  check("= - - 3", 3);
  check("= 1.5e2 + .5", 150.5);
  check("= 7 % 3", 1);
  check("= -1 % 3", 2);
  check("= 1 < 2 && 2 <= 2 && 3 > 2 && 3 >= 3 && 1 != 2 && !0", 1);
  check("= 1 == 2 || 2 < 1", 0);
  check("= 0 ? 1 : 1 ? 2 : 3", 2);
  check("= 1 + 1 == 2 ? 10 : 20", 10);
}

TEST_CASE("functions return what the C library does") {
  const std::pair<std::string_view, double> values[] = {
      {"= abs(-2)", 2},
      {"= sign(-0.1) + sign(3) + sign(0)", 0},
      {"= floor(-1.5) + ceil(-1.5) + round(2.6)", 0},
      {"= fract(-0.25)", 0.75},
      {"= sqrt(2) * sqrt(2)", std::sqrt(2.0) * std::sqrt(2.0)},
      {"= exp(1) - log(2)", std::exp(1.0) - std::log(2.0)},
      {"= pow(2, 0.5)", std::pow(2, 0.5)},
      {"= sin(1) + cos(2) + tan(3)", std::sin(1.0) + std::cos(2.0) + std::tan(3.0)},
      {"= asin(0.1) + acos(0.2)", std::asin(0.1) + std::acos(0.2)},
      {"= atan(2) + atan(1, -2)", std::atan(2.0) + std::atan2(1.0, -2.0)},
      {"= degrees(radians(90)) + 2 * pi", 90 + 2 * M_PI},
      {"= min(3, 1, 2) + max(3, 1, 2)", 4},
      {"= clamp(5, 0, 1) + clamp(-5, 0, 1)", 1},
      {"= mix(2, 4, 0.25) + mod(-1, 4)", 5.5},
  };
  for (const auto& each : values) {
    CAPTURE(each.first);
    CHECK(value_of(each.first) == doctest::Approx(each.second).epsilon(1e-14));
  }
}

TEST_CASE("random numbers are determined by their arguments, differ, and are spread evenly") {
  CHECK(value_of("= random(3)") == value_of("= random(1 + 2)"));
  CHECK(value_of("= random(1, 2)") != value_of("= random(2, 1)"));
  CHECK(value_of("= random(0)") == value_of("= random(-0)"));
  std::set<double> seen;
  double sum = 0, squares = 0;
  constexpr int count = 10000;
  for (int i = 0; i < count; ++i) {
    const double x = value_of(fmt::format("= random({})", i));
    REQUIRE((x >= 0 && x < 1));
    seen.insert(x);
    sum += x;
    squares += x * x;
  }
  CHECK(seen.size() == count);
  CHECK(std::fabs(sum / count - 1.0 / 2) < 0.015);  // five standard errors
  CHECK(std::fabs(squares / count - 1.0 / 3) < 0.015);
}

TEST_CASE("a fault in an expression has an offset and a reason") {
  reading::Variables variables;
  variables.add("width", {2});
  variables.add("sizes", {1, 2, 3});
  CHECK(fault_in("=", variables) == "1: a number, a name or `(` is missing here");
  CHECK(fault_in("= 2 *", variables) == "5: a number, a name or `(` is missing here");
  CHECK(fault_in("= 2 width", variables) == "4: an operator is missing here");
  CHECK(fault_in("= (2", variables) == "4: `)` is missing here");
  CHECK(fault_in("= widht", variables) ==
        "2: `widht` is neither a variable nor a function; did you mean `width`?");
  CHECK(fault_in("= colour", variables) ==
        "2: `colour` is neither a variable nor a function; the variables are sizes, width");
  CHECK(fault_in("= q") == "2: `q` is neither a variable nor a function; variables are the keys of [let]");
  CHECK(fault_in("= sizes + 1", variables) ==
        "2: `sizes` is a list of 3 numbers; write sizes[0] to sizes[2], or `sizes` alone");
  CHECK(fault_in("= sizes[3]", variables) == "8: `sizes` has no number 3; they count from 0 to 2");
  CHECK(fault_in("= sizes[0.5]", variables) == "8: `sizes` has no number 0.5; they count from 0 to 2");
  CHECK(fault_in("= atan(1, 2, 3)") == "2: `atan` takes 1 to 2, not 3 arguments");
  CHECK(fault_in("= sqrt()") == "2: `sqrt` takes 1, not 0 arguments");
  CHECK(fault_in("= 1 ? 2") == "7: `:` is missing here");
  CHECK(fault_in("= 1e999") == "2: this is no number");
  CHECK(fault_in("=" + std::string(100000, '(')).ends_with("the expression is nested more than 64 deep"));
  CHECK(
      fault_in("=" + std::string(100000, '!') + "1").ends_with("the expression is nested more than 64 deep"));
  CHECK(value_of("=" + std::string(100000, '-') + "1") == 1);
}

TEST_CASE("a list is a value, has numbers, and need not have those of a branch not taken") {
  reading::Variables variables;
  variables.add("sizes", {1, 2, 3});
  variables.add("one", {7});
  CHECK(reading::evaluate("= sizes ", variables) == std::vector<double>{1, 2, 3});
  CHECK(value_of("= sizes[1 + 1] * sizes[0]", variables) == 3);
  CHECK(value_of("= one[0] + one", variables) == 14);
  CHECK(value_of("= 1 > 2 ? sizes[9] : sizes[0]", variables) == 1);
}

TEST_CASE("variables stand for numbers of every kind, in any order") {
  const Scene scene = parse_walls(
      "[let]\nb = \"= a * 2\"\na = 1.5\ncentre = [1, \"= b\", -1]\nwide = 320\n"
      "[image]\nwidth = \"= wide\"\nheight = \"= wide / 2\"\n"
      "[render]\nbackground = \"= b / 4\"\n"
      "[camera]\neye = \"= centre\"\nfov = \"= 10 * b\"\n"
      "[[sphere]]\ncenter = \"= centre\"\nradius = \"= b\"\nmaterial = \"wall\"\n"
      "transform = [{ translate = [\"= a\", 0, 0] }, { scale = \"= 2 * a\" }, "
      "{ rotate = { axis = [0, 0, 1], degrees = \"= 60 * a\" } }]\n");
  CHECK(scene.image.width == 320);
  CHECK(scene.image.height == 160);
  CHECK(scene.render.background == Vec3(0.75));
  CHECK(scene.camera.eye == Vec3(1, 3, -1));
  CHECK(glm::length(middle(scene, 0) - Vec3(-9, 7.5, -3)) < 1e-12);
}

TEST_CASE("-D sets a variable, and a track moves one") {
  const std::string text =
      std::string(wall) +
      "[let]\nx = 1\n[[sphere]]\ncenter = [\"= x\", 0, 0]\nradius = 1\nmaterial = \"wall\"\n";
  const loader::Override change[] = {{"let.x=7"}};
  CHECK(middle(parse_scene(text, "scene.toml", change), 0).x == 7);
  const loader::Override frame[] = {{"animation.frame=5"}};
  const std::string moved = text + "[[track]]\ntarget = \"let.x\"\nkeyframes = [[0, 0], [10, 100]]\n";
  CHECK(middle(parse_scene(moved, "scene.toml", frame), 0).x == 50);
}

TEST_CASE("a table is repeated for each combination of its counters") {
  const Scene scene = parse_walls(
      "[let]\nn = 3\n[[sphere]]\nname = \"ball\"\nrepeat = { i = 2, j = \"= n\" }\n"
      "center = [\"= 10 * i\", \"= j\", 0]\nradius = 0.1\nmaterial = \"wall\"\n");
  REQUIRE(scene.shapes.size() == 6);
  for (size_t k = 0; k < 6; ++k) CHECK(middle(scene, k) == Vec3(10.0 * double(k / 3), double(k % 3), 0));
  CHECK(describe("sphere", scene.shapes[4]->name, scene.names) == "sphere \"ball 5\"");
}

TEST_CASE("lights, area lights, parts of CSG objects and instances are repeated") {
  const Scene scene = parse_walls(
      "[[light]]\ntype = \"point\"\nrepeat = { i = 4 }\nposition = [\"= i\", 5, 0]\nintensity = \"= 1 + i\"\n"
      "[[light]]\ntype = \"area\"\nshape = \"sphere\"\nrepeat = { i = 2 }\ncenter = [0, \"= 9 + i\", 0]\n"
      "radius = 0.5\nintensity = 1\n"
      "[[csg]]\nmaterial = \"wall\"\n[[csg.sphere]]\nrepeat = { i = 3 }\ncenter = [\"= i\", 0, 0]\nradius = "
      "1\n"
      "[[group]]\nname = \"post\"\npattern = true\n" +
      sphere("group.sphere", 50) +
      "[[instance]]\ngroup = \"post\"\nrepeat = { i = 2 }\ntransform = [{ translate = [0, \"= 100 * i\", 0] "
      "}]\n");
  CHECK(scene.lights.size() == 4);
  REQUIRE(scene.shapes.size() == 5);
  CHECK(middle(scene, 1).y == 10);
  CHECK(scene.shapes[2]->bounds().max.x == 3);
  CHECK(middle(scene, 4).y == 100);
}

TEST_CASE("a group's counters reach its members, and the copies differ even where groups are instanced") {
  const loader::Override instanced[] = {{"render.groups=instanced"}};
  const std::string text =
      std::string(wall) +
      "[[group]]\nrepeat = { i = 3 }\ntransform = [{ translate = [\"= 10 * i\", 0, 0] }]\n"
      "[[group.sphere]]\ncenter = [0, \"= SIZE\", 0]\nradius = 0.5\nmaterial = \"wall\"\n";
  const auto with = [&](const std::string& size) {
    std::string changed = text;
    return changed.replace(changed.find("SIZE"), 4, size);
  };
  const Scene varying = parse_scene(with("i"), "scene.toml", instanced);
  REQUIRE(varying.shapes.size() == 3);
  CHECK(middle(varying, 2) == Vec3(20, 2, 0));
  const Scene same = parse_scene(with("1"), "scene.toml", instanced);
  CHECK(same.shapes.empty());
  CHECK(same.group_instances.size() == 3);
}

TEST_CASE("the counters of an instance do not reach into its group") {
  CHECK(refused("[[group]]\nname = \"post\"\npattern = true\n"
                "[[group.sphere]]\ncenter = [\"= i\", 0, 0]\nradius = 1\nmaterial = \"wall\"\n"
                "[[instance]]\ngroup = \"post\"\nrepeat = { i = 2 }\n")
            .find("`i` is neither a variable nor a function") != std::string::npos);
}

TEST_CASE("variables that need each other, and repetitions beyond all memory, are refused") {
  CHECK(
      refused("[let]\na = \"= b\"\nb = \"= c + 1\"\nc = \"= b\"\n").find("`b` is needed to compute itself") !=
      std::string::npos);
  CHECK(refused("[[sphere]]\nrepeat = { i = 100000, j = 100000 }\ncenter = [0, 0, 0]\nradius = 1\n"
                "material = \"wall\"\n")
            .find("`repeat` makes more than 67108864 copies") != std::string::npos);
}
