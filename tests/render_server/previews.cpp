// The pictures that the worker of dev shows while a kernel compiles.
#include <algorithm>

#include "served.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

constexpr const char* text = R"(
[image]
width = 40
height = 30
samples = 4
[camera]
eye = [0, 0, 4]
target = [0, 0, 0]
[[light]]
type = "point"
position = [2, 4, 5]
intensity = 60
[[material]]
name = "stripes"
type = "phong"
[material.diffuse.formula]
code = "vec3 color(vec2 uv) { return vec3(fract(uv * stripes), 0.5); }"
parameters = { stripes = 7.5 }
[[sphere]]
center = [0, 0, 0]
radius = 1
material = "stripes"
)";

bool is_preview(const Json& rows) {
  return rows.at("preview");
}

}  // namespace

TEST_CASE("the twin shows the picture until the kernel is ready, which changes no bit of it") {
  Served served(text);
  served.ask(1, "material.0.diffuse.formula.parameters.stripes=5", true);
  const std::vector<Json> rows = served.rows(1);
  CHECK(is_preview(rows.front()));
  CHECK(rows.front().at("stride") == 8);
  CHECK_FALSE(is_preview(rows.back()));
  CHECK(rows.back().at("sample") == 3);
  // Shown rows are not replaced by coarser ones.
  const auto first = std::ranges::find_if_not(rows, is_preview);
  CHECK(std::ranges::none_of(first, rows.end(), is_preview));
  CHECK(first->at("stride") == 1);
  CHECK(first->at("sample") >= std::prev(first)->at("sample"));
  const std::vector<float> with_preview = served.picture();

  served.ask(2, "material.0.diffuse.formula.parameters.stripes=5", false);
  CHECK(std::ranges::none_of(served.rows(2), is_preview));
  CHECK(served.picture() == with_preview);
}

TEST_CASE("a newer edit ends a preview, though the kernel of the older one still compiles") {
  Served served(text);
  served.ask(1, "material.0.diffuse.formula.parameters.stripes=5", true);
  while (served.next(1).at("event") != "rows") {
  }
  const std::string newer =
      "material.0.diffuse.formula.code=\"vec3 color(vec2 uv) { return vec3(sin(uv * stripes), 1.0); }\"";
  served.ask(2, newer, true);
  served.rows(2);
  const std::vector<float> picture = served.picture();
  served.ask(3, newer, false);
  served.rows(3);
  CHECK(served.picture() == picture);
}

TEST_CASE("colours have the scene's tone; a metered exposure is that of the first rows") {
  Served served(text);
  served.ask(1, "image.exposure=-1.5", false);
  for (const Json& rows : served.rows(1)) CHECK(rows.at("tone").at("exposure") == -1.5);
  CHECK(served.board.picture("gpu")->tone.exposure == -1.5);
  served.ask(2, "image.exposure=auto", true);
  const std::vector<Json> rows = served.rows(2);
  for (const Json& each : rows) CHECK(each.at("tone") == rows.front().at("tone"));
  const double exposure = rows.front().at("tone").at("exposure");
  served.ask(3, "render.background=0", false);
  CHECK(served.rows(3).front().at("tone").at("exposure") == 0);
  CHECK(exposure != 0);
}
