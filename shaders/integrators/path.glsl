// Path tracing (Kajiya, "The Rendering Equation", SIGGRAPH 1986): one path a sample, and at each vertex a shadow ray to a point on one light.
// Light that both a shadow ray and the path may find is weighed by the power heuristic (Veach and Guibas, "Optimally Combining Sampling
// Techniques for Monte Carlo Rendering", SIGGRAPH 1995). Paths end by Russian roulette (Arvo and Kirk, "Particle Transport and Image
// Synthesis", SIGGRAPH 1990).
#ifndef PATH_GLSL
#define PATH_GLSL
#include "bsdf/bsdf.glsl"
#include "emitters/emitter.glsl"
#include "emitters/environment.glsl"
#include "emitters/light_disk.glsl"
#include "integrators/continuation.glsl"
#include "integrators/flight.glsl"
#include "integrators/interaction.glsl"
#include "lights/light.glsl"
#include "materials/phase.glsl"
#include "math/rng.glsl"
#include "samplers/sampler.glsl"

SHADER_BEGIN

#define FIRST_ROULETTE 3u       // vertex
#define LEAST_SURVIVAL 0.05f    // its probability

vec2 path_pair(Frame frame, Path path, uint pair) {
  return sample_pair(frame, path.pixel, path.index, pair + PAIRS_A_VERTEX * surfaces_behind(path));
}

// The position of the path's last vertex, to which densities by solid angle belong.
vec3 last_vertex(Path path) {
#if HAS_PANES
  return path.from;
#else
  return path.o;
#endif
}

// The point where the path's direction was chosen, for queries of a light BVH.
vec3 chosen_at(Path path) {
#if KEEPS_POINT
  return path.point;
#else
  return last_vertex(path);
#endif
}

// A point's own frame: z is the normal towards where the ray came from.
LocalFrame local_frame(Interaction at) { return surface_frame(at.seen); }

vec3 towards_viewer(LocalFrame local, Interaction at) { return seen_from(into_frame(local, -at.d)); }

bool is_before(Interaction at, vec3 d) { return dot3(side_normal(at.seen), d) > 0.0f; }

// True if the surface may scatter light from direction d, `i` in its own frame. A normal, which may be bent, must put d on its real side.
bool on_its_side(Interaction at, vec3 d, vec3 i) {
  bool before = is_before(at, d);
  bool on_side = before == (i.z > 0.0f);
#if HAS_BENT_COAT
  on_side = on_side || (before && coat_faces(at.bsdf, i));
#endif
  return on_side;
}

// The power heuristic of a sample whose density is p, and q by the other technique. The ratio is squared: densities may be too large.
float power_heuristic(float p, float q) {
  float ratio = q / p;
  return 1.0f / (1.0f + ratio * ratio);
}

vec3 path_missed(Frame frame, Path path) {
  vec3 light = surroundings(frame, path.d);
#if HAS_ENVIRONMENT
  if (frame.environment_numbers > 0u && path.density > 0.0f)
    light = light * power_heuristic(path.density, environment_share(frame) * environment_density(frame, path.d));
#endif
#if HAS_LIGHT_DISKS
  for (uint i = 0u; i < LIGHT_COUNT; i++) {
    LightSample disk = sample_light(load_light(i), last_vertex(path));
    float density = emitter_share(i) * (1.0f - environment_share(frame)) * disk_density(disk);
    float weight = path.density > 0.0f ? power_heuristic(path.density, density) : 1.0f;
    if (disk.versine > 0.0f && in_disk(disk, path.d)) light = light + disk_radiance(disk) * weight;
  }
#endif
  return light;
}

// The surface's own light, less the part that shadow rays to it have brought already.
vec3 path_emitted(Frame frame, Path path, Interaction at) {
  vec3 light = vec3(0.0f, 0.0f, 0.0f);
#if HAS_EMISSION
  light = at.scattering.emitted;
  uint emitter = EMITTER_COUNT > 0u && path.density > 0.0f ? emitter_of(at.primitive) : NONE;
  if (emitter != NONE) {
    EmitterSample point;
    point.p = at.surface.p;
    point.normal = at.surface.normal_geometric;
    float share = light_share(frame, chosen_at(path), path.normal, emitter) * (1.0f - environment_share(frame));
    float density = share * emitter_density(load_emitter(emitter), last_vertex(path), point);
    light = light * power_heuristic(path.density, density);
  }
#endif
  return light;
}

