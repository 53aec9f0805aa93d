// Colours of light by its temperature.
#pragma once

#include "host/core/vec.hpp"

namespace eyeray::engine::optics {

// The temperatures in kelvin for which the approximation below holds.
inline constexpr double coldest = 1667, hottest = 25000;

// XYZ of a black body of that temperature, with Y = 1. The error of x and y is below 0.001. Kang et al.:
// Design of Advanced Color Temperature Control System for HDTV Applications, J. Korean Phys. Soc. 41 (2002).
Vec3 black_body_xyz(double kelvin);

// The linear Rec. 709 colour of a black body, of luminance 1. Below 1900 K, where a screen has no such
// colour, blue is 0.
Vec3 shown_black_body(double kelvin);

// The linear Rec. 709 colour that an eye sees which takes a black body of `kelvin` for white: that white
// becomes (1, 1, 1). Columns of a matrix. By Bradford's cone responses (Lam 1985; Lindbloom, "Chromatic
// Adaptation").
glm::dmat3 adaptation_to(double kelvin);

}  // namespace eyeray::engine::optics
