// A corner and the edges from there (emitters/emitter_sample.glsl), at a right angle.
//
// Points that are even by solid angle, row by row: Ureña, Fajardo and King, "An Area-Preserving Parametrization for Spherical Rectangles"
// (EGSR 2013). Here without its angles and arc cosines, of which float32 keeps three digits for a rectangle seen edge-on. In its
// own space, the point in the middle, a strip lies between y0 and y1 and beyond x, on to infinity. Its solid angle T is that of a
// triangle with one corner at the end of the x axis. Solved for x, with γ the angles of y0 and y1 to the y axis and λ = γ0 − γ1:
//   x / z = sin(λ − T) / (2 √(sin(T/2) sin(λ − T/2) sin(γ1 + T/2) sin(γ0 − T/2))).
// Strips beyond both ends are measured, and the lesser one followed: nothing cancels.
#ifndef EMITTER_RECTANGLE_GLSL
#define EMITTER_RECTANGLE_GLSL
#include "emitters/spherical_triangle.glsl"

SHADER_BEGIN

float rectangle_width(Emitter e) { return e.b.w; }  // the lengths of the edges
float rectangle_height(Emitter e) { return e.c.w; }

// Seen under a smaller solid angle, a rectangle is sampled by area, which is then as even: a small one far to one side would lose digits
// to its distance.
#define LEAST_SPHERICAL_RECTANGLE 0.01f

struct SphericalRectangle {
  float x0;  // its sides, where the point is at 0, …
  float x1;
  float y0;
  float y1;
  float z;           // … and how far off its plane is
  float half_angle;  // half its solid angle
};

SphericalRectangle spherical_rectangle(Emitter e, vec3 from) {
  vec3 a = emitter_origin(e) - from;
  vec3 b = emitter_edge_u(e);
  vec3 c = emitter_edge_v(e);
  float volume = abs(dot3(a, cross3(b, c)));
  SphericalRectangle seen;
  seen.x0 = dot3(a, b) / rectangle_width(e);
  seen.y0 = dot3(a, c) / rectangle_height(e);
  seen.x1 = seen.x0 + rectangle_width(e);
  seen.y1 = seen.y0 + rectangle_height(e);
  seen.z = volume / (rectangle_width(e) * rectangle_height(e));
  // Its two triangles have the same volume; by van Oosterom and Strackee each has the half angle of volume / d.
  vec3 ab = a + b;
  vec3 ac = a + c;
  vec3 far = ab + c;
  float la = sqrt(dot3(a, a));
  float lb = sqrt(dot3(ab, ab));
  float lc = sqrt(dot3(ac, ac));
  float lf = sqrt(dot3(far, far));
  float diagonal = la * lf + dot3(a, far);
  float d0 = diagonal * lb + dot3(a, ab) * lf + dot3(ab, far) * la;
  float d1 = diagonal * lc + dot3(a, ac) * lf + dot3(ac, far) * la;
  seen.half_angle = atan_yx(volume, d0) + atan_yx(volume, d1);
  return seen;
}

bool is_by_solid_angle(SphericalRectangle seen) {
  return 2.0f * seen.half_angle >= LEAST_SPHERICAL_RECTANGLE && 2.0f * seen.half_angle <= MOST_SOLID_ANGLE;
}

// Half the solid angle of the strip beyond x.
float half_strip(SphericalRectangle seen, float x) {
  float plain = x * x + seen.z * seen.z;
  float r0 = sqrt(plain + seen.y0 * seen.y0);
  float r1 = sqrt(plain + seen.y1 * seen.y1);
  return atan_yx(seen.z * (seen.y1 - seen.y0), r0 * r1 + x * (r0 + r1) + plain + seen.y0 * seen.y1);
}

float rectangle_x(SphericalRectangle seen, float u) {
  float right = half_strip(seen, seen.x1) + (1.0f - u) * seen.half_angle;
  float left = half_strip(seen, -seen.x0) + u * seen.half_angle;
  vec2 turn = sine_cosine(minimum(right, left));
  // Sines and cosines of γ0, γ1 and λ.
  float to0 = sqrt(seen.y0 * seen.y0 + seen.z * seen.z);
  float to1 = sqrt(seen.y1 * seen.y1 + seen.z * seen.z);
  vec2 gamma0 = vec2(seen.z, seen.y0) / to0;
  vec2 gamma1 = vec2(seen.z, seen.y1) / to1;
  vec2 lambda = vec2(gamma0.x * ((seen.y1 - seen.y0) / to1), gamma0.x * gamma1.x + gamma0.y * gamma1.y);
  float across = lambda.x * (turn.y * turn.y - turn.x * turn.x) - lambda.y * (2.0f * turn.x * turn.y);
  float up = (gamma1.x * turn.y + gamma1.y * turn.x) * (gamma0.x * turn.y - gamma0.y * turn.x);
  float along = turn.x * (lambda.x * turn.y - lambda.y * turn.x);
  float x = seen.z * across / (2.0f * sqrt(maximum(along * up, 1.0e-30f)));
  return minimum(maximum(right < left ? x : -x, seen.x0), seen.x1);
}

// Samples along the plane through x are uniform in the sine of the height. The sine's complements to 1 and to −1 are mixed.
float rectangle_y(SphericalRectangle seen, float x, float u) {
  float plain = x * x + seen.z * seen.z;
  float r0 = sqrt(plain + seen.y0 * seen.y0);
  float r1 = sqrt(plain + seen.y1 * seen.y1);
  float near0 = plain / (r0 * (r0 + abs(seen.y0)));
  float near1 = plain / (r1 * (r1 + abs(seen.y1)));
  bool above0 = seen.y0 > 0.0f;
  bool above1 = seen.y1 > 0.0f;
  float below_top = (1.0f - u) * (above0 ? near0 : 2.0f - near0) + u * (above1 ? near1 : 2.0f - near1);
  float above_bottom = (1.0f - u) * (above0 ? 2.0f - near0 : near0) + u * (above1 ? 2.0f - near1 : near1);
  float y = sqrt(plain) * (above_bottom - below_top) / (2.0f * sqrt(maximum(below_top * above_bottom, 1.0e-30f)));
  return minimum(maximum(y, seen.y0), seen.y1);
}

EmitterSample rectangle_emitter_sample(Emitter e, vec3 from, vec2 u) {
  SphericalRectangle seen = spherical_rectangle(e, from);
  float x = rectangle_x(seen, u.x);
  float y = rectangle_y(seen, x, u.y);
  vec2 at = u;
  if (is_by_solid_angle(seen)) at = vec2((x - seen.x0) / rectangle_width(e), (y - seen.y0) / rectangle_height(e));
  EmitterSample point;
  point.p = emitter_origin(e) + (emitter_edge_u(e) * at.x + emitter_edge_v(e) * at.y);
  point.normal = flat_normal(e);
  point.uv = at;
  return point;
}

float rectangle_emitter_density(Emitter e, vec3 from, EmitterSample point) {
  SphericalRectangle seen = spherical_rectangle(e, from);
  return is_by_solid_angle(seen) ? 1.0f / (2.0f * seen.half_angle) : density_of_area(e.area, from, point);
}

SHADER_END
#endif
