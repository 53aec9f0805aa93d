#include "host/compare/explain.hpp"

#include <cmath>

#include "host/compare/against_reference.hpp"
#include "tests/support/analytic_picture.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::compare;
using namespace eyeray::engine::test;

namespace {

// The cause found at a pixel where `change` is made to everything right of the pixel's centre.
template <typename Change>
Cause cause_of(const Change& change) {
  const Reference reference = [&](int x, int y, const Vec2& shift, rounding::Coincidence) {
    Neighbour neighbour = picture_reference(x, y, shift);
    if (shift.x > 0) change(neighbour);
    return neighbour;
  };
  return Neighbourhood(reference, {48, 30}, 16).cause(Vec3(0.0), {});
}

}  // namespace

TEST_CASE("a cause is the first thing along the ray that changes") {
  const auto surface = [](Neighbour& n) { n.first_surfaces = 7; };
  const auto branch = [](Neighbour& n) { n.samples[0].counts.x = 3; };
  const auto texture = [](Neighbour& n) { n.first_colors = 7; };
  const auto light = [](Neighbour& n) { n.samples[0].color *= 0.5; };
  CHECK(cause_of(surface) == Cause::silhouette);
  CHECK(cause_of(branch) == Cause::refraction_branch);
  CHECK(cause_of(texture) == Cause::texture_edge);
  CHECK(cause_of(light) == Cause::shadow_edge);
  CHECK(cause_of([&](Neighbour& n) { surface(n), branch(n), texture(n); }) == Cause::silhouette);
  CHECK(cause_of([&](Neighbour& n) { branch(n), texture(n); }) == Cause::refraction_branch);
  CHECK(cause_of([](Neighbour& n) { n.direct = false; }) == Cause::refraction_branch);
}

TEST_CASE("changes by float32's rounding of ray origins have that cause and no other") {
  const auto neighbourhood = [](double near, double far) {
    return Neighbourhood(
        [=](int, int, const Vec2&, rounding::Coincidence) {
          Neighbour neighbour;
          neighbour.samples = {{Vec3(near), {}}};
          if (far > 0) neighbour.rounded = {{Vec3(far), {}}};
          return neighbour;
        },
        {0, 0}, 16);
  };
  CHECK_FALSE(neighbourhood(0.2, 0.7).explains(Vec3(0.7), {}));
  CHECK(neighbourhood(0.2, 0.7).explains_as_rounding(Vec3(0.7), {}));
  CHECK(neighbourhood(0.7, 0.2).explains_as_rounding(Vec3(0.4), {}));
  CHECK_FALSE(neighbourhood(0.2, 0.7).explains_as_rounding(Vec3(0.8), {}));
  CHECK_FALSE(neighbourhood(0.2, 0.0).explains_as_rounding(Vec3(0.7), {}));
}

TEST_CASE("either of two surfaces that float32 cannot distinguish may be shown") {
  const Neighbourhood neighbourhood(
      [](int, int, const Vec2&, rounding::Coincidence coincidence) {
        Neighbour neighbour;
        const bool coincident = coincidence == rounding::Coincidence::coincident;
        neighbour.samples[0].color = Vec3(coincident ? 0.7 : 0.2);
        neighbour.first_hit = {.t = 4, .normal = {0, 0, 1}, .primitive = coincident ? 3 : 2, .material = 0};
        return neighbour;
      },
      {0, 0}, 16);
  const auto hit = [](int primitive) {
    return FirstHit{.t = 4, .normal = {0, 0, 1}, .primitive = primitive, .material = 0};
  };
  CHECK(neighbourhood.explains(Vec3(0.7), {}));
  CHECK(neighbourhood.cause(Vec3(0.7), {}) == Cause::undecidable);
  CHECK_FALSE(neighbourhood.explains(Vec3(0.8), {}));
  CHECK(neighbourhood.explains(hit(3), {}));
  CHECK(neighbourhood.cause(hit(3), {}) == Cause::undecidable);
  CHECK_FALSE(neighbourhood.explains(hit(4), {}));
}

TEST_CASE("a first hit differs at a silhouette, a crease, a seam of uv, or a grazing angle") {
  const auto cause = [](const auto& change) {
    const Reference reference = [&](int x, int y, const Vec2& shift, rounding::Coincidence) {
      Neighbour neighbour = picture_reference(x, y, shift);
      neighbour.first_colors = shift.x > 0;
      if (shift.x > 0) change(neighbour.first_hit);
      return neighbour;
    };
    return Neighbourhood(reference, {48, 30}, 16).cause(FirstHit{}, {});
  };
  CHECK(cause([](FirstHit& hit) { hit.primitive = 0; }) == Cause::silhouette);
  CHECK(cause([](FirstHit& hit) { hit.normal = {1, 0, 0}; }) == Cause::crease);
  CHECK(cause([](FirstHit& hit) { hit.uv.x += 1; }) == Cause::texture_edge);
  CHECK(cause([](FirstHit& hit) { hit.t += 1; }) == Cause::grazing);
}

