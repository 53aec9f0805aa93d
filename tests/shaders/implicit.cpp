// Tests the march along a formula, as callers that count crossings use it.
#include "host/twin/shader_functions.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

TEST_CASE("each crossing is later than the one before, however rounding moves it") {
  const shader::ObjectRay ray{{}, {0, 0, 1}, 0};
  for (const float before : {0.0f, 1e-30f, -1e-30f, 1e-3f, -1e-3f, 1.0f, -1.0f, 3e6f, -3e6f}) {
    CAPTURE(before);
    for (const float s : {before, before - 1e-7f, -1e7f}) CHECK(shader::crossing_t(ray, s, before) > before);
    CHECK(shader::crossing_t(ray, before + 1e3f, before) == before + 1e3f);
  }
}
