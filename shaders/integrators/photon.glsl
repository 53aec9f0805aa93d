// A photon's way: from a light from surface to surface, as a path goes, until it ends. It stays, for paths to gather, at each surface after
// the first that scatters widely. A photon carries flux, which refraction leaves as it is, as it leaves the radiance / index² of paths. So
// photons go by the paths' own BSDFs.
#ifndef PHOTON_GLSL
#define PHOTON_GLSL
#include "bsdf/parts.glsl"
#include "bvh/traverse.glsl"
#include "integrators/integrator.glsl"
#include "integrators/path.glsl"
#include "integrators/photon_cells.glsl"
#include "integrators/photon_source.glsl"
#include "kernels/loops.glsl"

SHADER_BEGIN

#if HAS_PHOTONS
// A bent normal changes how much light a surface takes from one direction and sends in another. Paths and photons see this from
// opposite ends (Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, 5.3).
float bent_both_ways(Interaction at, vec3 d) {
  float in_bent = abs(dot3(at.d, at.seen.normal));
  float out_bent = abs(dot3(d, at.seen.normal));
  float in_true = abs(dot3(at.d, at.seen.normal_geometric));
  float out_true = abs(dot3(d, at.seen.normal_geometric));
  return (out_true / maximum(out_bent, 1.0e-6f)) * (in_bent / maximum(in_true, 1.0e-6f));
}

// True if camera paths may come from direction d. From where a smooth triangle shows its other side, none does.
bool sees_camera_paths(Interaction at, vec3 d) {
  return HAS_SMOOTH == 0 || dot3(d, at.seen.normal_geometric) * dot3(d, side_normal(at.seen)) >= 0.0f;
}

// Flux is radiance times area times solid angle. So in a medium flux is index² times the value that radiance / index² gives.
float squared_index(uint media, vec3 light) {
  if (HAS_MEDIA == 0) return 1.0f;
  float ior = index_of_medium(media, light);
  return ior * ior;
}

PhotonResult photon_way(Frame frame, uint index, uint number) {
  PhotonPass pass = load_photon_pass();
  uint pixel = PHOTONS_OF | index;
  PhotonSource source = photon_source(frame, pass, pixel, number);
  PhotonResult result;
  result.trail = with_event(1u, EVENT_LIGHT, 2u * (source.light + 2u) + (source.below ? 1u : 0u));
  result.flags = 0u;
  result.rays = 0u;
  result.stored = 0u;
  PROBE(event, EVENT_LIGHT | ((2u * (source.light + 2u) + (source.below ? 1u : 0u)) & EVENT_VALUE));
  if (pass.target_count > 0u) {
    result.trail = with_event(result.trail, EVENT_AIM, source.aim);
    PROBE(event, EVENT_AIM | source.aim);
  }
  Path path = begin(frame, make_ray(source.o, source.d), pixel, number);
  path.media = source.media;
  vec3 sent = source.flux * squared_index(source.media, vec3(1.0f, 1.0f, 1.0f));
  bool going = max_component(source.flux) > 0.0f;
  uint most_turns = (frame.max_depth + 2u) * (MOST_PANES + 1u);
  for (uint turn = 0u; turn < most_turns; turn++) {
    if (!going) break;
    Ray ray = path_ray(frame, path);
    Hit hit = trace(ray, result.flags);
    Flight flight = flight_of(frame, path, hit);
    path = after_flight(frame, path, hit, flight);
    bool on_surface = hit.slot != NONE && !flight.scattered;
    uint event = flight.scattered ? EVENT_IN_MEDIUM : on_surface ? hit.id + 1u : 0u;
    result.rays += 1u;
    result.trail = with_event(result.trail, EVENT_HIT, event);
    PROBE(event, EVENT_HIT | (event & EVENT_VALUE));
    going = on_surface || flight.scattered;
    if (going) {
      Interaction at = first_interaction(path, ray, hit, flight, result.flags);
      vec3 cell_position = at.surface.p * pass.cells;
      if (on_surface && path.depth > 0u && in_cells(cell_position) && sum_of(part_of(at.bsdf, true)) > 0.0f) {
        Photon photon;
        photon.position = at.surface.p;
        photon.key = cell_key(cell_of(cell_position), pass.key_mask);
        photon.direction = -at.d;
        photon.number = number;
        photon.normal = at.seen.normal_geometric;
        photon.depth = path.depth;
        photon.flux = sent * path.throughput / squared_index(path.media, path.throughput);
        photon.unused = 0u;
        store_photon(photon);
        result.stored += 1u;
      }
#if HAS_ADJOINT
      at.bsdf.adjoint = true;
#endif
      Continuations all = path_scatter(frame, path, at);
      uint way = all.count > 0u ? all.way + 1u : 0u;
      result.trail = with_event(result.trail, EVENT_WAY, way);
      PROBE(event, EVENT_WAY | (way & EVENT_VALUE));
      path = all.next;
      path.throughput = path.throughput * bent_both_ways(at, path.d);
      going = all.count > 0u && path.depth <= frame.max_depth && sees_camera_paths(at, path.d);
    }
  }
  result.flags = result.flags | loops_cut_off(LOOP_PROBE);
  return result;
}
#endif

SHADER_END
#endif