TEST_CASE("the neighbourhood is the pixel and 64 offsets of 0.001 to 0.004 pixels all around") {
  std::vector<Vec2> shifts;
  int coincident = 0;
  const Reference reference = [&](int x, int y, const Vec2& shift, rounding::Coincidence coincidence) {
    CHECK(x == 5);
    CHECK(y == 7);
    if (coincidence == rounding::Coincidence::coincident) {
      ++coincident;
      CHECK(shift == Vec2(0.0));
    } else {
      shifts.push_back(shift);
    }
    return Neighbour{};
  };
  const Neighbourhood neighbourhood(reference, {5, 7}, 16);
  CHECK(coincident == 1);
  REQUIRE(shifts.size() == 65);
  CHECK(shifts[0] == Vec2(0.0));
  int quadrants[4] = {};
  for (size_t i = 1; i < shifts.size(); ++i) {
    CHECK(glm::length(shifts[i]) >= 0.001 - 1e-12);
    CHECK(glm::length(shifts[i]) <= 0.004 + 1e-12);
    ++quadrants[(shifts[i].x > 0 ? 1 : 0) + (shifts[i].y > 0 ? 2 : 0)];
  }
  for (const int count : quadrants) CHECK(count >= 14);
}

TEST_CASE("a jump within a rounding error of the camera ray is undecidable") {
  const auto cause = [](double edge, double rounding) {
    const Reference reference = [=](int, int, const Vec2& shift, rounding::Coincidence) {
      const bool beyond_edge = shift.y > edge;
      Neighbour neighbour;
      neighbour.samples[0].color = Vec3(beyond_edge ? 0.7 : 0.2);
      neighbour.first_hit = {.t = 1, .normal = {0, 0, 1}, .primitive = beyond_edge, .material = 0};
      neighbour.first_surfaces = beyond_edge;
      neighbour.rounding = rounding;
      return neighbour;
    };
    const Neighbourhood neighbourhood(reference, {0, 0}, 16);
    const FirstHit other{.t = 1, .normal = {0, 0, 1}, .primitive = 1, .material = 0};
    CHECK(neighbourhood.explains(Vec3(0.7), {}));
    CHECK(neighbourhood.explains(other, {}));
    CHECK(neighbourhood.cause(other, {}) == neighbourhood.cause(Vec3(0.7), {}));
    return neighbourhood.cause(Vec3(0.7), {});
  };
  CHECK(cause(3e-5, 4e-5) == Cause::undecidable);
  CHECK(cause(3e-5, 2e-5) == Cause::silhouette);
  CHECK(cause(3e-5, 0) == Cause::silhouette);
  // However much is rounded, differences beyond the first ring can be decided.
  CHECK(cause(1.5e-3, 1) == Cause::silhouette);
}

TEST_CASE("a hit that changes when a rounding error turns the ray is undecidable") {
  const auto neighbourhood = [](double rounding) {
    return Neighbourhood(
        [=](int, int, const Vec2& shift, rounding::Coincidence coincidence) {
          CHECK((coincidence != rounding::Coincidence::turned || glm::length(shift) < 1.001 * rounding));
          Neighbour neighbour;
          neighbour.samples[0].color =
              Vec3(coincidence == rounding::Coincidence::turned && shift.x > 0 ? 0.7 : 0.2);
          neighbour.rounding = rounding;
          return neighbour;
        },
        {0, 0}, 16);
  };
  CHECK(neighbourhood(1e-5).explains(Vec3(0.7), {}));
  CHECK(neighbourhood(1e-5).cause(Vec3(0.7), {}) == Cause::undecidable);
  CHECK_FALSE(neighbourhood(1e-5).explains(Vec3(0.8), {}));
  CHECK_FALSE(neighbourhood(0).explains(Vec3(0.7), {}));
}

TEST_CASE("an edge along a row's pixel centres does not count towards the cap on explained pixels") {
  const auto colors = [](double rounding) {
    const Reference picture = [=](int, int y, const Vec2& shift, rounding::Coincidence) {
      Neighbour neighbour;
      neighbour.samples[0].color = Vec3(y + shift.y > 30 + 5e-7 ? 0.7 : 0.2);
      neighbour.rounding = rounding;
      return neighbour;
    };
    const Frame value = picture_frame({0, 1e-6}, picture), reference = picture_frame({0, 0}, picture);
    return compare_with_reference(value, reference, picture).colors;
  };
  const Tally undecidable = colors(1e-5), shadow = colors(1e-7);
  CHECK(undecidable.explained[size_t(Cause::undecidable)] == picture_width);
  CHECK(undecidable.capped_pixels() == 0);
  CHECK(undecidable.passes());
  CHECK(shadow.explained[size_t(Cause::shadow_edge)] == picture_width);
  CHECK(shadow.capped_pixels() == picture_width);
  CHECK_FALSE(shadow.passes());
}

