// GLSL functions that a user's shader may call and eyeray's own shaders avoid (shaders/math/math.glsl gives
// the reason). Their bits are not those of any device. Also printf. abs, floor and sqrt of vectors are GLM's
// anyway.
#pragma once

#include <cstdio>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>

#include "shaders/language.h"

namespace eyeray::engine::shader {

using std::printf;

using glm::any, glm::all;
using glm::faceforward, glm::reflect, glm::refract;
using glm::isnan, glm::isinf;
using glm::length, glm::distance, glm::dot, glm::cross, glm::normalize;
using glm::lessThan, glm::lessThanEqual, glm::greaterThan, glm::greaterThanEqual, glm::equal, glm::notEqual;
using glm::mod, glm::min, glm::max, glm::clamp, glm::mix, glm::step, glm::smoothstep, glm::fma;
using glm::pow, glm::exp, glm::log, glm::exp2, glm::log2, glm::inversesqrt;
using glm::radians, glm::degrees, glm::sin, glm::cos, glm::tan, glm::asin, glm::acos, glm::atan;
using glm::sign, glm::trunc, glm::round, glm::roundEven, glm::ceil, glm::fract;
using glm::sinh, glm::cosh, glm::tanh, glm::asinh, glm::acosh, glm::atanh;

}  // namespace eyeray::engine::shader
