// A vertex of a path, from its hit on: the steps that both drivers, the loop and the wavefront, take there.
#ifndef VERTEX_GLSL
#define VERTEX_GLSL
#include "bvh/traverse.glsl"
#include "integrators/flight.glsl"
#include "integrators/integrator.glsl"

SHADER_BEGIN

#if RANDOM_WALK
#define DECIDED(kind, value)                       \
  if (walks_at_random()) {                         \
    trail = with_event(trail, kind, value);        \
    PROBE(event, kind | ((value) & EVENT_VALUE)); \
  }
#else
#define DECIDED(kind, value)
#endif

#if RANDOM_WALK && HAS_PANES
// True if random paths can hit the light.
bool has_extent(uint light, vec3 p) {
  bool extended = light >= LIGHT_COUNT;
#if HAS_LIGHT_DISKS
  if (!extended) extended = sample_light(load_light(light), p).versine > 0.0f;
#endif
  return extended;
}

// The share of a shadow ray's light that the panes on its way let through, and the media between interfaces; nothing where anything else
// is in its way. `media`: those that the ray begins in.
vec3 through_panes(Frame frame, Ray ray, float distance, uint light, uint media, INOUT(uvec4) counts) {
  vec3 left = vec3(1.0f, 1.0f, 1.0f);
  uint ignored = 0u;
  bool going = true;
  uint most = has_extent(light, ray.o) ? MOST_PANES : MOST_CROSSINGS;
  for (uint i = 0u; i <= most && going; i++) {
    counts.w += 1u + TRACE_ITERATIONS;
    TraversalState state = search(ray, distance, false);
    counts.z = counts.z | iteration_limit(state);
    going = state.hit.slot != NONE;
#if HAS_ABSORPTION
    if (ANY_INTERFACE) {
      float length = medium_length(frame, media, ray.o, ray.d, going ? state.hit.t : distance);
      left = left * medium_transmittance(media, length);
    }
#endif
    if (going) {
      Interaction at = surface_interaction(ray, state.hit, media, ignored);
      left = i < most ? left * passed_by(at.material, at.context) : vec3(0.0f, 0.0f, 0.0f);
      media = at.media_behind;
      if (i == MOST_CROSSINGS) counts.z = counts.z | FLAG_ITERATION_LIMIT;
      vec3 start = spawn_ray(at.surface, ray.d).o;
      distance = distance - dot3(start - ray.o, ray.d);
      ray = continue_ray(ray, start, ray.d);
      going = max_component(left) > 0.0f;
#ifdef LOOP_BUDGET
      if (going && counts.w > LOOP_BUDGET) {
        counts.z = counts.z | FLAG_LOOP_BUDGET;
        left = vec3(0.0f, 0.0f, 0.0f);
        going = false;
      }
#endif
    }
  }
  return left;
}
#endif

// The counts of a sample whose path reaches the background of a transparent picture, straight from the eye. Its hits are few: panes.
uvec4 counts_with_background(uvec4 counts, vec3 throughput) {
  float share = dot3(throughput, vec3(0.2126f, 0.7152f, 0.0722f));
  uint whole = uint(minimum(share, 1.99f) * float(WHOLE_BACKGROUND) + 0.5f);
  return uvec4(counts.x, counts.y | whole << HITS_BITS, counts.z | FLAG_BACKGROUND, counts.w);
}

// Adds the path's gain at the hit of `ray`, and finds how it goes on. `counts`: rays, hits, flags, loop iterations; `trail`: its decisions
// (integrators/trail.glsl).
Continuations shade(Frame frame, Path path, Ray ray, Hit hit, INOUT(vec3) color, INOUT(uvec4) counts, INOUT(uint) trail) {
  Continuations all = no_continuation(path);
  bool on_surface = hit.slot != NONE;
  Flight flight = flight_of(frame, path, hit);
  on_surface = on_surface && !flight.scattered;
  if (HAS_ABSORPTION == 1 || HAS_DISPERSION == 1) path = after_flight(frame, path, hit, flight);
  counts.x += 1u;
  counts.y += on_surface ? 1u : 0u;
  counts.w += TRACE_ITERATIONS + 1u;
  PROBE(primitive, on_surface ? int(hit.id) : -1);
  DECIDED(EVENT_HIT, flight.scattered ? EVENT_IN_MEDIUM : on_surface ? hit.id + 1u : 0u);
  if (!on_surface && !flight.scattered) {
    vec3 light = missed(frame, path);
    if (IS_TRANSPARENT && path.depth == 0u) {
      light = vec3(0.0f, 0.0f, 0.0f);
      counts = counts_with_background(counts, path.throughput);
    }
    PROBE(throughput, path.throughput);
    PROBE(light, light);
    color = color + path.throughput * light;
  } else {
    Interaction at = first_interaction(path, ray, hit, flight, counts.z);
    PROBE(throughput, path.throughput);
    vec3 light = emitted(frame, path, at);
    // Tested at the bottom: Mesa 22.3.6 would run one more iteration, with all lanes idle.
    uint i = 0u;
    uint seen = 0u;
    if (shadow_rays() > 0u) do {
      counts.w += 1u + TRACE_ITERATIONS;
      Ray to_light;
      float distance;
      vec3 contribution;
      uint number;
      if (shadow_ray(frame, path, at, i, to_light, distance, contribution, number)) {
        counts.x += 1u;
        PROBE_RAY(RAY_SHADOW, i, path.depth);
        PROBE(origin, to_light.o);
        PROBE(direction, to_light.d);
        PROBE(contribution, contribution);
#if STORED_HITS
        uint occluded = load_occlusion(i);
#else
        uint occluded = ANY_PANE ? 0u : occlusion(to_light, distance, counts.z);
#endif
        vec3 visible = vec3(1.0f, 1.0f, 1.0f) * visibility(occluded);
#if RANDOM_WALK && HAS_PANES
        bool beyond = dot3(to_light.d, side_normal(at.seen)) < 0.0f;
        if (ANY_PANE) visible = through_panes(frame, to_light, distance, number, beyond ? at.media_behind : path.media, counts);
#endif
        PROBE(visibility, visible.x);
        PROBE_BACK(path.depth);
        light = light + contribution * visible;
        seen = 2u * (number + 2u) + (max_component(visible) > 0.0f ? 1u : 0u);
      }
      i += 1u;
    } while (i < shadow_rays());
    PROBE(light, light);
    DECIDED(EVENT_LIGHT, seen);
    color = color + path.throughput * light;
#if HAS_SECONDARY
    all = scatter(frame, path, at);
#if RAY_KINDS
    counts.z = counts.z | (all.cut_off ? FLAG_CUT_OFF : 0u);
#endif
#endif
    DECIDED(EVENT_WAY, all.count > 0u ? all.way + 1u : 0u);
  }
  return all;
}

#if RAY_KINDS
// A sample's counts in the form of a result whose rays are counted by kind. A count that does not fit becomes the largest that does.
uint at_most(uint x, uint most) { return x < most ? x : most; }
uvec4 counts_by_kind(uvec4 counts, uint reflected, uint refracted, uint total) {
  return uvec4(counts.x, counts.y, counts.z | at_most(refracted, 0xffffffffu >> REFRACTED_SHIFT) << REFRACTED_SHIFT,
               at_most(reflected, (1u << TOTAL_SHIFT) - 1u) |
                   at_most(total, 0xffffffffu >> TOTAL_SHIFT) << TOTAL_SHIFT);
}
#endif

SHADER_END
#endif
