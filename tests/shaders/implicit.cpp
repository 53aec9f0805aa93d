// What the march along a formula tells whoever counts crossings.
#include "host/twin/shader_functions.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray;

TEST_CASE("a crossing is a later one than the one before, whatever rounding makes of it") {
  const shader::ObjectRay ray{{}, {0, 0, 1}, 0};
  for (const float before : {0.0f, 1e-30f, -1e-30f, 1e-3f, -1e-3f, 1.0f, -1.0f, 3e6f, -3e6f}) {
    CAPTURE(before);
    for (const float s : {before, before - 1e-7f, -1e7f}) CHECK(shader::crossing_t(ray, s, before) > before);
    CHECK(shader::crossing_t(ray, before + 1e3f, before) == before + 1e3f);
  }
}

TEST_CASE("of the first piece no coarser one says that its bound may be rounding") {
  shader::March march = shader::march_begin(0, 1, 1, 1e-6f);
  march = shader::march_on(march, {0.1f, 0, 1});
  CHECK(march.waiting == 0);
  // Half as long, and no sharper: a point is asked.
  march = shader::march_on(march, {0.1f, 0, 1});
  CHECK(march.waiting > 0);
}
