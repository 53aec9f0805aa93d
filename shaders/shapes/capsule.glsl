// Within 1 of the y axis between −half and half, in object space (geometry/object_space.glsl).   parameters: half.
// A round cone is two balls around these ends, and the cone that touches both. The larger ball has the radius 1. Its first
// vertex of parameters has half, the cosine and the slope of the side, and the radius in the middle. The second one has both radii, and the
// growth of v by the angle on either ball. The third one has the growth of v by the height on the side, its constant on the upper ball,
// and its gradient.
#ifndef CAPSULE_GLSL
#define CAPSULE_GLSL
#include "geometry/object_space.glsl"

SHADER_BEGIN

#if HAS_ROUND_CONES
#define ROUND_PARAMETERS(s, index) bits_to_floats(load_vertex(s.extra + OBJECT_PARAMETERS + index))
bool capsule_is_round(vec4 parameters) { return parameters.y > 0.0f; }

// The height of the centre of the ball that touches the side nearest to a point at the height y, `outward` from the axis.
float round_cone_center(vec4 parameters, float outward, float y) { return y - outward * (parameters.z / parameters.y); }

// A passage through the endless cone: t where the ray enters and leaves, and the heights of the centres there.
struct ConePassage {
  bool meets;
  float enter;
  float leave;
  float enter_y;
  float leave_y;
};

// The ray is nearest to the axis at t = middle, `squared` the square of its distance there; `across`: the square of its speed off the axis.
// On its way a point of the axis' height has the radius g − w·(t − middle), measured across the side.
ConePassage round_cone_passage(vec4 parameters, ObjectRay r, float middle, float squared, float across) {
  float cosine = parameters.y;
  float slope = parameters.z;
  float y = r.o.y + r.d.y * middle;
  float g = parameters.w - slope * y;
  float w = slope * r.d.y;
  float speed = cosine * sqrt(across);
  float a = (speed - abs(w)) * (speed + abs(w));
  float discriminant = across * g * g - a * squared;
  float both = abs(g * w) + cosine * sqrt(maximum(discriminant, 0.0f));
  float side = w < 0.0f ? -1.0f : 1.0f;
  float distance = cosine * sqrt(squared);

  // Steeper than the side the ray stays in the cone on the way to its wide end. It has one root there, and the other on the cone's other half.
  bool stays = !(a > 0.0f);
  float near = g > 0.0f ? side * ((g - distance) * (g + distance) / both) : side * (both / a);
  float far = -side * (both / a);
  float near_y = round_cone_center(parameters, sqrt(squared + across * near * near), y + r.d.y * near);
  float far_y = round_cone_center(parameters, sqrt(squared + across * far * far), y + r.d.y * far);
  far_y = stays ? (slope > 0.0f ? -2.0f : 2.0f) * (1.0f + parameters.x) : far_y;

  ConePassage passage;
  passage.meets = discriminant >= 0.0f && (g > 0.0f || stays);
  bool narrows = w >= 0.0f;
  passage.enter = middle + (narrows ? far : near);
  passage.leave = middle + (narrows ? near : far);
  passage.enter_y = narrows ? far_y : near_y;
  passage.leave_y = narrows ? near_y : far_y;
  return passage;
}
#endif

// The t at which the ray enters (side = −1) or leaves (1) the ball around the end on the side of y. T_MISS if it does not.
float capsule_end(ObjectRay r, float end, float radius, float side) {
  vec3 o = vec3(r.o.x, r.o.y - end, r.o.z);
  float squared = dot3(r.d, r.d);
  float middle = -dot3(o, r.d) / squared;
  vec3 nearest = o + r.d * middle;
  float discriminant = radius * radius - dot3(nearest, nearest);
  return discriminant >= 0.0f ? middle + side * sqrt(discriminant / squared) : T_MISS;
}

// A ray enters and leaves once. Where it passes the endless cylinder beyond an end, it is the ball around that end that counts.
float capsule_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  uv = vec2(0.0f, 0.0f);
  vec4 parameters = object_parameters(s);
  float half_length = parameters.x;
  ObjectRay r = object_ray(s, ray, half_length + 1.0f);
  float across = maximum(r.d.x * r.d.x + r.d.z * r.d.z, 1.0e-16f * dot3(r.d, r.d));
  float middle = -(r.o.x * r.d.x + r.o.z * r.d.z) / across;
  float x = r.o.x + r.d.x * middle;
  float z = r.o.z + r.d.z * middle;
  float discriminant = 1.0f - (x * x + z * z);
  float root = sqrt(maximum(discriminant, 0.0f) / across);
  float enter = middle - root;
  float leave = middle + root;
  float enter_y = r.o.y + r.d.y * enter;
  float leave_y = r.o.y + r.d.y * leave;
  bool meets = discriminant >= 0.0f;
  vec2 balls = vec2(1.0f, 1.0f);
