// Elementary functions by sums, products and quotients alone: the last bits of a libm's own vary from machine
// to machine, those of these do not. Errors are below 3e-16 of the result's size.
#pragma once

#include "host/core/vec.hpp"

namespace eyeray::generate {

// (cos, sin) of an angle of at most some turns. Multiples of 90° are exact.
Vec2 unit_circle(double degrees);

// ln x, for a normal x > 0.
double natural_log(double x);

}  // namespace eyeray::generate
