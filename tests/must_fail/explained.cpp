// Tests of the limits of explanations: each gets a frame with a fault near an edge, or with too many.
#include <cmath>

#include "honest_frame.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::compare;
using namespace eyeray::engine::test;

TEST_CASE("an edge does not excuse a value that is on neither side of it") {
  // One pixel at each edge: the opening's, the shadow's, the checker's and the mirror's.
  for (const Pixel p : {Pixel{88, 6}, {6, 60}, {20, 63}, {6, 10}}) {
    Frame gpu = honest_frame();
    gpu.color.pixel(p.x, p.y)[1] = 0.97f;
    const ReferenceComparison comparison = compared(gpu);
    CHECK(comparison.colors.unexplained == 1);
    CHECK(comparison.colors.worst.pixel == p);
  }
  // A hit of the right primitive with the t of another one.
  Frame gpu = honest_frame();
  hit_at(gpu, {88, 6}) = hit_of(900, {}, {0, 0, 1}, {}, 0);
  CHECK(compared(gpu).first_hits.unexplained == 1);
}

TEST_CASE("too many explained pixels fail, even if none is unexplained") {
  // The picture with an edge along a whole column.
  const Reference split = [](int x, int y, const Vec2& shift, rounding::Coincidence) {
    Neighbour neighbour = picture_reference(x, y, shift);
    if (x + 0.5 + shift.x >= 40.5 + beyond) neighbour.samples[0].color *= 0.5;
    return neighbour;
  };
  const Frame value = picture_frame(honest_shift, split), reference = picture_frame(Vec2(0.0), split);
  const ReferenceComparison comparison = compare_with_reference(value, reference, split);
  CHECK(comparison.colors.unexplained == 0);
  CHECK(comparison.colors.unexamined == 0);
  CHECK(comparison.colors.explained_pixels() > comparison.colors.may_be_explained);
  CHECK_FALSE(comparison.colors.passes());
  // With a cap that allows them, they pass.
  CHECK(compare_with_reference(value, reference, split, {.max_explained = 0.05}).colors.passes());
}

TEST_CASE("a search finds an extreme between the usual directions, if few pixels need it") {
  // In the first `columns` pixels of row 0, the picture is twice as bright if moved in a direction between
  // two of the 64 that are tried.
  const auto unexplained = [](int columns) {
    const Reference wedge = [columns](int x, int y, const Vec2& shift, rounding::Coincidence) {
      Neighbour neighbour = picture_reference(x, y, shift);
      const bool meets = std::fabs(std::atan2(shift.y, shift.x) - M_PI / 64) < M_PI / 200;
      if (x < columns && y == 0 && meets) neighbour.samples[0].color *= 2.0;
      return neighbour;
    };
    Frame gpu = picture_frame();
    for_each_pixel(gpu, [&, i = 0](float* color, FirstHit&) mutable {
      if (i++ < columns) color[0] *= 1.9f;
    });
    return compare_with_reference(gpu, picture_frame(), wedge).colors.unexplained;
  };
  CHECK(unexplained(3) == 0);
  CHECK(unexplained(40) == 40);
}

TEST_CASE("unexamined pixels fail, even if all examined ones are explained") {
  // Seventy columns with an edge each: more pixels than are examined.
  const Reference stripes = [](int x, int y, const Vec2& shift, rounding::Coincidence) {
    Neighbour neighbour;
    const double position = x + 0.5 + shift.x;
    neighbour.samples[0].color =
        Vec3(position < 70 && std::fmod(position - beyond, 1) >= 0.5 ? 0.5 : 0.2, y / 100.0, 0);
    return neighbour;
  };
  const Frame value = picture_frame(honest_shift, stripes), reference = picture_frame(Vec2(0.0), stripes);
  const Tally tally = compare_with_reference(value, reference, stripes, {.max_explained = 0.05}).colors;
  CHECK(tally.unexplained == 0);
  CHECK(tally.unexamined > 0);
  CHECK_FALSE(tally.passes());
}

TEST_CASE("a gate's failure does not keep other gates from being examined") {
  // Colours are wrong everywhere; first hits differ at honest edges alone.
  Frame gpu = honest_frame();
  for_each_pixel(gpu, [](float* color, FirstHit&) { color[0] += 0.3f; });
  gpu.color.pixel(0, 0)[0] -= 0.3f;  // so that the first thousands leave out the edges' columns
  const ReferenceComparison comparison = compared(gpu);
  CHECK_FALSE(comparison.colors.passes());
  CHECK(comparison.first_hits.passes());
  CHECK(comparison.counts.passes());
  CHECK(comparison.first_hits.explained[size_t(Cause::silhouette)] == edge_pixels);
}

TEST_CASE("noise cannot hide a fault: pixels beyond the cap stay unexamined, and fail") {
  Frame gpu = honest_frame();
  for_each_pixel(gpu, [](float* color, FirstHit& hit) { color[0] += hit.primitive == 0 ? 1e-3f : 0.0f; });
  const Tally tally = compared(gpu).colors;
  CHECK(tally.unexamined > 0);
  CHECK(tally.unexplained > 0);
  CHECK_FALSE(tally.passes());
}
