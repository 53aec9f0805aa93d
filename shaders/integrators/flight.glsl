// The distance that a path travels through its medium. If the medium scatters light, the distance is drawn for one channel, chosen in
// proportion to the light left in it. Its density is that of all three (Wilkie et al., "Hero Wavelength Spectral Sampling", EGSR 2014).
#ifndef FLIGHT_GLSL
#define FLIGHT_GLSL
#include "integrators/continuation.glsl"
#include "integrators/interaction.glsl"
#include "materials/medium_extent.glsl"
#include "samplers/sampler.glsl"

SHADER_BEGIN

struct Flight {
  float t;         // up to the hit, or to a point before it …
  bool scattered;  // … where the path goes on, and its hit does not count
  vec3 weight;     // weight of the light that comes from there
};

#if HAS_ABSORPTION
// The share of light that comes through this length of a medium (medium_extent.glsl).
vec3 medium_transmittance(uint media, float length) {
  Medium medium = load_medium(innermost_medium(media));
  vec3 extinction = medium.absorption;
#if HAS_SCATTERING
  extinction = extinction + medium.scattering;
#endif
  return vec3(exp_negative(-extinction.x * length), exp_negative(-extinction.y * length), exp_negative(-extinction.z * length));
}
#endif

// The flight of the path whose ray has that hit.
Flight flight_of(Frame frame, Path path, Hit hit) {
  Flight flight;
  flight.t = hit.t;
  flight.scattered = false;
  flight.weight = vec3(1.0f, 1.0f, 1.0f);
#if HAS_ABSORPTION
  float length = medium_length(frame, path.media, path.o, path.d, hit.t);
  // A shape's medium that the ray never leaves lets all light through.
  if (hit.slot != NONE || innermost_medium(path.media) == 0u) flight.weight = medium_transmittance(path.media, length);
#endif
#if HAS_SCATTERING
  Medium medium = load_medium(innermost_medium(path.media));
  if (max_component(medium.scattering) > 0.0f) {
    vec3 extinction = medium.absorption + medium.scattering;
    vec2 random = sample_pair(frame, path.pixel, path.index, PAIR_FLIGHT + surfaces_behind(path));
    float all = path.throughput.x + path.throughput.y + path.throughput.z;
    vec3 shares = path.throughput / maximum(all, 1.0e-30f);
    float rate = random.x < shares.x ? extinction.x : random.x < shares.x + shares.y ? extinction.y : extinction.z;
    float drawn = rate > 0.0f ? -log_positive(1.0f - random.y) / rate : T_MISS;
    flight.scattered = drawn < length;
    if (flight.scattered) flight.t = minimum(medium_distance(frame, path.media, path.o, path.d, drawn), hit.t);
    vec3 left = medium_transmittance(path.media, flight.scattered ? drawn : length);
    vec3 densities = shares * left;
    if (flight.scattered) {
      densities = densities * extinction;
      left = left * medium.scattering;
    }
    flight.weight = left / maximum(densities.x + densities.y + densities.z, 1.0e-30f);
  }
#endif
  return flight;
}

#if HAS_SCATTERING
// The point of the medium where the flight ends. Its normals are towards where the ray came from.
Interaction scattered_at(Path path, Flight flight) {
  Interaction at;
  at.surface = no_surface();
  at.surface.p = path.o + path.d * flight.t;
  at.surface.normal_geometric = -path.d;
  at.surface.normal = -path.d;
#if HAS_SMOOTH
  at.surface.normal_side = -path.d;
#endif
  at.seen = at.surface;
  at.d = path.d;
  at.primitive = NONE;
  at.context.point = context_of_uv(at.surface.uv);
  at.context.color = vec3(1.0f, 1.0f, 1.0f);
  at.context.cos_view = 1.0f;
  at.context.ior_from = 1.0f;
  at.context.ior_to = 1.0f;
  at.scattering = no_scattering();
  at.bsdf = black_bsdf();
  at.media_behind = path.media;
  at.in_medium = true;
  at.anisotropy = load_medium(innermost_medium(path.media)).anisotropy;
  PROBE(t, flight.t);
  PROBE(position, at.surface.p);
  return at;
}
#endif

// The path at the end of its flight.
Path after_flight(Frame frame, Path path, Hit hit, Flight flight) {
  path.throughput = path.throughput * flight.weight;
#if HAS_DISPERSION
  if (hit.slot != NONE && !flight.scattered) path = dispersed(frame, path, load_material(material_of(primitive_at(hit))).medium);
#endif
  return path;
}

// The interaction at the end of the flight.
Interaction first_interaction(Path path, Ray ray, Hit hit, Flight flight, INOUT(uint) flags) {
#if HAS_SCATTERING
  if (flight.scattered) return scattered_at(path, flight);
#endif
  return interaction_at(ray, hit, path, flags);
}

// For kernels that trace shadow rays alone: the vertex that the path has behind `hit`, if it is `there`; on_surface: whether there is one.
Interaction vertex_at(Frame frame, Path path, Ray ray, Hit hit, bool there, OUT(bool) on_surface) {
  uint flags = 0u;
  Flight flight = flight_of(frame, path, hit);
  on_surface = there && (hit.slot != NONE || flight.scattered);
  Hit some = hit;
  some.slot = there && hit.slot != NONE ? hit.slot : 0u;
#if HAS_DISPERSION
  path = after_flight(frame, path, some, flight);
#endif
  return first_interaction(path, ray, some, flight, flags);
}

#if HAS_SCATTERING
// The innermost medium's albedo: the share of the extinguished light that it scatters.
vec3 medium_albedo(uint media) {
  Medium medium = load_medium(innermost_medium(media));
  vec3 extinction = medium.absorption + medium.scattering;
  return vec3(medium.scattering.x / maximum(extinction.x, 1.0e-30f), medium.scattering.y / maximum(extinction.y, 1.0e-30f),
              medium.scattering.z / maximum(extinction.z, 1.0e-30f));
}
#endif

SHADER_END
#endif
