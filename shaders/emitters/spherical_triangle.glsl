// Triangles as a point sees them, on the sphere of directions around it, and points on them that are even by solid angle: Arvo,
// "Stratified Sampling of Spherical Triangles" (SIGGRAPH 1995). Here without its angles, whose sum less π has no digits left of a small
// triangle. The half angle's tangent is rational in measures of the corners: van Oosterom and Strackee, "The Solid Angle of a Plane
// Triangle" (IEEE Trans. Biomedical Engineering, 1983). It is solved for the point.
#ifndef SPHERICAL_TRIANGLE_GLSL
#define SPHERICAL_TRIANGLE_GLSL
#include "emitters/emitter_sample.glsl"

SHADER_BEGIN

// Emitters seen under a smaller or larger solid angle are sampled by area instead, as in pbrt-v4. For a small one both ways are alike.
// For one next to the point, nearly half of all directions, too few digits are left of the angle's complement.
#define LEAST_SPHERICAL_TRIANGLE 3.0e-4f
#define MOST_SOLID_ANGLE 6.22f

struct SphericalTriangle {
  float apex;  // distance of its corners
  float first;
  float second;
  float to_first;  // the cosines of its edges
  float to_second;
  float across;      // from the first to the second
  float volume;      // volume of the parallelepiped of the three directions
  float half_angle;  // half its solid angle
};

// a: one corner from where the point is, which is the apex; b, c: the edges from there to the first and the second.
SphericalTriangle spherical_triangle(vec3 a, vec3 b, vec3 c) {
  vec3 first = a + b;
  vec3 second = a + c;
  SphericalTriangle seen;
  seen.apex = sqrt(dot3(a, a));
  seen.first = sqrt(dot3(first, first));
  seen.second = sqrt(dot3(second, second));
  seen.to_first = dot3(a, first) / (seen.apex * seen.first);
  seen.to_second = dot3(a, second) / (seen.apex * seen.second);
  seen.across = dot3(first, second) / (seen.first * seen.second);
  // By its edges: as the product of three corners a small one would cancel.
  seen.volume = abs(dot3(a, cross3(b, c))) / (seen.apex * seen.first * seen.second);
  seen.half_angle = atan_yx(seen.volume, 1.0f + seen.to_first + seen.to_second + seen.across);
  return seen;
}

bool is_by_solid_angle(SphericalTriangle seen) {
  return 2.0f * seen.half_angle >= LEAST_SPHERICAL_TRIANGLE && 2.0f * seen.half_angle <= MOST_SOLID_ANGLE;
}

// The point's weights of the first and the second corner, none of which is negative.
vec2 spherical_triangle_weights(SphericalTriangle seen, vec2 u) {
  // Along the edge opposite the apex, to where the triangle that is left has its share of the angle: the edge's half angle there has the
  // tangent y / x · its sine.
  vec2 turn = sine_cosine(u.y * seen.half_angle);
  float sine_squared = maximum(1.0f - seen.across * seen.across, 0.0f);
  float x = seen.volume * turn.y - (seen.to_second - seen.to_first * seen.across) * turn.x;
  float y = (1.0f + seen.to_first) * turn.x;
  float both = maximum(x * x + y * y * sine_squared, 1.0e-30f);
  float second = 2.0f * x * y / both;
  float first = maximum((x * x - y * y * sine_squared) / both - second * seen.across, 0.0f);
  second = maximum(second, 0.0f);
  // From the apex to there, even in the cosine: by its complement, which is as far as `versine` there.
  float versine = maximum(1.0f - (first * seen.to_first + second * seen.to_second), 0.0f);
  float reach = sqrt(maximum(u.x * (2.0f - u.x * versine) / maximum(2.0f - versine, 1.0e-30f), 1.0e-20f));
  float apex = maximum(1.0f - u.x * versine - reach * (1.0f - versine), 0.0f);
  // The weights are those of unit directions. Division by the corners' distances makes them weights of the corners.
  vec3 weight = vec3(apex / seen.apex, reach * first / seen.first, reach * second / seen.second);
  float sum = weight.x + weight.y + weight.z;
  return vec2(weight.y / sum, weight.z / sum);
}

SHADER_END
#endif
