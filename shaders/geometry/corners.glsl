// The values of triangles and parallelograms: their first three corners, and the normal.
#ifndef CORNERS_GLSL
#define CORNERS_GLSL
#include "records.h"

SHADER_BEGIN

vec3 corner_a(Primitive s) { return vec3(s.a); }
vec3 corner_b(Primitive s) { return vec3(s.b); }
vec3 corner_c(Primitive s) { return vec3(s.c); }
vec3 corner_normal(Primitive s) { return vec3(s.a.w, s.b.w, s.c.w); }  // the unit geometric one, from float64

SHADER_END
#endif
