// Photon mapping, each sample anew (Knaus and Zwicker, "Progressive Photon Mapping: A Probabilistic Approach", TOG 2011): lights emit
// photons, which are scattered and stored on surfaces. A path goes from the eye, by the sharp part of each BSDF, until the wide part of
// one ends it. The light that the wide part scatters comes from one light, by a shadow ray, or by way of two surfaces or more, by photons
// nearby.
#ifndef SPPM_GLSL
#define SPPM_GLSL
#include "bsdf/parts.glsl"
#include "integrators/path.glsl"
#include "integrators/photon_cells.glsl"

SHADER_BEGIN

vec3 sppm_missed(Frame frame, Path path) { return path_missed(frame, path); }

#if HAS_PHOTONS && !defined(SENDS_PHOTONS)
// The light of the photons around the point that is scattered towards the viewer. Epanechnikov's kernel falls to 0 at the disk's rim,
// where rounding decides which photons are within.
vec3 gathered(Frame frame, Path path, Interaction at) {
  vec3 light = vec3(0.0f, 0.0f, 0.0f);
  PhotonPass pass = load_photon_pass();
  LobeShares wide = part_of(at.bsdf, true);
  vec3 n = at.seen.normal_geometric;
  vec3 p = at.surface.p;
  vec3 cell_position = p * pass.cells;
  if (sum_of(wide) > 0.0f && path.depth <= frame.max_depth && in_cells(cell_position)) {
    LocalFrame local = local_frame(at);
    vec3 o = towards_viewer(local, at);
    vec3 lowest = cell_of(cell_position - vec3(0.5f, 0.5f, 0.5f));
    for (uint corner = 0u; corner < 8u; corner++) {
      vec3 cell = lowest + vec3(float(corner & 1u), float((corner >> 1u) & 1u), float(corner >> 2u));
      uint key = cell_key(cell, pass.key_mask);
      uint end = load_photon_cell(key + 1u);
      for (uint i = load_photon_cell(key); i < end; i++) {
        Photon photon = load_photon(i);
        vec3 apart = photon.position - p;
        float squared = dot3(apart, apart);
        // The light comes from where the photon's own surface has it: from behind, too, where the surface transmits.
        bool before = is_before(at, photon.direction);
        float facing = dot3(photon.normal, before ? n : -n);
        // A photon of another cell with the same key counts in that cell only.
        vec3 its = cell_of(photon.position * pass.cells);
        bool counts = its.x == cell.x && its.y == cell.y && its.z == cell.z && squared < pass.radius_squared &&
                      abs(dot3(apart, n)) < pass.height && facing > 0.9f && photon.depth + path.depth <= frame.max_depth;
        if (counts) {
          vec3 i_local = into_frame(local, photon.direction);
          vec3 value = bsdf_value(at.bsdf, wide, o, i_local, before).value / maximum(abs(dot3(photon.direction, n)), 1.0e-6f);
          float kernel = 1.0f - squared / pass.radius_squared;
          if (on_its_side(at, photon.direction, i_local)) light = light + value * photon.flux * kernel;
        }
      }
    }
  }
  return light * pass.scale;
}
#else
vec3 gathered(Frame frame, Path path, Interaction at) { return vec3(0.0f, 0.0f, 0.0f); }
#endif

// A point of a medium is no surface to gather on: there paths go on as in plain path tracing.
vec3 sppm_emitted(Frame frame, Path path, Interaction at) {
  vec3 light = path_emitted(frame, path, at);
  if (!in_medium(at)) light = light + gathered(frame, path, at);
  return light;
}

// The sharp part may find the light by itself too; the wide part does not look for it.
bool sppm_shadow_ray(Frame frame, Path path, Interaction at, uint i, OUT(Ray) ray, OUT(float) distance, OUT(vec3) contribution, OUT(uint) light) {
  Arriving arriving = light_arriving(frame, path, at);
  LocalFrame local = local_frame(at);
  vec3 o = towards_viewer(local, at);
  vec3 i_local = into_frame(local, arriving.direction);
  bool before = is_before(at, arriving.direction);
  LobeValue sharp = bsdf_value(at.bsdf, part_of(at.bsdf, false), o, i_local, before);
  LobeValue lobes = bsdf_value(at.bsdf, part_of(at.bsdf, true), o, i_local, before);
  lobes.value = lobes.value + sharp.value * (arriving.density > 0.0f ? power_heuristic(arriving.density, sharp.density) : 1.0f);
  lobes.density = 0.0f;
  return shadow_ray_to(frame, path, at, arriving, i_local, lobes, ray, distance, contribution, light);
}

Continuations sppm_scatter(Frame frame, Path path, Interaction at) {
  LobeShares sharp = part_of(at.bsdf, false);
  Continuations all = scatter_by(frame, path, at, sharp);
  bool ends = sum_of(part_of(at.bsdf, true)) > 0.0f && path_pair(frame, path, PAIR_SCATTER).x >= sum_of(sharp);
  if (ends && !in_medium(at)) {
    all.count = 0u;
#if RAY_KINDS
    all.cut_off = false;
#endif
  }
  return all;
}

SHADER_END
#endif
