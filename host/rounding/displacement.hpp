// The effects of float32 on the rays, surfaces and numbers that the reference computes in float64.
// docs/rounding.md gives their amounts, their reasons, and the code that uses them.
#pragma once

#include <cstdint>

namespace eyeray::engine::rounding {

// The color that a texture gives a hit: its color there, or the least or the greatest of each channel within
// the distance that rays may be shifted. With these two, rays leave as in the mathematics.
enum class TextureChoice { at_hit, darkest, brightest };

// By default nothing is displaced. A ray starts at least `share` above the surface that it leaves
// (reference/crossings.hpp, spawn_origin), and is shifted by up to `share` along any axis. A light that is as
// near to a surface's plane may lie on either side of it.
struct Displacement {
  double share = 0;           // above, of |n|·|position − eye|; shifted, of |position − eye|
  bool along_normal = false;  // rays always leave along it; a surface that one grazes shows its other side
  uint32_t seed = 0;          // of the shifts
  TextureChoice textures = TextureChoice::at_hit;
  bool coincident = false;   // the farther of two surfaces that float32 cannot distinguish is hit
  uint32_t numbers = 0;      // unless 0, a seed of how far each random number is off, by some units of 2^-24
  double off = 1;            // the least height above the surface, in shares; shifts take all of it
  double photon_nearer = 0;  // by this share of the radius, the gathered photon that contributes most
  double room = 0;           // and that far inside of the edges of the surface that they leave
  double pivot = 0;          // unless 0, the eye's ray turns about the point at this distance
};

// The share of float32: 8 ε for each of a triangle's three vertices.
inline constexpr double float32_share = 24 * 0x1p-24;
// Its room, in shares (shaders/geometry/edges.glsl).
inline constexpr double float32_room = 16 * float32_share;
// The largest distance of a photon from the reference's, as a share of the radius.
inline constexpr double photon_displacement = 1e-3;

}  // namespace eyeray::engine::rounding
