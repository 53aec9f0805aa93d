// What float32 may do to the rays, surfaces and numbers that the reference computes in float64. By how much,
// why, and who asks for it: docs/rounding.md.
#pragma once

#include <cstdint>

namespace eyeray::engine::rounding {

// Of what a texture shows as near to a hit as rays may start aside: what it shows at the hit, or the least or
// the greatest in each channel. For these two rays leave as the mathematics says.
enum class TextureChoice { at_hit, darkest, brightest };

// By default nothing is displaced. Rays leave surfaces (reference/crossings.hpp, spawn_origin) at least so
// far off, and up to so far aside; a light as near to a surface's plane may lie on either side of it.
struct Displacement {
  double share = 0;           // off, of |n|·|position − eye|; aside, of |position − eye|
  bool along_normal = false;  // they always leave along it; and what a ray runs along shows its other side
  uint32_t seed = 0;          // of where aside
  TextureChoice textures = TextureChoice::at_hit;
  bool coincident = false;   // of two surfaces that float32 cannot tell apart, the farther one is hit
  uint32_t numbers = 0;      // unless 0, a seed of how far each random number is off, by some units of 2^-24
  double off = 1;            // how much of `share` they start off, at least; aside it is all
  double photon_nearer = 0;  // by this share of the radius, of those gathered the one that tells most
  double room = 0;           // and that far inside of the edges of the surface that they leave
  double pivot = 0;  // unless 0, the eye's ray is turned: so far along it stays, and before that it is aside
};

// The share of what is rendered in float32: of a triangle, 8 ε for each of its three vertices.
inline constexpr double float32_share = 24 * 0x1p-24;
// Its room, in shares (shaders/geometry/edges.glsl).
inline constexpr double float32_room = 16 * float32_share;
// How far from the reference's a photon may lie and be shown, as a share of the radius: of its light a kernel
// tells twice that.
inline constexpr double photon_aside = 1e-3;

}  // namespace eyeray::engine::rounding
