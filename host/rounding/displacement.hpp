// The effects of float32 on the rays, surfaces and numbers that the reference computes in float64.
// docs/rounding.md gives their amounts, their reasons, and the code that uses them.
#pragma once

#include <cstdint>

namespace eyeray::engine::rounding {

// The color that a texture returns at a hit: the color there (at_hit), or the least (darkest) or greatest
// (brightest) value of each channel within the distance that rays may be shifted. With `darkest` and
// `brightest`, rays leave surfaces without displacement.
enum class TextureChoice { at_hit, darkest, brightest };

// By default nothing is displaced. A ray starts at least `share` above the surface that it leaves
// (reference/crossings.hpp, spawn_origin), and is shifted by up to `share` along any axis. A light that is as
// near to a surface's plane may lie on either side of the plane.
struct Displacement {
  // The height is a share of |n|·|position − eye|, the shift a share of |position − eye|.
  double share = 0;
  // Rays always leave along the normal, and a surface that a ray grazes shows its other side.
  bool along_normal = false;
  uint32_t seed = 0;  // seed of the shifts
  TextureChoice textures = TextureChoice::at_hit;
  bool coincident = false;  // the farther of two surfaces that float32 cannot distinguish is hit
  uint32_t numbers = 0;     // unless 0: the seed that displaces each random number, by up to 4 units of 2^-24
  double off = 1;           // the least height above the surface, in shares; shifts always use a whole share
  // 1: the gathered photon that contributes most brings more light, by all the differences below at once, up
  // to which two photons are the same. -1: it brings less.
  int photon = 0;
  double room = 0;   // rays also start this far inside the edges of the surface that they leave, as a share
  double pivot = 0;  // unless 0: the camera ray pivots about its point at this distance
};

// The share of float32: 8 ε for each of a triangle's three vertices.
inline constexpr double float32_share = 24 * 0x1p-24;
// The room of float32: 16 shares (shaders/geometry/edges.glsl).
inline constexpr double float32_room = 16 * float32_share;
// Two photons are the same up to these differences.
inline constexpr double photon_displacement = 1e-3;  // distance, as a share of the radius
inline constexpr double photon_turn = 1e-4;          // distance between their unit directions
inline constexpr double photon_flux_change = 1e-3;   // difference in flux, as a share of the flux
// The least flux of which that share is taken, as a share of the flux with which the photon starts. Its
// throughput starts at 1, and float32 may lose it below 2⁻¹²⁶. The room between is for later factors above 1,
// for instance of roulette.
inline constexpr double photon_least_flux = 0x1p-100;

}  // namespace eyeray::engine::rounding
