// Half of the photons of a light are aimed: at spheres around objects that focus light (glass and mirrors), which few unaimed photons would
// hit. Jensen's projection maps do this too ("Global Illumination Using Photon Maps", 1996). Here there are no cells and no bias: a
// photon's flux is divided by the density of both ways together, by which it may have come (Veach's balance heuristic, of one sample).
#ifndef PHOTON_AIM_GLSL
#define PHOTON_AIM_GLSL
#include "lights/light_emission.glsl"

SHADER_BEGIN

#if HAS_PHOTONS
#define AIMED 0.5f  // the share of photons

// The start of photons: a point, with the normal of its surface or 0; or far away, in direction `n`, on a disk perpendicular to it.
struct AimFrom {
  vec3 p;
  vec3 n;
  bool afar;
  float random;  // two random numbers: whether and at which target, …
  vec2 within;   // … and where in its window
};

// A target as seen from there. As a cap of the sphere of directions, or as a disk, it has an area of 2π size, and contains the points less
// than √(2 size) from its middle.
struct Window {
  vec3 middle;  // a unit vector; of disks relative to the scene's middle
  float size;   // its versine; half the square of the radius; 0: nothing is aimed there
};

struct Aimed {
  vec3 at;        // a direction, or a point on the disk
  bool by_aim;    // by a window
  float density;  // with which such are aimed there
  uint windows;   // that there are, …
  uint around;    // … and that hold it
};

AimFrom aim_from(vec3 p, vec3 n, bool afar, float random, vec2 within) {
  AimFrom from;
  from.p = p;
  from.n = n;
  from.afar = afar;
  from.random = random;
  from.within = within;
  return from;
}

Window window_of(PhotonPass pass, vec4 target, AimFrom from) {
  vec3 way = vec3(target) - (from.afar ? pass.center : from.p);
  float along = dot3(way, from.n);
  float squared = dot3(way, way);
  float r = target.w;
  Window window;
  window.middle = from.afar ? way - from.n * along : way / sqrt(maximum(squared, 1.0e-30f));
  // A sphere around the start or below the horizon has no window.
  float sine_squared = r * r / maximum(squared, 1.0e-30f);
  bool seen = sine_squared < 1.0f && along > -r;
  window.size = from.afar ? 0.5f * r * r : seen ? sine_squared / (1.0f + sqrt(maximum(1.0f - sine_squared, 0.0f))) : 0.0f;
  return window;
}

vec3 in_window(Window window, AimFrom from) {
  if (!from.afar) return within_cone(window.middle, window.size, from.within);
  LocalFrame local = frame_around(from.n);
  vec2 at = on_disk(from.within) * sqrt(2.0f * window.size);
  return window.middle + (local.s * at.x + local.t * at.y);
}

// at_random: the light's own choice without aiming.
Aimed aimed(PhotonPass pass, AimFrom from, vec3 at_random) {
  Aimed all;
  all.at = at_random;
  all.by_aim = false;
  all.density = 0.0f;
  all.windows = 0u;
  all.around = 0u;
  float sum = 0.0f;
  for (uint i = 0u; i < pass.target_count; i++) {
    Window window = window_of(pass, load_photon_target(i), from);
    sum = sum + window.size;
    if (window.size > 0.0f) all.windows += 1u;
  }
  // Choose a window with a probability proportional to its size.
  uint chosen = NONE;
  float left = from.random * (sum / AIMED);
  if (sum > 0.0f && from.random < AIMED) {
    for (uint i = 0u; i < pass.target_count; i++) {
      Window window = window_of(pass, load_photon_target(i), from);
      if (window.size > 0.0f && left >= 0.0f) {
        chosen = i;
        left = left - window.size;
      }
    }
    all.at = in_window(window_of(pass, load_photon_target(chosen), from), from);
    all.by_aim = true;
  }
  for (uint i = 0u; i < pass.target_count; i++) {
    Window window = window_of(pass, load_photon_target(i), from);
    vec3 apart = all.at - window.middle;
    if (i == chosen || dot3(apart, apart) < 2.0f * window.size) all.around += 1u;
  }
  if (sum > 0.0f) all.density = float(all.around) / (2.0f * PI * sum);
  return all;
}

// The weight of a photon, relative to an unaimed one. own: the density with which the light itself would choose the same.
float aimed_weight(Aimed it, float own) {
  if (it.windows == 0u) return 1.0f;
  return own > 0.0f ? own / ((1.0f - AIMED) * own + AIMED * it.density) : 0.0f;
}

// The value of EVENT_AIM for the photon's trail.
uint aim_event(Aimed it) { return 32u * it.windows + it.around; }

// Emission from direction d: a point on a disk as wide as the scene, so far off that the whole scene is in front of it. The flux is that of
// light of irradiance 1.
LightEmission from_afar(PhotonPass pass, vec3 d, vec2 start, float aim) {
  LocalFrame local = frame_around(d);
  vec2 at = on_disk(start);
  vec3 at_random = local.s * at.x + local.t * at.y;
  Aimed point = aimed(pass, aim_from(pass.center, d, true, aim, start), at_random * pass.reach);
  LightEmission emission;
  emission.o = pass.center + (point.by_aim ? point.at + d * pass.reach : (at_random + d) * pass.reach);
  emission.d = -d;
  float area = PI * pass.reach * pass.reach;
  bool before_all = !point.by_aim || dot3(point.at, point.at) < pass.reach * pass.reach;
  float flux = before_all ? area * aimed_weight(point, 1.0f / area) : 0.0f;
  emission.flux = vec3(flux, flux, flux);
  emission.aim = aim_event(point);
  return emission;
}
#endif

SHADER_END
#endif
