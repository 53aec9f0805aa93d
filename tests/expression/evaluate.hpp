// Runs straight-line code.
#pragma once

#include "host/core/vec.hpp"
#include "host/expression/expression.hpp"
#include "shaders/language.h"

namespace eyeray::engine::test {

// A formula's text as straight-line code. The text's first line counts as f.glsl:10.
expression::StraightLine straight_line(const std::string& glsl);
// The function's value at p, in float64.
double evaluate(const expression::StraightLine& line, const Vec3& p);
// The function's bounds on the piece o + (m + h·s)·d of a ray.
shader::vec3 bound_piece(const expression::StraightLine& line, const shader::vec3& o, const shader::vec3& d,
                         float m, float h);

struct FirstRoot {
  float t;    // -1 where there is none
  int steps;  // pieces examined
  bool over;  // whether that is certain
};
// The search of shaders/shapes/implicit/bound_march.glsl, with `most` pieces at most.
FirstRoot march(const expression::StraightLine& line, const shader::vec3& o, const shader::vec3& d, float end,
                float finest, int most);

}  // namespace eyeray::engine::test
