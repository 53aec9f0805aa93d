// A tape's steps, computed one after the other: what the text made of it computes.
#pragma once

#include "core/vec.hpp"
#include "derive/tape.hpp"
#include "language.h"

namespace eyeray::test {

// In float64.
double evaluate(const derive::Tape& tape, derive::Term result, const Vec3& p);
// By shaders/enclosure.glsl, on the piece o + (m + h·s)·d of a ray.
shader::vec3 enclose(const derive::Tape& tape, derive::Term result, const shader::vec3& o,
                     const shader::vec3& d, float m, float h);
// By shaders/dual.glsl: gradient and value.
shader::vec4 differentiate(const derive::Tape& tape, derive::Term result, const shader::vec3& p);

struct FirstRoot {
  float t;    // -1 where there is none
  int steps;  // pieces looked at
  bool over;  // whether that is certain
};
// By shaders/enclosure_march.glsl, with `most` pieces at most.
FirstRoot march(const derive::Tape& tape, derive::Term result, const shader::vec3& o, const shader::vec3& d,
                float start, float end, float finest, int most);

}  // namespace eyeray::test
