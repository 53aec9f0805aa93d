// Finds the hit of a ray with one formula's surface f = 0 in the cube (shapes/implicit.glsl) if no Lipschitz constant is declared: by affine bounds
// of f (bound_march.glsl), and its slope by forward differentiation. Included once a formula, with FORMULA_NAME(part), the name of its functions,
// FORMULA_BOUND(it, x, y, z) and FORMULA_DUAL(it, p).
#ifndef FORMULA_NAME
#error FORMULA_NAME, FORMULA_BOUND and FORMULA_DUAL say whose march this is
#endif

SHADER_BEGIN

// f along o + s·d, m − h ≤ s ≤ m + h.
vec3 FORMULA_NAME(bound)(Implicit it, vec3 o, vec3 d, float m, float h) {
  return FORMULA_BOUND(it, bound_of_placed(it.center.x, it.extent.x, o.x, d.x, m, h),
                           bound_of_placed(it.center.y, it.extent.y, o.y, d.y, m, h),
                           bound_of_placed(it.center.z, it.extent.z, o.z, d.z, m, h));
}

// The function of the same name in shapes/implicit/lipschitz_march.glsl describes the result.
vec4 FORMULA_NAME(march)(Implicit it, ObjectRay r, float start, float end, bool at_entry, float sign, bool wanted) {
  March march = march_begin(start, end, sign, IMPLICIT_FINEST / sqrt(dot3(r.d, r.d)));
  march.over = march.over || !wanted;
  bool caps = false;
  for (uint i = 0u; i < IMPLICIT_PIECES && !march.over; i++) {
    bool first = march.sign == 0.0f;
    march = march_on(march, FORMULA_NAME(bound)(it, r.o, r.d, march_middle(march), march_half(march)));
    caps = caps || (first && march.sign < 0.0f && at_entry);
    march.over = march.over || caps;
  }
  float part = !wanted ? IMPLICIT_NOTHING
               : caps ? IMPLICIT_ENTRY
               : !march.over ? IMPLICIT_ITERATION_LIMIT
               : march.found ? IMPLICIT_ITSELF
               : march.sign < 0.0f && !it.open ? IMPLICIT_EXIT : IMPLICIT_NOTHING;
  return vec4(caps ? start : march.found ? march.root : march.over ? end : march.unknown, part, caps ? start : march_past(march), caps ? -1.0f : march.beyond);
}

// The gradient of f at q, in the cube's coordinates, and f.
vec4 FORMULA_NAME(slope)(Implicit it, vec3 q, bool wanted) {
  vec4 at = vec4(0.0f, 0.0f, 0.0f, 0.0f);
  if (wanted) at = FORMULA_DUAL(it, it.center + it.extent * q);
  return vec4(at.x * it.extent.x, at.y * it.extent.y, at.z * it.extent.z, at.w);
}

// The factor for the step `out` with which the march finds the right sign of f there, judged by the slope. The march trusts a sign from a part of e
// on, since f seldom rounds as badly as e. If f does, it deviates from a line, and rays must start farther off: at the distance given by e itself, if
// necessary.
float FORMULA_NAME(ray_offset)(Implicit it, vec3 q, vec3 out_step, bool wanted) {
  float factor = 1.0f;
  if (wanted) {
    vec3 at = FORMULA_NAME(bound)(it, q, out_step, 0.0f, 1.0f);
    float most = 2.0f * (abs(at.x) + at.z) / abs(at.y);
    float believed = MARCH_LIKELY * at.z;
    float first = 0.0f;
    float rise = 0.0f;
    uint samples = most > 1.0f && most < IMPLICIT_MOST_RAY_OFFSET ? 4u : 0u;
    for (uint i = 0u; i < samples; i++) {
      float offset = most * (1.0f - float(i >> 1u) / float(IMPLICIT_STRAYS));
      offset = (i & 1u) == 0u ? offset : -offset;
      float f = FORMULA_NAME(bound)(it, q, out_step, offset, 0.0f).x;
      first = i == 0u ? f : first;
      rise = i == 1u ? 0.5f * (first - f) / most : rise;
      believed = i > 1u ? maximum(believed, 3.0f * abs(f - rise * offset)) : believed;
      samples = i == 3u && believed > MARCH_LIKELY * at.z ? 2u * IMPLICIT_STRAYS : samples;
    }
    float needed = 2.0f * (abs(at.x) + minimum(believed, at.z)) / abs(at.y);
    factor = needed < 1.0f ? 1.0f : needed < IMPLICIT_MOST_RAY_OFFSET ? needed : IMPLICIT_MOST_RAY_OFFSET;
  }
  return factor;
}

SHADER_END
