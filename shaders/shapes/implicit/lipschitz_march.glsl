// Finds the hit of a ray with one formula's surface f = 0 in the cube (shapes/implicit.glsl), by sphere tracing. `f` is never steeper than a declared
// constant, so no root is nearer than |f| over it. Included once a formula, with FORMULA_NAME(part), the name of its functions, FORMULA_VALUE(it,
// p) and, where FORMULA_HAS_GRADIENT(it), FORMULA_GRADIENT(it, p).
#ifndef FORMULA_NAME
#error FORMULA_NAME, FORMULA_VALUE and FORMULA_GRADIENT say whose march this is
#endif

SHADER_BEGIN

// Along o + s·d from `start` to `end`, a segment within the cube. `at_entry`: it starts on a face, which is a cap where f is negative. `sign`: of f
// at the start; 0 where not known. Not `wanted`, it takes no time. Returns s, its IMPLICIT_ kind, and from where on f has which sign.
vec4 FORMULA_NAME(march)(Implicit it, ObjectRay r, float start, float end, bool at_entry, float sign, bool wanted) {
  vec3 toward = it.extent * r.d;
  float stride = 1.0f / (it.lipschitz * sqrt(dot3(toward, toward)));
  float unit = 1.0f / sqrt(dot3(r.d, r.d));
  float shortest = IMPLICIT_LEAST_STEP * unit;

  // Step until the sign changes. Nothing is hit within |f| over the constant of a point; where the free ways of two points touch, nothing is between them.
  // So a step may be longer than the free way, as long as that at its far end is expected to touch, by how fast the last two shrank. If it does not, back to
  // the free way (Bálint and Valasek 2018). The least step gets past where f is almost 0, and grows while it stays so; thinner parts are not seen.
  float s = start;
  float f = 0.0f;
  float before = start;
  float f_before = 0.0f;
  float free_before = 0.0f;
  bool inside = false;
  bool crosses = false;
  bool caps = false;
  bool going = wanted;
  bool stretched = false;
  float least = shortest;
  for (uint i = 0u; i < IMPLICIT_STEPS && going; i++) {
    f = FORMULA_VALUE(it, it.center + it.extent * (r.o + r.d * s));
    bool below = f < 0.0f;
    inside = i == 0u ? (sign == 0.0f ? below : sign < 0.0f) : inside;
    caps = i == 0u && below && at_entry;
    float free = abs(f) * stride;
    float step = s - before;
    float sure = maximum(least, free_before);
    bool back = stretched && step > free_before + free;
    crosses = !back && below != inside;
    going = !crosses && !caps && (back || s < end);

    // Written so that a NaN makes the least step.
    least = free < shortest ? minimum(1.05f * least, IMPLICIT_MOST_LEAST * shortest) : shortest;
    float shrinks = step > 0.0f ? (free_before - free) / step : 1.0f;
    float stretch = minimum(IMPLICIT_RELAXED / maximum(1.0f + shrinks, 0.5f), IMPLICIT_MOST_STRETCH);
    stretched = !back && stretch > 1.0f;
    float next = back ? before + sure : s + maximum(least, free * maximum(1.0f, stretch));
    before = going && !back ? s : before;
    f_before = going && !back ? f : f_before;
    free_before = going && !back ? free : free_before;
    s = going ? minimum(next, end) : s;
  }

  // Narrow it down, by halves and secants in turn.
  float low = before;
  float high = s;
  float f_low = f_before;
  float f_high = f;
  float width = IMPLICIT_WIDTH * unit;
  for (uint i = 0u; i < IMPLICIT_REFINEMENTS && crosses && high - low > width; i++) {
    float share = f_low / (f_low - f_high);
    bool secant = (i & 1u) == 0u && share > 0.05f && share < 0.95f;
    float middle = low + (high - low) * (secant ? share : 0.5f);
    float value = FORMULA_VALUE(it, it.center + it.extent * (r.o + r.d * middle));
    bool left = (value < 0.0f) == inside;
    low = left ? middle : low;
    f_low = left ? value : f_low;
    high = left ? high : middle;
    f_high = left ? f_high : value;
  }
  float share = f_low / (f_low - f_high);
  float root = low + (high - low) * (share >= 0.0f && share <= 1.0f ? share : 0.5f);

  float part = !wanted ? IMPLICIT_NOTHING
               : going ? IMPLICIT_ITERATION_LIMIT
               : crosses ? IMPLICIT_ITSELF
               : caps ? IMPLICIT_ENTRY
               : inside && !it.open ? IMPLICIT_EXIT : IMPLICIT_NOTHING;
  return vec4(crosses ? root : s, part, s, crosses != inside ? -1.0f : 1.0f);
}

