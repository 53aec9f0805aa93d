// The sources of photons: a light, an emitting surface, or the environment, each chosen with the probability
// with which paths sample it. Positions are chosen by area, directions by the light emitted there.
#pragma once

#include <functional>

#include "host/reference/media.hpp"
#include "host/scene/photons.hpp"

namespace eyeray::engine::reference {

struct PhotonSource {
  Ray ray;
  Vec3 flux{0};        // the flux of all photons, if each were like this one
  uint64_t light;      // its number; −1 for the environment
  bool below = false;  // true if the photon leaves a surface on the side opposite to its normal
  uint64_t aim = 0;    // the value of Event::aim
  MediaStack media{};  // the media in which the photon starts
};

// The numbers of the pairs of random numbers for a photon's start, which paths do not draw.
inline constexpr uint32_t source_pair = 0, start_pair = 1, heading_pair = 2, side_pair = 3;
// For the photons of a sample, photons_of | the sample's number takes the place of a pixel.
inline constexpr uint32_t photons_of = 0x80000000u;

// The materials whose media surround each light, outermost first; infinitely distant lights are in none.
// Light i has two lists: 2i before its surface, and 2i + 1 behind it, where its own material may be one more
// medium.
std::vector<std::vector<int>> media_of_lights(const Tracer& tracer);

class PhotonSources {
 public:
  // `tracer` must outlive it.
  explicit PhotonSources(const Tracer& tracer);

  // Chooses the start of a photon. `pair`: returns the two random numbers of a use.
  PhotonSource draw(const std::function<Vec2(uint32_t)>& pair) const;
  const PhotonSettings& settings() const { return settings_; }

 private:
  const Tracer& tracer_;
  PhotonSettings settings_;
  double around_;                  // the probability that a photon comes from the surroundings
  std::vector<MediaStack> media_;  // as media_of_lights() returns them
};

}  // namespace eyeray::engine::reference