// The normal for queries of a light BVH; 0 if the surface also transmits light from behind it.
vec3 normal_for_lights(Interaction at) {
  bool all_around = transmits(at.bsdf) || at.primitive == NONE;  // true for a point in a medium, too
  return all_around ? vec3(0.0f, 0.0f, 0.0f) : at.seen.normal;
}

// The light that arrives at the point from one light: from `direction`, if nothing blocks `ray`.
struct Arriving {
  vec3 direction;
  Ray ray;
  float distance;
  vec3 radiance;  // radiance of a light without extent π · its intensity, a density being 1
  float density;  // by solid angle, with that of the light's choice; 0 without extent
  float share;    // share of the light among all
  uint light;     // its number; NONE: the environment, or nothing
};

Arriving nothing_arriving(Interaction at) {
  Arriving arriving;
  arriving.direction = vec3(0.0f, 1.0f, 0.0f);
  arriving.ray = make_ray(at.seen.p, arriving.direction);
  arriving.distance = 0.0f;
  arriving.radiance = vec3(0.0f, 0.0f, 0.0f);
  arriving.density = 0.0f;
  arriving.share = 1.0f;
  arriving.light = NONE;
  return arriving;
}

// The light from one light or surface, chosen at random.
Arriving emitter_arriving(Frame frame, Path path, Interaction at, float random) {
  LightPick pick = pick_light(frame, at.seen.p, normal_for_lights(at), random);
  uint light = pick.light;
  Arriving arriving = nothing_arriving(at);
  arriving.light = light;
  if (HAS_LIGHT_BVH == 1 && light == NONE) return arriving;
  arriving.share = pick.share * (1.0f - environment_share(frame));
  if (light < LIGHT_COUNT) {
    LightSample s = sample_light(load_light(light), at.seen.p);
    arriving.direction = s.direction;
    arriving.radiance = s.color * PI;
#if HAS_LIGHT_DISKS
    if (s.versine > 0.0f) {
      arriving.direction = disk_direction(s, path_pair(frame, path, PAIR_EMITTER));
      arriving.radiance = disk_radiance(s);
      arriving.density = arriving.share * disk_density(s);
    }
#endif
    arriving.distance = s.distance;
    arriving.ray = spawn_to_light(at.seen, arriving.direction, is_before(at, arriving.direction), arriving.distance);
  }
#if HAS_EMISSION
  if (light >= LIGHT_COUNT) {
    Emitter emitter = load_emitter(light);
    EmitterSample point = sample_emitter(emitter, at.seen.p, path_pair(frame, path, PAIR_EMITTER));
    arriving.direction = normalize3(point.p - at.seen.p);
    // The ray ends as far off the emitter as rays start off surfaces.
    float side = dot3(arriving.direction, point.normal) < 0.0f ? emitter.offset : -emitter.offset;
    vec3 start = spawn_scattered(at.seen, arriving.direction, is_before(at, arriving.direction)).o;
    vec3 way = point.p + point.normal * side - start;
    arriving.distance = sqrt(dot3(way, way));
    arriving.ray = make_ray(start, way / arriving.distance);
    if (may_light(emitter, at.primitive)) arriving.radiance = emitter_radiance(emitter, point, arriving.direction);
    arriving.density = arriving.share * emitter_density(emitter, at.seen.p, point);
  }
#endif
  return arriving;
}

#if HAS_ENVIRONMENT
Arriving environment_arriving(Frame frame, Path path, Interaction at) {
  EnvironmentSample chosen = sample_environment(frame, path_pair(frame, path, PAIR_EMITTER));
  Arriving arriving = nothing_arriving(at);
  arriving.share = environment_share(frame);
  arriving.direction = chosen.direction;
  arriving.ray = spawn_scattered(at.seen, chosen.direction, is_before(at, chosen.direction));
  arriving.distance = T_MISS;
  arriving.radiance = environment_radiance(frame, chosen.direction);
  arriving.density = arriving.share * chosen.density;
  return arriving;
}
#endif