// The gradient of f at q, in the cube's coordinates, and f. By the formula's own gradient if it has one; else by differences of the fourth order, steps
// of 1/256 of the box.
vec4 FORMULA_NAME(slope)(Implicit it, vec3 q, bool wanted) {
  vec3 gradient = vec3(0.0f, 0.0f, 0.0f);
  float f = 0.0f;
  uint turns = FORMULA_HAS_GRADIENT(it) ? 1u : 13u;
  for (uint i = 13u - turns; i < 13u && wanted; i++) {
    uint axis = i >> 2u;
    uint which = i & 3u;
    float step = axis == 3u ? 0.0f : which == 0u ? 1.0f : which == 1u ? -1.0f : which == 2u ? 2.0f : -2.0f;
    float weight = which == 0u ? 8.0f : which == 1u ? -8.0f : which == 2u ? -1.0f : 1.0f;
    step = step * IMPLICIT_DIFFERENCE;
    vec3 offset = vec3(axis == 0u ? step : 0.0f, axis == 1u ? step : 0.0f, axis == 2u ? step : 0.0f);
    f = FORMULA_VALUE(it, it.center + it.extent * (q + offset));
    float part = f * weight * (1.0f / (12.0f * IMPLICIT_DIFFERENCE));
    gradient.x = gradient.x + (axis == 0u ? part : 0.0f);
    gradient.y = gradient.y + (axis == 1u ? part : 0.0f);
    gradient.z = gradient.z + (axis == 2u ? part : 0.0f);
  }
  for (uint i = 0u; i < 1u && wanted && FORMULA_HAS_GRADIENT(it); i++)
    gradient = it.extent * FORMULA_GRADIENT(it, it.center + it.extent * q);
  return vec4(gradient.x, gradient.y, gradient.z, f);
}

// By how much the step `out` has to be multiplied for f to be above 0 that far outside q and below 0 that far inside. More than a few times rounding only
// where f is hardly steep, or coarse.
float FORMULA_NAME(ray_offset)(Implicit it, vec3 q, vec3 out_step, bool wanted) {
  float factor = 1.0f;
  uint sound = 0u;
  for (uint i = 0u; i < 16u && wanted && sound < 2u; i++) {
    bool outer = (i & 1u) == 0u;
    float f = FORMULA_VALUE(it, it.center + it.extent * (q + out_step * (outer ? factor : -factor)));
    bool right = outer ? f > 0.0f : f < 0.0f;
    sound = right ? sound + 1u : 0u;
    factor = right ? factor : minimum(factor * 2.0f, IMPLICIT_MOST_RAY_OFFSET);
  }

  // Two signs may be right by accident. The rounding of f shows in its deviation from the line through the first two points. If the deviation is
  // small, few signs suffice.
  float rise = 0.0f;
  float needed = 0.0f;
  for (uint i = 0u; i < (needed > 1.0f ? 2u * IMPLICIT_STRAYS : 6u) && wanted; i++) {
    float offset = IMPLICIT_MOST_RAY_OFFSET * (1.0f - float(i >> 1u) / float(IMPLICIT_STRAYS));
    offset = (i & 1u) == 0u ? offset : -offset;
    float f = FORMULA_VALUE(it, it.center + it.extent * (q + out_step * offset));
    rise = i == 0u ? f : i == 1u ? (rise - f) / (2.0f * IMPLICIT_MOST_RAY_OFFSET) : rise;
    needed = i > 1u ? maximum(needed, 3.0f * abs(f - rise * offset) / rise) : 0.0f;
  }
  return needed > IMPLICIT_COARSE ? minimum(maximum(needed, factor), IMPLICIT_MOST_RAY_OFFSET) : factor;
}

SHADER_END
