// Tests of reports on several scenes.
#include <fmt/format.h>

#include "host/compare/report.hpp"
#include "tests/support/analytic_picture.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::compare;
using namespace eyeray::engine::test;

namespace {

// The report on two frames that stand for the GPU's and the twin's.
Report report_on(const std::string& scene, const Frame& gpu, const Frame& twin) {
  const Frame reference = picture_frame();
  Report report;
  report.scene = scene;
  report.area = reference.area;
  report.seconds = 1.5;
  report.participants = {{"gpu", "gpu: a fake", 0, gpu.rays, inspect(gpu)},
                         {"twin", "twin: a fake", 0, twin.rays, inspect(twin)},
                         {"reference", "reference: a formula", 0, reference.rays, inspect(reference)}};
  report.exact = {{"gpu", "twin", 0, compare_exactly(gpu, twin)}};
  for (const auto& [name, frame] : {std::pair{"gpu", &gpu}, {"twin", &twin}})
    report.against_reference.push_back(
        {name, {}, compare_with_reference(*frame, reference, picture_reference), {}});
  return report;
}

Report good(const std::string& scene) {
  return report_on(scene, picture_frame(), picture_frame());
}

template <typename Change>
Frame changed(const Change& change) {
  Frame frame = picture_frame();
  change(frame);
  return frame;
}

const auto red = [](Frame& frame) { frame.color.pixel(50, 30)[0] += 0.25f; };

Report not_verified(const std::string& scene, bool allowed) {
  Report report;
  report.scene = scene;
  report.not_verified = "it has <no> \"camera\"\nat | all";
  report.may_stay_unverified = allowed;
  return report;
}

std::string diagnosis(const Frame& gpu, const Frame& twin) {
  return report_on("", gpu, twin).diagnosis();
}

bool tells(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("a diagnosis names the first value that differs") {
  const Frame honest = picture_frame();
  const auto of = [&](const auto& change) { return diagnosis(changed(change), honest); };
  const auto hit = [](Frame& frame) -> FirstHit& { return frame.first_hits[30 * picture_width + 50]; };
  CHECK(diagnosis(honest, honest).empty());
  CHECK(of([&](Frame& f) { hit(f).primitive = 0; }).starts_with("camera rays hit another primitive"));
  CHECK(of([&](Frame& f) {
          hit(f).t *= 1.1;
        }).starts_with("camera rays hit the right primitive at the wrong "));
  CHECK(of([&](Frame& f) {
          hit(f).uv.x += 0.1;
        }).starts_with("camera rays hit the right point, but its uv is"));
  CHECK(of([&](Frame& f) {
          hit(f).material = 0;
        }).starts_with("camera rays hit the right point, but with the wrong "));
  CHECK(of([](Frame& f) { *f.hits.pixel(50, 30) += 1; }).starts_with("first hits agree, but reflected"));
  CHECK(of(red).starts_with("all rays have the same hits, but colours differ in direct light"));
  CHECK(of([](Frame& f) {
          f.color.pixel(6, 8)[0] += 0.25f;
        }).starts_with("all rays have the same hits, but colours differ where light is reflected"));
}

TEST_CASE("a diagnosis names the executor that disagrees") {
  const Frame honest = picture_frame(), wrong = changed(red);
  CHECK(tells(diagnosis(wrong, honest), "; twin agrees with the reference: check gpu's data"));
  CHECK(tells(diagnosis(wrong, wrong), "; gpu and twin agree with each other, but not with the reference"));
  CHECK(tells(diagnosis(honest, wrong), "; gpu agrees with the reference: check twin's data"));
  CHECK(tells(diagnosis(changed([](Frame& f) { f.color.pixel(9, 9)[0] += 1; }), wrong), "neither"));
  const Frame one_bit = changed([](Frame& f) { f.color.pixel(50, 30)[0] += 1e-7f; });
  CHECK(diagnosis(one_bit, honest).starts_with("gpu and twin agree with the reference, but not bit by bit"));
}

TEST_CASE("in a suite a scene that cannot be rendered fails, unless it may be skipped") {
  const Report failed = not_verified("b.toml", false), skipped = not_verified("c.toml", true);
  CHECK_FALSE(failed.passes());
  CHECK(failed.verdict() == "failed");
  CHECK(failed.failures()[0].starts_with("not verified: it has "));
  CHECK(skipped.passes());
  CHECK(skipped.verdict() == "skipped");
  CHECK(summary(std::vector<Report>{good("a.toml"), failed, skipped}) ==
        "3 scenes in 1.5 s: 1 passed, 1 failed (b.toml), 1 skipped (c.toml)\n");
  CHECK(summary(std::vector<Report>{good("a.toml"), good("b.toml")}) == "2 scenes in 3.0 s: all passed\n");
  CHECK(to_row(failed, 8) == "failed  b.toml    not verified: it has <no> \"camera\"\n");
  CHECK(to_row(good("a.toml"), 8) ==
        "passed  a.toml       96×72          0 explained       0 unexplained     1.50 s\n");
}

TEST_CASE("JUnit's XML has a case for each scene, and the numbers in the failure's text") {
  const Report bad = report_on("b<&>.toml", changed(red), picture_frame());
  const std::string text =
      to_junit(std::vector<Report>{good("a.toml"), bad, not_verified("c\x01\xff.toml", true)});
  CAPTURE(text);
  CHECK(tells(text, R"(<testsuites name="eyeray verify" tests="3" failures="1" errors="0" skipped="1")"));
  CHECK(tells(text, R"(name="a.toml" file="a.toml" time="1.500">)"));
  CHECK(tells(text, R"(name="b&lt;&amp;&gt;.toml")"));
  CHECK(tells(text, "<failure message=\"gate A: gpu and twin: 1 of 6912 pixels differ in their bits"));
  CHECK(tells(text, "  diagnosis: all rays have the same"));
  CHECK(tells(text, "<skipped message=\"it has &lt;no&gt; &quot;camera&quot;\"/>"));
  CHECK(text.find('\x01') == std::string::npos);
  CHECK(text.find('\xff') == std::string::npos);
}

TEST_CASE("GitHub gets an annotation for each failure, and a table") {
  const std::vector<Report> reports{good("a.toml"), not_verified("b,c:d%.toml", false)};
  CHECK(to_annotations(reports) ==
        "::error file=b%2Cc%3Ad%25.toml,title=eyeray verify::not verified: it has <no> \"camera\"\n");
  const std::string table = to_markdown(reports);
  CHECK(tells(table, "| a.toml | passed | 6912 | 0 | 0 | 1.50 |  |\n"));
  CHECK(tells(table,
              "| b,c:d%.toml | failed | 0 | 0 | 0 | 0.00 | not verified: it has &lt;no> \"camera\" |\n"));
}
