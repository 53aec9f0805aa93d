#include "host/compare/report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/core/diagnostic.hpp"
#include "host/core/github_text.hpp"
#include "tests/support/analytic_picture.hpp"
#include "tests/support/nasty_strings.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::compare;
using namespace eyeray::engine::test;

namespace {

Report report_on(const Frame& value) {
  const Frame reference = picture_frame();
  Report report;
  report.scene = "scenes/analytic.toml";
  report.width = picture_width;
  report.height = picture_height;
  report.area = reference.area;
  report.participants = {{"twin", "twin: a fake", 0.5, value.rays, inspect(value)},
                         {"reference", "reference: a formula", 1.5, reference.rays, inspect(reference)}};
  ReferenceResult result;
  result.value = "twin";
  result.comparison = compare_with_reference(value, reference, picture_reference);
  if (result.comparison.incomparable.empty()) result.metrics = measure(value.color, reference.color);
  report.against_reference = {result};
  return report;
}

bool contains(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("a passing report states the verdict first, then the counts") {
  const Report report = report_on(picture_frame(Vec2(5e-5)));
  const std::string text = to_text(report);
  CAPTURE(text);
  CHECK(text.starts_with("PASSED scenes/analytic.toml (96×72 of 96×72 pixels, 1 sample a pixel)\n"));
  CHECK(contains(
      text,
      "32 explained (silhouette 8, texture edge 8, refraction branch 8, shadow edge 8), 0 unexplained"));
  CHECK(contains(text, "FLIP"));
  CHECK_FALSE(contains(text, "look closer"));
}

TEST_CASE("hit objects have the names of the scene, if it has names") {
  Frame value = picture_frame();
  FirstHit& hit = value.first_hits[size_t(30 * picture_width + 94)];
  hit.t *= 1.5;
  Report report = report_on(value);
  const std::vector<FirstHit> shown = report.shown_hits();
  const auto is_it = [&](const FirstHit& other) {
    return other.primitive == hit.primitive && other.t == hit.t;
  };
  CHECK(std::any_of(shown.begin(), shown.end(), is_it));
  CHECK_FALSE(contains(to_text(report), "left eye"));

  report.primitives[hit.primitive] = "sphere \"left eye\", face.toml:24";
  report.materials[hit.material] = "\"glass\"";
  CHECK(contains(to_text(report), fmt::format("primitive {} (sphere \"left eye\", face.toml:24), material {} "
                                              "(\"glass\"), t ",
                                              hit.primitive, hit.material)));
  const auto json = nlohmann::json::parse(to_json(std::span(&report, 1)));
  CHECK(json.at("scenes")[0].at("primitives").at(std::to_string(hit.primitive)) ==
        "sphere \"left eye\", face.toml:24");
  CHECK(json.at("scenes")[0].at("materials").at(std::to_string(hit.material)) == "\"glass\"");
}

TEST_CASE("a failing report names the gate, the pixel, the seam, and the command that shows it") {
  Frame value = picture_frame();
  value.first_hits[size_t(30 * picture_width + 94)].t *= 1.5;
  value.color.pixel(94, 30)[0] += 0.25f;
  Report report = report_on(value);
  report.kept = "analytic.verify";
  const std::string text = to_text(report);
  CAPTURE(text);
  CHECK(text.starts_with("FAILED scenes/analytic.toml"));
  CHECK(contains(text,
                 "gate B: twin against the reference, colours: 1 of 6912 pixels differ unexplained; the "
                 "worst is 94,30, which diverges at t"));
  CHECK(contains(text, "look closer: eyeray verify scenes/analytic.toml --crop 87,26,9,9\n"));
  CHECK(contains(text, "its rays: eyeray probe scenes/analytic.toml 94,30\n"));
  CHECK(contains(text, "kept in analytic.verify"));
}

TEST_CASE("shaders that are not eyeray's own are named before what fails, and when nothing fails") {
  Frame value = picture_frame();
  value.color.pixel(50, 30)[1] += 0.5f;
  for (const bool fails : {true, false}) {
    CAPTURE(fails);
    Report report = report_on(fails ? value : picture_frame());
    for (int i = 0; i < 9; ++i) report.changed_shaders.push_back(fmt::format("my/{}.glsl", i));
    const std::string text = to_text(report), junit = to_junit(std::span(&report, 1));
    const std::string note = "shaders that differ from eyeray's own: my/0.glsl, my/1.glsl, ";
    CHECK(text.substr(text.find('\n')).starts_with("\n  " + note));
    CHECK(contains(text, "my/7.glsl and 1 more; the twin has the built-in ones\n"));
    CHECK(contains(junit, (fails ? "<failure message=\"" : "\n  ") + note));
    const auto scene = nlohmann::json::parse(to_json(std::span(&report, 1)))["scenes"][0];
    CHECK(scene["changed_shaders"].size() == 9);
    CHECK(scene["failures"].empty() == !fails);
    CHECK(contains(to_annotations(std::span(&report, 1)), "::" + note) == fails);
    report.twin_has_changed_shaders = true;
    CHECK_FALSE(contains(to_text(report), "the twin uses"));
  }
}

TEST_CASE("no name of a scene or of a shader is a command, markup or a column, wherever it is shown") {
  Frame value = picture_frame();
  value.color.pixel(50, 30)[1] += 0.5f;
  const auto count = [](const std::string& text, const std::string& what) {
    int64_t found = 0;
    for (size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  // A pipe that ends a cell has an even number of backslashes before it.
  const auto cells = [](const std::string& text) {
    int ends = 0, backslashes = 0;
    for (const char c : text) {
      ends += c == '|' && backslashes % 2 == 0;
      backslashes = c == '\\' ? backslashes + 1 : 0;
    }
    return ends;
  };
  Report plain = report_on(value);
  plain.changed_shaders = {"a"};
  const std::span plain_only(&plain, 1);
  for (const std::string& name : nasty_strings) {
    CAPTURE(name);
    Report report = plain;
    report.scene = name;
    report.changed_shaders = {name};
    report.options = " --shaders '" + name + "'";
    const std::span only(&report, 1);
    for (const std::string& text : {to_text(report), to_row(report, 10), summary(only)}) {
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);) CHECK(line == log_line(line));
    }
    for (const char* mark : {"<", ">", "\""})
      CHECK(count(to_junit(only), mark) == count(to_junit(plain_only), mark));
    std::istringstream junit(to_junit(only));
    for (std::string line; std::getline(junit, line);) CHECK(line == printable(line));
    const auto table = [](const std::string& markdown) { return markdown.substr(markdown.find("| scene")); };
    const std::string markdown = table(to_markdown(only)), plain_markdown = table(to_markdown(plain_only));
    CHECK(count(markdown, "\n") == count(plain_markdown, "\n"));
    CHECK(cells(markdown) == cells(plain_markdown));
    CHECK(count(to_markdown(only), "<") == 0);
    std::istringstream annotations(to_annotations(only));
    for (std::string line; std::getline(annotations, line);) {
      REQUIRE(line.starts_with("::error file="));
      CHECK(count(line.substr(0, line.find(",title=eyeray verify::")), ",") == 0);
      CHECK(line == printable(line));
    }
    const auto scene = nlohmann::json::parse(to_json(only))["scenes"][0];
    if (name.find('\xff') == std::string::npos) CHECK(scene["scene"] == name);
  }
}

TEST_CASE("JSON has the report's values, and null for a NaN") {
  Frame value = picture_frame();
  value.color.pixel(50, 30)[1] = std::nanf("");
  const std::vector<Report> reports{report_on(picture_frame()), report_on(value)};
  const std::string text = to_json(reports);
  CHECK(std::count(text.begin(), text.end(), '\n') == 1);
  const nlohmann::json json = nlohmann::json::parse(text);
  CHECK(json["passed"] == false);
  CHECK(json["scenes"][0]["passed"] == true);
  CHECK(json["scenes"][1]["passed"] == false);
  CHECK(json["scenes"][1]["executors"][0]["nan"] == 1);
  CHECK(json["scenes"][1]["executors"][0]["passed"] == false);
  const auto& colors = json["scenes"][1]["gates_b_c"][0]["colors"];
  CHECK(colors["unexplained"] == 1);
  CHECK(colors["worst"]["pixel"] == nlohmann::json::array({50, 30}));
  CHECK(colors["worst"]["seam"] == "color");
  CHECK(colors["worst"]["value"]["color"][1].is_null());
  CHECK(json["scenes"][0]["gates_b_c"][0]["metrics"]["rmse"].get<double>() < 1e-6);
  CHECK(nlohmann::json::parse(to_json({}))["passed"] == false);
}

TEST_CASE("the summary of several scenes names those that failed") {
  const Report good = report_on(picture_frame()), bad = report_on(picture_frame(Vec2(1, 0)));
  CHECK(summary(std::vector<Report>{good, good}) == "2 scenes in 0.0 s: all passed\n");
  CHECK(summary(std::vector<Report>{good, bad}) ==
        "2 scenes in 0.0 s: 1 passed, 1 failed (scenes/analytic.toml)\n");
}

TEST_CASE("ULP distances count floats") {
  CHECK(ulp_distance(1.0f, 1.0f) == 0);
  CHECK(ulp_distance(1.0f, std::nextafter(1.0f, 2.0f)) == 1);
  CHECK(ulp_distance(0.0f, -0.0f) == 0);
  CHECK(ulp_distance(-1e-45f, 1e-45f) == 2);
  CHECK(ulp_distance(1.0f, 2.0f) == 1 << 23);
  CHECK(ulp_distance(std::nanf(""), std::nanf("")) == 0);
  CHECK(ulp_distance(std::nanf(""), 1.0f) == std::numeric_limits<int64_t>::max());
}
