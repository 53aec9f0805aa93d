// The sources of photons: a light, an emitting surface, or the environment, each with the probability with which paths sample it.
// Positions are chosen by area, directions by the emitted light. A photon's flux is that light divided by the density of all choices.
#ifndef PHOTON_SOURCE_GLSL
#define PHOTON_SOURCE_GLSL
#include "emitters/emitter.glsl"
#include "emitters/environment.glsl"
#include "emitters/light_disk.glsl"
#include "integrators/flight.glsl"
#include "lights/light.glsl"
#include "lights/photon_aim.glsl"
#include "samplers/sampler.glsl"

SHADER_BEGIN

struct PhotonSource {
  vec3 o;
  vec3 d;
  vec3 flux;   // flux of all photons, if each were as this one
  uint media;  // that it starts in
  uint light;  // its number; NONE: the surroundings
  bool below;  // it leaves a surface against its normal
  uint aim;    // as LightEmission has it
};

// A point for which start points are chosen by area: within closed shapes, on flat ones.
#define MIDDLE_sphere(e) emitter_origin(e)
#define MIDDLE_disk(e) emitter_origin(e)
#define MIDDLE_triangle(e) emitter_origin(e)
#define MIDDLE_parallelogram(e) emitter_origin(e)
#define MIDDLE_rectangle(e) emitter_origin(e)
#define MIDDLE_box(e) emitter_center(e)
#define MIDDLE_ellipsoid(e) emitter_center(e)
#define MIDDLE_cylinder(e) emitter_center(e)
vec3 middle_of(Emitter e) {
  vec3 middle = vec3(0.0f, 0.0f, 0.0f);
#define MIDDLE_OF(name, number, itself) \
  if (e.kind == number) middle = MIDDLE_##name(e);
  EMITTERS(MIDDLE_OF)
  return middle;
}

// The density of these start points by area. On flat emitters they are chosen from their own plane, and so by area.
float density_by_area(Emitter e, vec3 middle, EmitterSample point) {
  vec3 way = point.p - middle;
  float squared = maximum(dot3(way, way), 1.0e-30f);
  float closed = emitter_density(e, middle, point) * abs(dot3(way, point.normal)) / (squared * sqrt(squared));
  return may_light(e, e.primitive) ? closed : 1.0f / e.area;
}

PhotonSource from_surface(PhotonPass pass, Emitter e, vec2 start, vec2 heading, vec2 side) {
  vec3 middle = middle_of(e);
  EmitterSample point = sample_emitter(e, middle, start);
  PhotonSource source;
  source.below = e.side == 0.0f ? side.x >= 0.5f : e.side < 0.0f;
  vec3 n = source.below ? -point.normal : point.normal;
  vec3 s;
  vec3 t;
  tangents(n, s, t);
  vec3 by_cosine = cosine_direction(heading);
  source.o = point.p + n * e.offset;
  vec3 at_random = normalize3(s * by_cosine.x + t * by_cosine.y + n * by_cosine.z);
  Aimed way = aimed(pass, aim_from(point.p, n, false, side.y, heading), at_random);
  source.d = way.at;
  source.aim = aim_event(way);
  float sides = e.side == 0.0f ? 2.0f : 1.0f;
  source.flux = emitter_radiance(e, point, -source.d) * (sides * PI / density_by_area(e, middle, point) * aimed_weight(way, dot3(n, way.at) / PI));
  return source;
}

#if HAS_ENVIRONMENT
PhotonSource from_around(Frame frame, PhotonPass pass, vec2 start, vec2 heading, float aim) {
  EnvironmentSample chosen = sample_environment(frame, heading);
  LightEmission emission = from_afar(pass, chosen.direction, start, aim);
  PhotonSource source;
  source.o = emission.o;
  source.d = emission.d;
  source.aim = emission.aim;
  source.flux = environment_radiance(frame, chosen.direction) * (emission.flux.x / chosen.density);
  source.below = false;
  return source;
}
#endif

#if HAS_MEDIUM_EXTENT && HAS_ABSORPTION
// Light from infinitely far away has come through the medium around all before its photon starts. If the
// medium leaves little of a photon, it is rare instead: it starts with the probability `survival`, by a random number.
vec3 after_upstream(Frame frame, PhotonSource source, float random) {
  vec3 left = medium_transmittance(0u, medium_length(frame, 0u, source.o, -source.d, T_MISS));
  float survival = max_component(left);
  return random < survival ? source.flux * left / survival : vec3(0.0f, 0.0f, 0.0f);
}
#endif

PhotonSource photon_source(Frame frame, PhotonPass pass, uint pixel, uint number) {
  vec2 choice = sample_pair(frame, pixel, number, PAIR_SOURCE);
  vec2 start = sample_pair(frame, pixel, number, PAIR_START);
  vec2 heading = sample_pair(frame, pixel, number, PAIR_HEADING);
  vec2 side = sample_pair(frame, pixel, number, PAIR_SIDE);
  PhotonSource source;
  source.o = vec3(0.0f, 0.0f, 0.0f);
  source.d = vec3(0.0f, 1.0f, 0.0f);
  source.flux = vec3(0.0f, 0.0f, 0.0f);
  source.below = false;
  source.aim = 0u;
  float share = 1.0f;
  uint light = NONE;
  bool around = false;
#if HAS_ENVIRONMENT
  around = uint(choice.y * 16777216.0f) < frame.environment_numbers;
  if (around) {
    source = from_around(frame, pass, start, heading, side.y);
    share = environment_share(frame);
  }
#endif
  if (!around && EMITTER_COUNT > 0u) {
    light = emitter_with_number(uint(choice.x * 16777216.0f));
    share = emitter_share(light) * (1.0f - environment_share(frame));
    if (light < LIGHT_COUNT) {
      LightEmission emission = light_emission(load_light(light), pass, start, heading, side.y);
      source.o = emission.o;
      source.d = emission.d;
      source.flux = emission.flux;
      source.aim = emission.aim;
    }
    if (HAS_EMISSION == 1 && light >= LIGHT_COUNT) source = from_surface(pass, load_emitter(light), start, heading, side);
  }
  source.light = light;
  source.media = light == NONE ? 0u : load_emitter_media(2u * light + (source.below ? 1u : 0u));
  source.flux = source.flux / share;
#if HAS_MEDIUM_EXTENT && HAS_ABSORPTION
  bool afar = light == NONE;
  if (light < LIGHT_COUNT) afar = sample_light(load_light(light), source.o).distance == T_MISS;
  if (afar && frame.has_medium_extent != 0u) source.flux = after_upstream(frame, source, side.x);
#endif
  return source;
}

SHADER_END
#endif
