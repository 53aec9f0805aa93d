// What an integrator computes, in float64. An integrator is one .cpp here, one .glsl in shaders/integrators
// and one row in integrators/registry.h.
#pragma once

#include <string_view>

#include "host/core/pixel.hpp"
#include "host/reference/media.hpp"
#include "host/reference/observer.hpp"
#include "host/reference/tracer.hpp"
#include "host/scene/integrator.hpp"

namespace eyeray::reference {

// Of what a texture shows as near to a hit as rays may start aside: what it shows at the hit, or the least or
// the greatest in each channel. For these two rays leave as the mathematics says.
enum class TextureChoice { at_hit, darkest, brightest };

// How float32 may round rays. They leave surfaces (crossings.hpp, spawn_origin) at least this far off, and up
// to this far aside; a light as near to a surface's plane may lie on either side of it.
struct RayOffset {
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

// RayOffset::share of what is rendered in float32: of a triangle, 8 ε for each of its three vertices
// (docs/numerics.md).
inline constexpr double float32_ray_offset = 24 * 0x1p-24;
// RayOffset::room of what is rendered in float32, in ray offsets (shaders/geometry/edges.glsl).
inline constexpr double float32_room = 16 * float32_ray_offset;

// A sample: its pixel, counted along the rows, and which of the pixel's it is.
struct SampleId {
  uint32_t pixel;
  uint32_t index;
};

struct Integrator {
  std::string_view manual;  // Markdown
  // What the eye's ray, its direction unit, sees, starting in `media`. `observer` has been told of that ray,
  // and is told the rest.
  PixelSample (*sample)(const Tracer& tracer, const SampleId& id, const Ray& ray, const MediaStack& media,
                        const RayOffset& ray_offset, const Observer& observer);
};

const Integrator& integrator(IntegratorType type);

// What a denoiser asks of that sample of `path`.
AuxiliarySample path_auxiliary(const Tracer& tracer, const SampleId& id, const Ray& ray,
                               const MediaStack& media);

}  // namespace eyeray::reference