// The light of the one light that the vertex samples.
Arriving light_arriving(Frame frame, Path path, Interaction at) {
  vec2 random = path_pair(frame, path, PAIR_LIGHT);
  bool around = false;
  Arriving arriving = nothing_arriving(at);
#if HAS_ENVIRONMENT
  around = uint(random.y * 16777216.0f) < frame.environment_numbers;
  if (around) arriving = environment_arriving(frame, path, at);
#endif
  if (!around && EMITTER_COUNT > 0u) arriving = emitter_arriving(frame, path, at, random.x);
  return arriving;
}

// The shadow ray for light that arrives along `i_local` in the point's own frame, of which `lobes` are scattered.
bool shadow_ray_to(Frame frame, Path path, Interaction at, Arriving arriving, vec3 i_local, LobeValue lobes, OUT(Ray) ray, OUT(float) distance, OUT(vec3) contribution, OUT(uint) light) {
  ray = arriving.ray;
  light = arriving.light;
  // Shortened, so that from afar, where t is rounded by more than the emitter's own offset, the emitter does not block its own light.
  distance = arriving.distance * (1.0f - 9.5367432e-7f);
  bool on_side = on_its_side(at, arriving.direction, i_local);
#if HAS_SCATTERING
  if (at.in_medium) {
    lobes.density = phase_value(at.anisotropy, at.d, arriving.direction);
    lobes.value = vec3(lobes.density, lobes.density, lobes.density);
    on_side = true;
  }
#endif
#if HAS_ABSORPTION
  // Surfaces keep shadow rays in the medium that they begin in; interfaces do not, and there the ray itself is weakened (through_panes).
  if (!ANY_INTERFACE) {
    uint media = is_before(at, arriving.direction) ? path.media : at.media_behind;
    float length = medium_length(frame, media, arriving.ray.o, arriving.ray.d, arriving.distance);
    arriving.radiance = arriving.radiance * medium_transmittance(media, length);
  }
#endif
  float density = arriving.density;
  contribution =
      arriving.radiance * lobes.value * (density > 0.0f ? power_heuristic(density, lobes.density) / density : 1.0f / arriving.share);
  return max_component(contribution) > 0.0f && on_side && path.depth <= frame.max_depth;
}

bool path_shadow_ray(Frame frame, Path path, Interaction at, uint i, OUT(Ray) ray, OUT(float) distance, OUT(vec3) contribution, OUT(uint) light) {
  Arriving arriving = light_arriving(frame, path, at);
  LocalFrame local = local_frame(at);
  vec3 i_local = into_frame(local, arriving.direction);
  LobeValue lobes = bsdf_value(at.bsdf, lobe_shares(at.bsdf), towards_viewer(local, at), i_local, is_before(at, arriving.direction));
  return shadow_ray_to(frame, path, at, arriving, i_local, lobes, ray, distance, contribution, light);
}

// The way in which a vertex continues the path.
struct ScatterEvent {
  vec3 d;
  vec3 weight;       // weight of the light from there
  float density;     // by solid angle, of d; 0 where there was no choice
  bool refracted;    // to the other side
  bool straight_on;  // seen through the surface: a lift would move it
  bool lost;         // the surface itself stands in the way
};

// `i`, in the point's own frame: the direction that one of the lobes chose.
ScatterEvent lobe_event(Interaction at, LobeShares shares, LocalFrame local, vec3 i) {
  ScatterEvent event;
  event.d = out_of_frame(local, i);
  event.d = event.d / sqrt(maximum(dot3(event.d, event.d), 1.0e-30f));
  bool before = is_before(at, event.d);
  LobeValue lobes = bsdf_value(at.bsdf, shares, towards_viewer(local, at), i, before);
  event.weight = lobes.value / maximum(lobes.density, 1.0e-30f);
  event.density = lobes.density;
  event.refracted = !before;
  event.straight_on = false;
  event.lost = !(lobes.density > 0.0f) || !on_its_side(at, event.d, i);
  return event;
}

