// How a ray finds one formula's surface f = 0 in the cube (shapes/implicit.glsl) where no Lipschitz constant is declared: by enclosures of f (enclosure_march.glsl),
// and its slope by forward differentiation. Included once a formula, with FORMULA_NAME(part), what its functions are called,
// FORMULA_ENCLOSURE(it, x, y, z) and FORMULA_DUAL(it, p).
#ifndef FORMULA_NAME
#error FORMULA_NAME, FORMULA_ENCLOSURE and FORMULA_DUAL say whose march this is
#endif

SHADER_BEGIN

// f along o + s·d, m − h ≤ s ≤ m + h.
vec3 FORMULA_NAME(enclosed)(Implicit it, vec3 o, vec3 d, float m, float h) {
  return FORMULA_ENCLOSURE(it, enclosure_of_placed(it.center.x, it.extent.x, o.x, d.x, m, h),
                           enclosure_of_placed(it.center.y, it.extent.y, o.y, d.y, m, h),
                           enclosure_of_placed(it.center.z, it.extent.z, o.z, d.z, m, h));
}

// As in implicit_march.glsl. Where crossings are passed the ray's side counts: a root that leaves it on the same, for another was lost next to it,
// is none.
vec2 FORMULA_NAME(march)(Implicit it, Ray ray, ObjectRay r, float start, float end, bool at_entry, bool wanted) {
  March march = march_begin(start, end, IMPLICIT_FINEST / sqrt(dot3(r.d, r.d)));
  march.over = march.over || !wanted;
  uint crossings = 0u;
  float t = T_NONE;
  bool begun = false;
  bool inside = false;
  bool caps = false;
  for (uint i = 0u; i < IMPLICIT_PIECES && crossings <= IMPLICIT_CROSSINGS && !march.over; i++) {
    march = march_on(march, FORMULA_NAME(enclosed)(it, r.o, r.d, march_middle(march), march_half(march)));

    // The side on which it starts.
    bool begins = !begun && (march.sign != 0.0f || march.found);
    inside = begins ? march.sign < 0.0f || (march.sign == 0.0f && march.beyond > 0.0f) : inside;
    begun = begun || begins;
    bool on_cap = begins && inside && at_entry;
    t = on_cap ? r.t + start : t;
    caps = on_cap && !PASSED(ray, t);

    float next = crossing_t(r, march.root, t);
    bool lost = COUNTS(ray) && (march.beyond < 0.0f) == inside;
    bool passed = march.found && !caps && (lost || PASSED(ray, next));
    t = march.found && !caps && !lost ? next : t;
    inside = passed && !lost ? !inside : inside;
    if (passed) march = march_past(march);
    crossings = passed ? crossings + 1u : crossings;
    march.over = march.over || caps;
  }
  float part = !wanted ? IMPLICIT_NOTHING
               : caps ? IMPLICIT_ENTRY
               : !march.over ? IMPLICIT_RAN_OUT
               : march.found ? IMPLICIT_ITSELF
               : inside && !it.open ? IMPLICIT_EXIT : IMPLICIT_NOTHING;
  return vec2(caps || march.found ? t : march.over ? crossing_t(r, end, t) : r.t + march.unknown, part);
}

// The gradient of f at q, in the cube's coordinates, and f.
vec4 FORMULA_NAME(slope)(Implicit it, vec3 q, bool wanted) {
  vec4 at = vec4(0.0f, 0.0f, 0.0f, 0.0f);
  if (wanted) at = FORMULA_DUAL(it, it.center + it.extent * q);
  return vec4(at.x * it.extent.x, at.y * it.extent.y, at.z * it.extent.z, at.w);
}

// By how much the step `out` has to be multiplied for f to be off 0 for certain there, as far as the slope tells.
float FORMULA_NAME(clearance)(Implicit it, vec3 q, vec3 out_step, bool wanted) {
  float factor = 1.0f;
  if (wanted) {
    vec3 at = FORMULA_NAME(enclosed)(it, q, out_step, 0.0f, 1.0f);
    float needed = 2.0f * (abs(at.x) + at.z) / abs(at.y);
    factor = needed < 1.0f ? 1.0f : needed < IMPLICIT_MOST_CLEARANCE ? needed : IMPLICIT_MOST_CLEARANCE;
  }
  return factor;
}

SHADER_END