TEST_CASE("the finer neighbourhood finds features narrower than the first one's ring") {
  const Reference reference = [](int, int, const Vec2& shift, rounding::Coincidence) {
    Neighbour neighbour;
    const double r = glm::length(shift);
    neighbour.samples[0].color = Vec3(r > 2e-5 && r < 4e-4 ? 0.7 : 0.2);
    neighbour.rounding = 1e-5;
    return neighbour;
  };
  CHECK_FALSE(Neighbourhood(reference, {0, 0}, 256).explains(Vec3(0.6), {}));
  CHECK(Neighbourhood(reference, {0, 0}, 256, true).explains(Vec3(0.6), {}));
  CHECK_FALSE(Neighbourhood(reference, {0, 0}, 256, true).explains(Vec3(0.8), {}));
}

TEST_CASE("explained values lie between the neighbours, extended by a tolerance at each end") {
  const Reference reference = [](int, int, const Vec2& shift, rounding::Coincidence) {
    Neighbour neighbour;
    neighbour.samples[0].color = Vec3(shift.x > 0.002 ? 0.7 : 0.2, 10, 0);
    neighbour.first_hit = {
        .t = shift.x > 0.002 ? 50.0 : 40.0, .normal = {0, 0, 1}, .primitive = 3, .material = 1};
    return neighbour;
  };
  const Neighbourhood neighbourhood(reference, {0, 0}, 16);
  const Tolerances tolerances;
  CHECK(neighbourhood.explains(Vec3(0.45, 10, 0), tolerances));
  CHECK(neighbourhood.explains(Vec3(0.7 + 0.9e-4, 10 + 0.9e-3, 0.9e-4), tolerances));
  CHECK_FALSE(neighbourhood.explains(Vec3(0.7 + 1.1e-4, 10, 0), tolerances));
  CHECK_FALSE(neighbourhood.explains(Vec3(0.2 - 1.1e-4, 10, 0), tolerances));
  CHECK_FALSE(neighbourhood.explains(Vec3(0.2, 10 + 1.1e-3, 0), tolerances));
  CHECK_FALSE(neighbourhood.explains(Vec3(0.2, std::nan(""), 0), tolerances));

  const FirstHit hit{.t = 45, .normal = {0, 0, 1}, .primitive = 3, .material = 1};
  const auto changed = [&](auto member, auto value) {
    FirstHit other = hit;
    other.*member = value;
    return other;
  };
  CHECK(neighbourhood.explains(hit, tolerances));
  CHECK(neighbourhood.explains(changed(&FirstHit::t, 50 * (1 + 0.9e-5)), tolerances));
  CHECK_FALSE(neighbourhood.explains(changed(&FirstHit::t, 50 * (1 + 1.1e-5)), tolerances));
  CHECK_FALSE(neighbourhood.explains(changed(&FirstHit::t, std::nan("")), tolerances));
  CHECK_FALSE(neighbourhood.explains(changed(&FirstHit::normal, Vec3(0, 1.1e-4, 1)), tolerances));
  CHECK_FALSE(neighbourhood.explains(changed(&FirstHit::primitive, 2), tolerances));
  CHECK_FALSE(neighbourhood.explains(changed(&FirstHit::primitive, -1), tolerances));
  CHECK_FALSE(neighbourhood.explains(changed(&FirstHit::material, 0), tolerances));
}

TEST_CASE("t may be off by the rounding of the coordinates that it comes from, and by no more") {
  const Tolerances tolerances;
  FirstHit reference{.t = 1e-3, .normal = {0, 0, 1}, .primitive = 0, .material = 0};
  FirstHit value = reference;
  CHECK(t_tolerance(reference, tolerances) == doctest::Approx(1e-8));
  value.t = 1e-3 + 3e-7;
  CHECK(hit_excess(value, reference, tolerances) == doctest::Approx(30));

  // Two units in the last place of 2 are 4.8e-7.
  reference.t_scale = 2;
  CHECK(t_tolerance(reference, tolerances) == 0x1p-21);
  CHECK(hit_excess(value, reference, tolerances) < 1);
  value.t = 1e-3 + 5e-7;
  CHECK(hit_excess(value, reference, tolerances) > 1);

  // From afar, the relative tolerance is the wider one.
  reference.t = 100;
  CHECK(t_tolerance(reference, tolerances) == doctest::Approx(1e-3));
}

TEST_CASE("a neighbourhood is as wide as the rounding of its coordinates") {
  const auto explained = [](double t_scale) {
    const Reference reference = [&](int x, int y, const Vec2& shift, rounding::Coincidence) {
      Neighbour neighbour = picture_reference(x, y, shift);
      neighbour.first_hit.t_scale = t_scale;
      return neighbour;
    };
    FirstHit hit = picture_reference(48, 30, {0, 0}).first_hit;
    hit.t *= 1.001;
    return Neighbourhood(reference, {48, 30}, 16).explains(hit, {});
  };
  CHECK(!explained(0));
  CHECK(explained(1e9));
}
