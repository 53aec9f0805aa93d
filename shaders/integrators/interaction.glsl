// The interaction of a path with a surface: all values that integrators and materials need, found once.
#ifndef INTERACTION_GLSL
#define INTERACTION_GLSL
#include "geometry/own_color.glsl"
#include "geometry/surface.glsl"
#include "integrators/dispersion.glsl"
#include "materials/material.glsl"
#include "materials/media.glsl"

SHADER_BEGIN

struct Interaction {
  Surface surface;             // as the shape has it
  Surface seen;                // the same with its normals towards where the ray came from
  vec3 d;                      // the direction that the ray came in, unit
  uint primitive;              // the scene's index of the hit primitive
  Material material;
  ScatteringContext context;   // the inputs of the material's scattering
  Scattering scattering;       // towards where the ray came from
#if RANDOM_WALK
  Bsdf bsdf;
#endif
  uint media_behind;           // that a refracted ray is in (materials/media.glsl)
#if HAS_SCATTERING
  bool in_medium;              // no surface at all: a point of a medium that scatters (integrators/flight.glsl) …
  float anisotropy;            // … in this way (materials/phase.glsl)
#endif
};

// A surface's own frame, whose z is the normal and whose x is the direction along which microfacets are wider.
LocalFrame surface_frame(Surface seen) {
  LocalFrame frame = frame_around(seen.normal);
#if HAS_ANISOTROPY
  if (dot3(seen.rough_axis, seen.rough_axis) > 0.0f) {
    frame.s = seen.rough_axis;
    frame.t = cross3(seen.normal, frame.s);
  }
#endif
  return frame;
}

bool in_medium(Interaction at) {
#if HAS_SCATTERING
  return at.in_medium;
#else
  return false;
#endif
}

// The part of an interaction that does not depend on the material. `hit`: that of `ray`, which came through `media`. Adds to `flags` if those
// are too many.
Interaction surface_interaction(Ray ray, Hit hit, uint media, INOUT(uint) flags) {
  Primitive primitive = primitive_at(hit);
  uint material = material_of(primitive);
  Interaction at;
  at.d = ray.d;
  at.primitive = hit.id;
  at.material = load_material(material);
  at.surface = surface_at(primitive, ray, hit);
  bool front = dot3(ray.d, at.surface.normal_geometric) < 0.0f;
  at.seen = face_viewer(at.surface, front);
  PROBE(t, hit.t);
  PROBE(position, at.surface.p);
  PROBE(normal_geometric, at.surface.normal_geometric);
  PROBE(normal, at.surface.normal);
  PROBE(uv, at.surface.uv);
  PROBE(front, front);
  PROBE(material, int(material));

  at.context.point = context_on(at.surface);
  at.context.color = vec3(1.0f, 1.0f, 1.0f);
#if HAS_COLORS
  at.context.color = own_color(primitive, hit);
#endif
  at.context.cos_view = minimum(maximum(-dot3(ray.d, at.seen.normal), 0.0f), 1.0f);
#if HAS_BENT_COAT
  vec3 coat = at.seen.coat_normal;
  bool bent = coat.x != at.seen.normal.x || coat.y != at.seen.normal.y || coat.z != at.seen.normal.z;
  at.context.coat_normal = bent ? into_frame(surface_frame(at.seen), coat) : vec3(0.0f, 0.0f, 1.0f);
  at.context.cos_coat = -dot3(ray.d, coat);
#endif
  at.context.ior_from = 1.0f;
  at.context.ior_to = 1.0f;
  at.media_behind = media;
#if HAS_SCATTERING
  at.in_medium = false;
  at.anisotropy = 0.0f;
#endif
#if HAS_MEDIA
  if (at.material.medium != 0u)
    at.media_behind = front ? enter_medium(media, at.material.medium, flags) : leave_medium(media, at.material.medium);
  at.context.ior_from = load_medium(innermost_medium(media)).ior;
  at.context.ior_to = load_medium(innermost_medium(at.media_behind)).ior;
#endif
  return at;
}

Interaction interaction_at(Ray ray, Hit hit, Path path, INOUT(uint) flags) {
  uint material = material_of(primitive_at(hit));
  Interaction at = surface_interaction(ray, hit, path.media, flags);
#if HAS_DISPERSION
  at.context.ior_from = index_of_medium(path.media, path.throughput);
  at.context.ior_to = index_of_medium(at.media_behind, path.throughput);
#endif
  PROBE(ior, vec2(at.context.ior_from, at.context.ior_to));
  at.scattering = scattering_of(material, at.material, at.context);
  bool behind = !(dot3(ray.d, at.surface.normal_geometric) < 0.0f);
  if (HAS_ONE_SIDED_EMISSION == 1 && behind && (at.material.flags & MATERIAL_EMITS_IN_FRONT) != 0u)
    at.scattering.emitted = vec3(0.0f, 0.0f, 0.0f);
#if RANDOM_WALK
  at.bsdf = bsdf_of(material, at.material, at.context, at.scattering);
#if HAS_ANISOTROPY
  if (at.bsdf.widths.x > 0.0f) at.bsdf.albedo = facets_albedo(seen_from(into_frame(surface_frame(at.seen), -ray.d)), at.bsdf.widths, at.bsdf.roughness);
#endif
#endif
  PROBE(ambient, at.scattering.ambient);
  PROBE(diffuse, at.scattering.diffuse);
  PROBE(specular, at.scattering.specular);
  PROBE(reflected, at.scattering.reflected);
  PROBE(transmitted, at.scattering.transmitted);
  PROBE(emitted, at.scattering.emitted);
  return at;
}

// The origin of a ray that the surface scatters in direction d, in front of it or behind.
vec3 scattered_origin(Interaction at, vec3 d, bool before) {
  return lifts(at.surface) ? spawn_scattered(at.seen, d, before).o : spawn_ray(at.surface, d).o;
}

vec3 reflected_direction(Interaction at) { return normalize3(at.d + at.seen.normal * (2.0f * at.context.cos_view)); }

// Called only where refraction is possible.
vec3 refracted_direction(Interaction at) {
  float eta = at.context.ior_from / at.context.ior_to;
  float cos_view = at.context.cos_view;
  float cos_squared = 1.0f - eta * eta * (1.0f - cos_view * cos_view);
  return normalize3(at.d * eta + at.seen.normal * (eta * cos_view - sqrt(maximum(cos_squared, 0.0f))));
}

SHADER_END
#endif