// The event of the one direction that is mirrored, or refracted.
ScatterEvent specular_event(Interaction at, LobeShares shares, LocalFrame local, bool refracted) {
  ScatterEvent event;
  event.d = reflected_direction(at);
  event.weight = at.bsdf.mirror / shares.mirror;
  if (HAS_MEDIA == 1 && refracted) {
    event.d = refracted_direction(at);
    event.weight = at.bsdf.transmitted / shares.transmitted;
  }
  event.weight = event.weight * under_layers(layers_between(at.bsdf, into_frame(local, event.d)), 2u);
  event.density = 0.0f;
  event.refracted = refracted;
  event.straight_on = refracted;
  event.lost = false;
  return event;
}

#if HAS_PANES
// The event of passing straight through a pane. While these are not too many, it is no vertex: `density` is that of the direction so far.
ScatterEvent passing_event(Interaction at, LobeShares shares, float density) {
  ScatterEvent event;
  event.d = at.d;
  event.weight = at.bsdf.passed / shares.passed;
  event.density = density;
  event.refracted = true;
  event.straight_on = true;
  event.lost = false;
  return event;
}
#endif

#if HAS_SCATTERING
ScatterEvent medium_event(Interaction at, LocalFrame local, vec2 u) {
  ScatterEvent event;
  event.d = normalize3(out_of_frame(local, phase_direction(at.anisotropy, u)));
  event.weight = vec3(1.0f, 1.0f, 1.0f);
  event.density = phase_value(at.anisotropy, at.d, event.d);
  event.refracted = false;
  event.straight_on = false;
  event.lost = false;
  return event;
}
#endif

// The path after the event; `straight`: past a pane that is no vertex. The vertex behind the last is there for its light alone.
Path path_after(Path path, Interaction at, ScatterEvent event, bool straight) {
  Path next = path;
  next.d = event.d;
  next.o = event.straight_on ? spawn_ray(at.surface, event.d).o : scattered_origin(at, event.d, !event.refracted);
  next.throughput = path.throughput * event.weight;
  next.density = event.density;
  if (event.refracted) next.media = at.media_behind;
#if RAY_KINDS
  next.refracted = event.refracted;
#endif
  if (!straight) next.depth = path.depth + 1u;
  if (!straight && HAS_LIGHT_BVH == 1) next.normal = normal_for_lights(at);
#if KEEPS_POINT
  if (!straight) next.point = lifts(at.seen) ? at.seen.p : next.o;
#endif
#if HAS_PANES
  next.panes = straight ? path.panes + 1u : 0u;
  if (!straight) {
    next.past_panes = path.past_panes + path.panes;
    next.from = next.o;
  }
#endif
  return next;
}

// The continuation by one of the lobes that have shares.
Continuations scatter_by(Frame frame, Path path, Interaction at, LobeShares shares) {
  LocalFrame local = local_frame(at);
  vec2 choice = path_pair(frame, path, PAIR_SCATTER);
  vec2 u = path_pair(frame, path, PAIR_DIRECTION);
  BsdfSample s = sample_bsdf(at.bsdf, shares, towards_viewer(local, at), choice.x, u);
  ScatterEvent event = lobe_event(at, shares, local, s.i);
  if (s.mirrored || s.refracted) event = specular_event(at, shares, local, s.refracted);
  bool straight = false;
#if HAS_PANES
  straight = s.passed && path.panes < MOST_PANES;
  if (s.passed) event = passing_event(at, shares, straight ? path.density : 0.0f);
#endif
#if HAS_SCATTERING
  if (at.in_medium) event = medium_event(at, local, u);
#endif
  Path next = path_after(path, at, event, straight);

  // Roulette.
  float survival = path.depth < FIRST_ROULETTE ? 1.0f : minimum(maximum(max_component(next.throughput), LEAST_SURVIVAL), 1.0f);
  next.throughput = next.throughput / survival;
  bool survives = !event.lost && choice.y < survival;
  bool goes_on = straight || path.depth <= frame.max_depth;
  Continuations all = no_continuation(path);
  all.next = next;
  all.count = survives && goes_on ? 1u : 0u;
#if RAY_KINDS
  all.cut_off = survives && !goes_on;
#endif
  all.way = in_medium(at) ? WAY_IN_MEDIUM : s.lobe | (event.refracted ? THROUGH : 0u);
  PROBE(survival, survival);
  return all;
}

Continuations path_scatter(Frame frame, Path path, Interaction at) { return scatter_by(frame, path, at, lobe_shares(at.bsdf)); }

SHADER_END
#endif
