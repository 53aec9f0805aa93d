// Arcs of a Bézier patch's section: Newton's method finds the roots that they guess, but takes the longer,
// the worse the guess is.
#include "host/twin/shader_functions.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

namespace {

// A section at w with this z and slope, and with the uv that a cubic has there.
shader::BezierSection section(float w, float z, float slope) {
  shader::BezierSection at{};
  at.w = w;
  at.z = z;
  at.slope = slope;
  at.uv = shader::vec2(w * w * w - w, 0.5f * w * w);
  at.uv_slope = shader::vec2(3 * w * w - 1, w);
  return at;
}

// z = depth + 1.8·s·(s − 1) + more·(s − ½)·s²·(1 − s)². Only the slope of z half-way shows the last term.
bool doubted(float depth, float more) {
  shader::BezierSection half_way = section(0.5f, depth - 0.45f, more / 16);
  return shader::bezier_arc(section(0, depth, -1.8f), section(1, depth, 1.8f), half_way, 1e-6f).doubted;
}

}  // namespace

TEST_CASE("between two sections, (u, v) is the cubic with their values and slopes") {
  const shader::BezierSection a = section(-0.5f, 0, 0), b = section(1.5f, 0, 0);
  for (const float s : {0.0f, 0.125f, 0.25f, 0.5f, 0.75f, 1.0f}) {
    CAPTURE(s);
    const shader::BezierSection there = section(-0.5f + 2 * s, 0, 0);
    const shader::vec2 uv = shader::bezier_between(a, b, s);
    CHECK(uv.x == doctest::Approx(double(there.uv.x)));
    CHECK(uv.y == doctest::Approx(double(there.uv.y)));
  }
}

TEST_CASE("an arc is doubtful only if it turns nearer to zero than z's error") {
  // z is lowest half-way, at depth − 0.45, with an error of a sixteenth of `more`.
  CHECK_FALSE(doubted(0.45f + 1.1f / 16, 1));
  CHECK(doubted(0.45f + 0.9f / 16, 1));
  CHECK(doubted(0.45f - 0.9f / 16, 1));
  CHECK_FALSE(doubted(0.45f - 1.1f / 16, 1));
  CHECK_FALSE(doubted(0.45f, 0));
}
