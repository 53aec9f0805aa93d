// A fingerprint of a path's decisions, by which verify detects samples whose paths diverge (docs/gates.md): the objects hit, the light
// seen, and the lobe by which the path goes on. Each is an event; the reference has the same ones in the same order.
#ifndef TRAIL_GLSL
#define TRAIL_GLSL
#include "math/rng.glsl"

SHADER_BEGIN

#define EVENT_HIT 0x10000000u    // + the primitive's number + 1; + 0: nothing is hit; + EVENT_IN_MEDIUM: a medium scatters it before
#define EVENT_LIGHT 0x20000000u  // + twice the light's number + 2, and one more where it is seen; + 0: no shadow ray
#define EVENT_WAY 0x30000000u    // + the lobe + 1, and THROUGH; + 0: the path ends
#define EVENT_AIM 0x40000000u    // for a photon: 32 times how many targets its start sees, and how many of them it heads for (lights/photon_aim.glsl)
#define EVENT_VALUE 0x0fffffffu  // the largest value of an event
#define EVENT_IN_MEDIUM EVENT_VALUE
#define THROUGH 0x100u           // beyond the surface
#define WAY_IN_MEDIUM 0xfeu      // in place of a lobe

uint with_event(uint trail, uint event, uint value) { return pcg_hash(trail ^ (event | (value & EVENT_VALUE))); }

SHADER_END
#endif
