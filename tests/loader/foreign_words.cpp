// Tests of suggestions for the words of other renderers.
#include "host/reading/foreign_words.hpp"

#include <vector>

#include "host/loader/sections.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

namespace {

std::string suggested(std::string_view word, const std::vector<std::string_view>& names) {
  return reading::suggest_name(word, names);
}

}  // namespace

TEST_CASE("a word of another renderer suggests eyeray's word, where there is one") {
  CHECK(suggested("look_at", {"eye", "target"}) == "target");
  CHECK(suggested("focal_length", {"eye", "fov"}) == "fov");
  CHECK(suggested("LookAt", {"eye", "target"}) == "target");
  CHECK(suggested("look_at", {"eye", "size"}) == "");
  // The meaning of a word depends on its table.
  CHECK(suggested("location", {"eye", "target", "up"}) == "eye");
  CHECK(suggested("location", {"type", "position", "direction"}) == "position");
  CHECK(suggested("location", {"center", "radius", "transform"}) == "center");
  CHECK(suggested("location", {"min", "max", "transform"}) == "transform");
  CHECK(suggested("colour", {"diffuse", "specular"}) == "diffuse");
  CHECK(suggested("colour", {"type", "intensity"}) == "intensity");
  CHECK(suggested("colour", {"center", "radius", "material"}) == "material");
}

TEST_CASE("a typing error is still corrected, and a foreign word never replaces one of eyeray's") {
  CHECK(suggested("raduis", {"center", "radius"}) == "radius");
  CHECK(suggested("maxDepth", {"max_depth", "min_throughput"}) == "max_depth");
  CHECK(suggested("", {"center"}) == "");
  CHECK(suggested(std::string(100'000, 'a'), {"center"}) == "");
  CHECK(suggested(" ", {"center", "eye"}) == "");
}

TEST_CASE("the tables of other renderers suggest eyeray's tables") {
  CHECK(suggest_section("light_source") == "did you mean [[light]]?");
  CHECK(suggest_section("global_settings") == "did you mean [render]?");
  CHECK(suggest_section("difference") == "did you mean [[csg]]?");
  CHECK(suggest_section("isosurface") == "did you mean [[implicit]]?");
  CHECK(suggest_section("cuboid") == "did you mean [[box]]?");
  CHECK(suggest_section("fog") == "did you mean [medium]?");
  CHECK(suggest_section("film") == "did you mean [image]?");
}
