// TableReader over every KeyType, with the test's own keys.
#include "host/reading/table.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::reading;

namespace {

constexpr std::string_view colors[] = {"red", "green"};
constexpr Key keys[] = {
    {.name = "flag", .type = KeyType::boolean, .doc = "A flag.", .fallback = "true"},
    {.name = "count", .type = KeyType::integer, .doc = "A count.", .fallback = "3", .min = 0, .max = 9},
    {.name = "size",
     .type = KeyType::number,
     .doc = "A size.",
     .fallback = "0.5",
     .min = 0,
     .max = 1,
     .above_min = true},
    {.name = "label", .type = KeyType::string, .doc = "A label.", .fallback = "\"none\""},
    {.name = "tint", .type = KeyType::choice, .doc = "A tint.", .fallback = "\"green\"", .choices = colors},
    {.name = "uv", .type = KeyType::vec2, .doc = "A pair.", .fallback = "[1, 2]"},
    {.name = "points", .type = KeyType::vec3_list, .doc = "Points.", .fallback = "[[1, 2, 3]]"},
    {.name = "rings", .type = KeyType::outlines, .doc = "Lists of points.", .fallback = "[]"},
    {.name = "pairs", .type = KeyType::vec2_list, .doc = "Pairs.", .fallback = "[]"},
    {.name = "stretch", .type = KeyType::scale3, .doc = "A stretch.", .fallback = "2"},
    {.name = "maybe", .type = KeyType::number, .doc = "Perhaps.", .optional = true},
    {.name = "must", .type = KeyType::vec3, .doc = "Needed.", .min = 5},
};

struct Fixture {
  explicit Fixture(const std::string& text)
      : table(toml::parse(text, std::string("t"))),
        reader((log.add_source("t", text), read_table({"[t]", &table, {keys}}, log))) {}
  std::vector<std::string> messages() const {
    std::vector<std::string> all;
    for (const Diagnostic& diagnostic : log.sorted()) all.push_back(diagnostic.message);
    return all;
  }
  DiagnosticLog log;
  toml::table table;
  TableReader reader;
};

}  // namespace

TEST_CASE("values in a table are read") {
  const Fixture t(R"(flag = false
count = 9
size = 1
label = "x"
tint = "red"
uv = [3, -4.5]
points = [[1, 2, 3], [4, 5, 6]]
pairs = [[7, 8]]
rings = [[[1, 2, 3]], [[4, 5, 6], [7, 8, 9]]]
stretch = [1, 2, 3]
maybe = -1
must = [5, 6, 7])");
  CHECK(t.messages().empty());
  CHECK_FALSE(t.reader.failed());
  CHECK(t.reader.boolean("flag") == false);
  CHECK(t.reader.integer("count") == 9);
  CHECK(t.reader.number("size") == 1);
  CHECK(t.reader.string("label") == "x");
  CHECK(t.reader.choice("tint") == 0);
  CHECK(t.reader.vec2("uv") == Vec2(3, -4.5));
  CHECK(t.reader.vec3_list("points") == std::vector{Vec3(1, 2, 3), Vec3(4, 5, 6)});
  CHECK(t.reader.vec2_list("pairs") == std::vector{Vec2(7, 8)});
  CHECK(t.reader.outlines("rings") ==
        std::vector<std::vector<Vec3>>{{Vec3(1, 2, 3)}, {Vec3(4, 5, 6), Vec3(7, 8, 9)}});
  CHECK(t.reader.scale3("stretch") == Vec3(1, 2, 3));
  CHECK(t.reader.has("maybe"));
  CHECK(t.reader.vec3("must") == Vec3(5, 6, 7));
}

TEST_CASE("missing values have defaults") {
  const Fixture t("must = [5, 5, 5]");
  CHECK(t.messages().empty());
  CHECK(t.reader.boolean("flag") == true);
  CHECK(t.reader.integer("count") == 3);
  CHECK(t.reader.number("size") == 0.5);
  CHECK(t.reader.string("label") == "none");
  CHECK(t.reader.choice("tint") == 1);
  CHECK(t.reader.vec2("uv") == Vec2(1, 2));
  CHECK(t.reader.vec3_list("points") == std::vector{Vec3(1, 2, 3)});
  CHECK(t.reader.vec2_list("pairs").empty());
  CHECK(t.reader.scale3("stretch") == Vec3(2));
  CHECK_FALSE(t.reader.has("flag"));
  CHECK_FALSE(t.reader.has("maybe"));
}

TEST_CASE("each wrong value is an error and gets a valid stand-in") {
  Fixture t(
      "flag = 1\ncount = 10\nsize = 0\nlabel = 3\ntint = \"rod\"\nuv = [1]\npoints = [1]\nstretch = [1, "
      "2]\nmaybe = nan");
  CHECK(t.messages() == std::vector<std::string>{
                            "[t] needs `must`, three numbers [x, y, z], each at least 5",
                            "`flag` must be true or false, not 1",
                            "`count` must be an integer from 0 to 9, not 10",
                            "`size` must be a number above 0, at most 1, not 0",
                            "`label` must be a string, not 3",
                            "`tint` must be \"red\" or \"green\", not \"rod\"; did you mean \"red\"?",
                            "`uv` must be two numbers [x, y], not a list of 1",
                            "`points` must be a list of points [[x, y, z], …], not 1",
                            "`stretch` must be three numbers [x, y, z] or one for all, not a list of 2",
                            "`maybe` must be finite, not nan",
                        });
  CHECK(t.reader.failed());
  CHECK(t.reader.integer("count") == 3);
  CHECK(t.reader.number("size") == 0.5);
  CHECK(t.reader.vec3("must") == Vec3(5));
  CHECK_FALSE(t.reader.valid("must"));
  CHECK_FALSE(t.reader.valid("count"));

  // A second error about the same value is ignored.
  t.reader.error("count", "secondary");
  t.reader.error("pairs", "primary");
  CHECK(t.messages().size() == 11);
  CHECK(t.log.sorted()[0].position.line == 1);
}

TEST_CASE("a number that vanishes in float32 is not positive") {
  CHECK(Fixture("must = [5, 5, 5]\nsize = 1e-20").messages() ==
        std::vector<std::string>{"`size` is 1e-20, too small for float32 arithmetic (at least 1e-15)"});
}
