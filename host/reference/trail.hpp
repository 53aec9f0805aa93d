// The decisions of a random path, in the shaders' encoding (integrators/trail.glsl): events, and the
// fingerprint of all.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "host/reference/rng.hpp"

namespace eyeray::engine::reference {

enum class Event : uint32_t {
  hit = 1,  // of a primitive, its number + 1; 0: nothing is hit; `in_medium`: a medium scatters it before
  light =
      2,    // twice its number + 2, of the environment twice 1, and one more where it is seen; 0: none drawn
  way = 3,  // by which the path goes on: a lobe + 1, and `through`; 0: it ends
  aim = 4,  // of a photon: 32 times how many targets its start sees, and how many of them it heads for
};
inline constexpr uint32_t in_medium = 0x0fffffff;
inline constexpr uint32_t through = 0x100;
inline constexpr uint32_t way_in_medium = 0xfe;  // in place of a lobe

constexpr uint32_t event_of(Event kind, uint64_t value) {
  return uint32_t(kind) << 28 | uint32_t(value & 0x0fffffff);
}
inline uint32_t with_event(uint32_t trail, uint32_t event) {
  return pcg(trail ^ event);
}
// The trail of a sample with these events.
uint32_t trail_of(std::span<const uint32_t> events);
// "hits primitive 3".
std::string describe_event(uint32_t event);

}  // namespace eyeray::engine::reference
