// A sample's auxiliary values for a denoiser: albedo and normal of the first vertex of its path that scatters light in more than a
// direction or two. The path is the picture's, but for roulette, which does not end it here.
#ifndef AUXILIARY_GLSL
#define AUXILIARY_GLSL
#include "bvh/traverse.glsl"
#include "integrators/flight.glsl"
#include "integrators/integrator.glsl"

SHADER_BEGIN

AuxiliaryResult no_auxiliary() {
  AuxiliaryResult none;
  none.albedo = vec3(0.0f, 0.0f, 0.0f);
  none.flags = 0u;
  none.normal = vec3(0.0f, 0.0f, 0.0f);
  none.unused = 0u;
  return none;
}

#if RANDOM_WALK
AuxiliaryResult auxiliary_of(Frame frame, Ray camera_ray, uint pixel, uint index) {
  AuxiliaryResult result = no_auxiliary();
  vec3 white = vec3(1.0f, 1.0f, 1.0f);
  Path path = begin(frame, camera_ray, pixel, index);
  bool going = true;
  uint most_turns = (frame.max_depth + 2u) * (MOST_PANES + 1u);
  for (uint turn = 0u; turn < most_turns; turn++) {
    if (!going) break;
    Ray ray = path_ray(frame, path);
    Hit hit = trace(ray, result.flags);
    Flight flight = flight_of(frame, path, hit);
    path = after_flight(frame, path, hit, flight);
    going = hit.slot != NONE || flight.scattered;
    if (!going) {
      result.albedo = white;
      result.normal = vec3(0.0f, 0.0f, 0.0f);
    } else {
      Interaction at = first_interaction(path, ray, hit, flight, result.flags);
      result.albedo = max_component(at.scattering.emitted) > 0.0f ? white : bsdf_albedo(at.bsdf);
      result.normal = at.seen.normal;
#if HAS_SCATTERING
      if (flight.scattered) result.albedo = medium_albedo(path.media);
#endif
      path = scatter(frame, path, at).next;
      going = !flight.scattered && is_specular(at.bsdf) && path.depth <= frame.max_depth + 1u;
    }
  }
  return result;
}
#endif

SHADER_END
#endif
