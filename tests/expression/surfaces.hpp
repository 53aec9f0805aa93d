// Functions of p in GLSL, and by hand in float64: classics of algebraic geometry, and the building blocks of
// procedural modelling.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/core/vec.hpp"

namespace eyeray::engine::test {

struct TestSurface {
  std::string_view name;
  std::string glsl;
  double (*f)(const Vec3& p);
  double reach;        // reach of the cube around 0 within which it is examined
  bool jumps = false;  // not continuous, or made of functions that are not
};

const std::vector<TestSurface>& test_surfaces();

}  // namespace eyeray::engine::test
