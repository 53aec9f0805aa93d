// f ≤ 0 within the cube from −1 to 1 of object space (geometry/object_space.glsl), where f is a formula of the scene.
//   Parameters: centre of the box, number of the formula; half its sides, Lipschitz constant; 1 where the cube is no cap
#ifndef SHAPES_IMPLICIT_GLSL
#define SHAPES_IMPLICIT_GLSL
#include "shapes/implicit/search.glsl"

SHADER_BEGIN

#define IMPLICIT_REACH 1.7320508f

Implicit load_implicit(Primitive s) {
  vec4 center = object_parameters(s);
  vec4 extent = bits_to_floats(load_vertex(s.extra + OBJECT_PARAMETERS + 1u));
  Implicit it;
  it.center = vec3(center);
  it.extent = vec3(extent);
  it.lipschitz = extent.w;
  it.formula = uint(center.w);
  it.open = bits_to_floats(load_vertex(s.extra + OBJECT_PARAMETERS + 2u)).x != 0.0f;
  return it;
}

// uv: the axis and the side of the cube's face, or IMPLICIT_ITSELF.
float implicit_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  Implicit it = load_implicit(s);
  ObjectRay r = object_ray(s, ray, IMPLICIT_REACH);
  CubeSpan span = cube_span(r);
  bool at_entry = COUNTS(ray) || span.enter > -r.t;
  float start = at_entry ? span.enter : -r.t;
  bool going = start < span.leave;

  // Each formula has its own march: those that are not meant end at once.
  float from = start;
  float side = 0.0f;
  vec4 found = vec4(start, IMPLICIT_NOTHING, start, 0.0f);
#define MARCH_ALONG(number, name)                                                                                        \
  {                                                                                                                      \
    bool wanted = going && it.formula == number;                                                                         \
    vec4 end = name##_march(it, r, from, span.leave, at_entry && !it.open, side, wanted);                                \
    found = wanted ? end : found;                                                                                        \
  }
  float t = T_NONE;
#if HAS_CSG
  for (uint crossings = 0u; going; crossings++) {
    FORMULAS(MARCH_ALONG)

    // If the sides before and beyond are equal, another crossing was lost beside this one, and neither counts. If the side before is unknown and
    // beyond is outside, the ray came in through a cap.
    bool itself = found.y == IMPLICIT_ITSELF;
    bool lost = COUNTS(ray) && itself && found.w == side;
    if (COUNTS(ray) && itself && side == 0.0f && found.w > 0.0f) found = vec4(start, IMPLICIT_ENTRY, start, -1.0f);
    t = lost ? t : crossing_t(r, found.x, t);
    from = found.z;
    side = found.w;
    at_entry = false;
    going = (found.y == IMPLICIT_ITSELF || found.y == IMPLICIT_ENTRY) && (lost || PASSED(ray, t));
    found.y = going && crossings == IMPLICIT_CROSSINGS ? IMPLICIT_ITERATION_LIMIT : found.y;
    going = going && crossings < IMPLICIT_CROSSINGS;
  }
#else
  FORMULAS(MARCH_ALONG)
  t = r.t + found.x;
#endif

  // At the iteration limit there is nothing up to there.
  bool iteration_limit = found.y == IMPLICIT_ITERATION_LIMIT;
  uv = iteration_limit ? vec2(t, 0.0f) : found.y == IMPLICIT_ITSELF ? vec2(IMPLICIT_ITSELF, 0.0f) : cube_face(span, r, found.y == IMPLICIT_ENTRY);
  return iteration_limit ? T_ITERATION_LIMIT : found.y == IMPLICIT_NOTHING ? T_NONE : t;
}

bool implicit_reject(Primitive s, Ray ray) { return false; }

void implicit_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { object_box(s, vec3(1.0f, 1.0f, 1.0f), lower, upper); }

// The formula's gradient and value at a point of the cube.
vec4 formula_slope(Implicit it, vec3 p) {
  vec4 slope = vec4(0.0f, 0.0f, 0.0f, 0.0f);
#define SLOPE_OF(number, name)                              \
  {                                                         \
    bool wanted = it.formula == number;                     \
    vec4 found = name##_slope(it, p, wanted);               \
    slope = wanted ? found : slope;                         \
  }
  FORMULAS(SLOPE_OF)
  return slope;
}

vec4 implicit_level(Primitive s, vec3 p) {
  Implicit it = load_implicit(s);
  vec3 q = point_into_object(s, p);
  vec4 slope = formula_slope(it, q);
  return outer_level(level_out_of_object(s, vec3(slope), slope.w), cube_level(s, q));
}

Surface implicit_surface(Primitive s, Ray ray, Hit hit) {
  Implicit it = load_implicit(s);
  ObjectRay r = object_ray(s, ray, IMPLICIT_REACH);
  vec3 p = into_cube(at_hit(r, hit));
  bool itself = hit.uv.x == IMPLICIT_ITSELF;
  p = itself ? p : onto_cube(p, hit.uv);

  // Step onto it along the gradient. Where there is none, it is taken to face the ray. It is made a unit vector: that of a box 1e12 wide may be so short,
  // or long, that its squares are lost on the way into the world.
  vec4 slope = formula_slope(it, p);
  vec3 gradient = vec3(slope);
  float squared = dot3(gradient, gradient);
  bool steep = squared > 1.0e-30f && squared < 1.0e30f;
  vec3 correction = gradient * (slope.w / squared);
  bool near = steep && dot3(correction, correction) < 1.0e-8f;
  p = itself && near ? into_cube(p - correction) : p;
  gradient = !itself ? cube_normal(hit.uv) : normalize3(steep ? gradient : -r.d);

  // The uv are those of the face that the normal points to.
  vec3 facing = abs3(gradient);
  float axis = facing.x >= facing.y && facing.x >= facing.z ? 0.0f : facing.y >= facing.z ? 1.0f : 2.0f;
  float toward = axis == 0.0f ? gradient.x : axis == 1.0f ? gradient.y : gradient.z;
  vec2 face = itself ? vec2(axis, toward < 0.0f ? -1.0f : 1.0f) : hit.uv;
  Surface surface = object_surface(s, p, gradient, cube_uv(p, face));

  // The reach of f's own rounding is unknown: try it. Rays start farther off by the rounding of the maps.
  vec3 out_step = into_object(s, surface.normal_geometric) * surface.offset;
  float factor = 1.0f;
#define RAY_OFFSET_OF(number, name)                                       \
  {                                                                      \
    bool wanted = itself && it.formula == number;                        \
    float found = name##_ray_offset(it, p, out_step, wanted);             \
    factor = wanted ? found : factor;                                    \
  }
  FORMULAS(RAY_OFFSET_OF)
  surface.offset = itself ? surface.offset * (factor + 1.0f) : surface.offset;
  float room = object_room(s, ray, p, surface.offset);
  vec3 inward = itself ? inward_of_cut(s, p, gradient, room) : inward_of_cut_face(s, p, hit.uv, slope.w, vec3(slope), room);
  surface.inward = step_out_of_object(s, inward);
  return surface;
}

SHADER_END
#endif