#if HAS_ROUND_CONES
  if (capsule_is_round(parameters)) {
    ConePassage passage = round_cone_passage(parameters, r, middle, x * x + z * z, across);
    meets = passage.meets;
    enter = passage.enter;
    leave = passage.leave;
    enter_y = passage.enter_y;
    leave_y = passage.leave_y;
    vec4 radii = ROUND_PARAMETERS(s, 1u);
    balls = vec2(radii.x, radii.y);
  }
#endif
  float first = capsule_end(r, enter_y < 0.0f ? -half_length : half_length, enter_y < 0.0f ? balls.x : balls.y, -1.0f);
  float second = capsule_end(r, leave_y < 0.0f ? -half_length : half_length, leave_y < 0.0f ? balls.x : balls.y, 1.0f);
  enter = abs(enter_y) > half_length ? first : enter;
  leave = abs(leave_y) > half_length ? second : leave;
  float t = ENTERS(ray, r.t + enter) ? enter : leave;
  return meets && t < T_MISS ? r.t + t : T_NONE;
}

bool capsule_reject(Primitive s, Ray ray) { return false; }

void capsule_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { object_box(s, vec3(1.0f, object_parameters(s).x + 1.0f, 1.0f), lower, upper); }

vec4 capsule_level(Primitive s, vec3 p) {
  vec4 parameters = object_parameters(s);
  float half_length = parameters.x;
  vec3 q = point_into_object(s, p);
#if HAS_ROUND_CONES
  if (capsule_is_round(parameters)) {
    float center = round_cone_center(parameters, sqrt(q.x * q.x + q.z * q.z), q.y);
    center = minimum(maximum(center, -half_length), half_length);
    q.y = q.y - center;
    float distance = maximum(sqrt(dot3(q, q)), 1.0e-20f);
    return level_out_of_object(s, q / distance, distance - (parameters.w - parameters.z * center));
  }
#endif
  q.y = q.y - minimum(maximum(q.y, -half_length), half_length);
  return level_out_of_object(s, q, 0.5f * (dot3(q, q) - 1.0f));
}

#if HAS_ROUND_CONES
Surface round_cone_surface(Primitive s, vec4 parameters, vec3 p) {
  vec4 balls = ROUND_PARAMETERS(s, 1u);
  vec4 side = ROUND_PARAMETERS(s, 2u);
  float half_length = parameters.x;
  float y = round_cone_center(parameters, sqrt(p.x * p.x + p.z * p.z), p.y);
  y = minimum(maximum(y, -half_length), half_length);
  vec3 n = vec3(p.x, p.y - y, p.z);
  n = dot3(n, n) > 0.0f ? normalize3(n) : vec3(1.0f, 0.0f, 0.0f);
  vec3 from_center = n * (parameters.w - parameters.z * y);

  float u = 0.5f + atan_yx(-n.z, n.x) / (2.0f * PI);
  float angle = atan_yx(sqrt(n.x * n.x + n.z * n.z), -n.y);
  float v = side.x * (y + half_length) + (n.y < parameters.z ? angle * balls.z : angle * balls.w + side.y);
  return object_surface(s, from_center + vec3(0.0f, y, 0.0f), n,
                        uv_field(vec2(u < 1.0f ? u : 0.0f, v), turn_gradient(from_center), pole_gradient(n) * side.z));
}
#endif

Surface capsule_surface(Primitive s, Ray ray, Hit hit) {
  vec4 parameters = object_parameters(s);
  float half_length = parameters.x;
  vec3 p = at_hit(object_ray(s, ray, half_length + 1.0f), hit);
#if HAS_ROUND_CONES
  if (capsule_is_round(parameters)) return round_cone_surface(s, parameters, p);
#endif
  float y = minimum(maximum(p.y, -half_length), half_length);
  vec3 n = vec3(p.x, p.y - y, p.z);
  n = dot3(n, n) > 0.0f ? normalize3(n) : vec3(1.0f, 0.0f, 0.0f);

  // v is the length of the way from the lower pole.
  float u = 0.5f + atan_yx(-n.z, n.x) / (2.0f * PI);
  float way = atan_yx(sqrt(n.x * n.x + n.z * n.z), -n.y) + (y + half_length);
  float whole = PI + 2.0f * half_length;
  return object_surface(s, n + vec3(0.0f, y, 0.0f), n,
                        uv_field(vec2(u < 1.0f ? u : 0.0f, way / whole), turn_gradient(n), pole_gradient(n) / whole));
}

SHADER_END
#endif
