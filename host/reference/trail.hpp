// The decisions of a random path, in the shaders' encoding (integrators/trail.glsl): events, and the
// fingerprint of all events.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "host/reference/rng.hpp"

namespace eyeray::engine::reference {

enum class Event : uint32_t {
  // The number of the primitive hit, + 1. 0: nothing is hit; `in_medium`: a medium scatters the path first.
  hit = 1,
  // 2 · (the number of the light + 2), where −1 is the environment's number; plus 1 if the light is seen.
  // 0: no light is sampled. For a photon, the 1 is added if it leaves a surface against its normal.
  light = 2,
  // The lobe + 1 by which the path continues, and `through`. 0: the path ends.
  way = 3,
  // For a photon: 32 · the number of targets that its start sees, + the number of those for which it heads.
  aim = 4,
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
// The event in words, such as "hits primitive 3".
std::string describe_event(uint32_t event);

}  // namespace eyeray::engine::reference
