// Why pixels differ, as a picture.
#include <nlohmann/json.hpp>

#include "host/compare/cause_picture.hpp"
#include "tests/support/analytic_picture.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::compare;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

namespace {

std::vector<PixelOutcome> outcomes_of(const Frame& value) {
  std::vector<PixelOutcome> outcomes;
  compare_with_reference(value, picture_frame(), picture_reference, {}, &outcomes);
  return outcomes;
}

}  // namespace

TEST_CASE("each pixel has the worst outcome of all compared values") {
  Frame value = picture_frame(Vec2(5e-5));
  value.color.pixel(50, 30)[0] += 0.25f;
  value.first_hits[40 * picture_width + 50].uv.x += 0.5;
  const std::vector<PixelOutcome> outcomes = outcomes_of(value);
  REQUIRE(outcomes.size() == size_t(picture_width * picture_height));
  const auto at = [&](int x, int y) { return outcomes[size_t(y * picture_width + x)]; };
  CHECK(at(50, 30).outcome == Outcome::unexplained);
  CHECK(at(50, 40).outcome == Outcome::unexplained);
  CHECK(at(51, 40).outcome <= Outcome::matching);
  CHECK(at(88, 6).outcome == Outcome::explained);
  CHECK(at(88, 6).cause == Cause::silhouette);
  CHECK(at(6, 60).cause == Cause::shadow_edge);
}

TEST_CASE("the picture of causes has a colour for each cause, and the legend names it") {
  Frame value = picture_frame(Vec2(5e-5));
  value.color.pixel(50, 30)[0] += 0.25f;
  const std::vector<PixelOutcome> outcomes = outcomes_of(value);
  const auto legend = nlohmann::json::parse(cause_legend(outcomes));
  CHECK(legend.size() == 5);
  CHECK(legend.at("silhouette").at("pixels") == edge_pixels);
  CHECK(legend.at("unexplained") == nlohmann::json{{"color", "#ff0000"}, {"pixels", 1}});

  const Image picture = cause_picture(picture_frame().color, outcomes);
  CHECK(color_at(picture, 50, 30) == Vec3(1, 0, 0));
  CHECK(color_at(picture, 88, 6).z > color_at(picture, 88, 6).y);
  const Vec3 grey = color_at(picture, 51, 30);
  CHECK(grey.x == grey.y);
  CHECK(grey.x < 0.2);
  CHECK(cause_legend(outcomes_of(picture_frame())) == "{}\n");
}
