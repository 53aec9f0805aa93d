// Random points and directions, from two numbers in [0, 1).
#ifndef SAMPLING_GLSL
#define SAMPLING_GLSL
#include "math/trigonometry.glsl"

SHADER_BEGIN

// Evenly on the disk of radius 1, by squares within squares: Shirley and Chiu, "A Low Distortion Map Between Disk and Square" (1997).
vec2 on_disk(vec2 u) {
  float x = 2.0f * u.x - 1.0f;
  float y = 2.0f * u.y - 1.0f;
  bool wide = abs(x) > abs(y);
  float radius = wide ? x : y;
  float angle = radius == 0.0f ? 0.0f : wide ? 0.25f * PI * (y / x) : 0.5f * PI - 0.25f * PI * (x / y);
  vec2 at = sine_cosine(angle);
  return vec2(radius * at.y, radius * at.x);
}

// By cosine about z: Malley's, up from the disk. Its radius is known without rounding; 1 − x² − y² at the rim is not.
vec3 cosine_direction(vec2 u) {
  vec2 at = on_disk(u);
  float radius = maximum(abs(2.0f * u.x - 1.0f), abs(2.0f * u.y - 1.0f));
  return vec3(at.x, at.y, sqrt((1.0f - radius) * (1.0f + radius)));
}

// Uniform on the half sphere about z: at x on the disk, z is 1 − x², so the length across is |x| √(2 − x²).
vec3 half_sphere_direction(vec2 u) {
  vec2 at = on_disk(u);
  float radius = maximum(abs(2.0f * u.x - 1.0f), abs(2.0f * u.y - 1.0f));
  float across = sqrt(2.0f - radius * radius);
  return vec3(at.x * across, at.y * across, (1.0f - radius) * (1.0f + radius));
}

// Two directions that are perpendicular to the unit vector n and to each other. The first turns about an axis that no wall stands
// along.
void tangents(vec3 n, OUT(vec3) s, OUT(vec3) t) {
  s = normalize3(cross3(vec3(0.31753204f, 0.90757246f, 0.27474649f), n));
  t = cross3(n, s);
}

// A frame around the unit vector n, which is its z.
struct LocalFrame {
  vec3 s;
  vec3 t;
  vec3 n;
};

LocalFrame frame_around(vec3 n) {
  LocalFrame local;
  local.n = n;
  tangents(n, local.s, local.t);
  return local;
}

// The frame that is turned the shortest way until its z is the unit vector n, which does not point far down.
LocalFrame frame_turned_to(vec3 n) {
  float scale = 1.0f / maximum(1.0f + n.z, 1.0e-6f);
  LocalFrame local;
  local.n = n;
  local.s = vec3(1.0f - n.x * n.x * scale, -n.x * n.y * scale, -n.x);
  local.t = vec3(-n.x * n.y * scale, 1.0f - n.y * n.y * scale, -n.y);
  return local;
}

#define LEAST_COSINE 1.0e-4f  // towards the viewer: surfaces that bent normals turn away are seen edge-on

// A direction towards the viewer, that cosine above its frame's horizon at least.
vec3 seen_from(vec3 o) {
  float across = sqrt(o.x * o.x + o.y * o.y);
  bool straight = across < 1.0e-6f;
  vec3 edge_on = vec3(straight ? 1.0f : o.x / across, straight ? 0.0f : o.y / across, LEAST_COSINE);
  return o.z < LEAST_COSINE ? edge_on : normalize3(o);
}

vec3 into_frame(LocalFrame local, vec3 v) { return vec3(dot3(v, local.s), dot3(v, local.t), dot3(v, local.n)); }
vec3 out_of_frame(LocalFrame local, vec3 v) { return local.s * v.x + local.t * v.y + local.n * v.z; }

SHADER_END
#endif
