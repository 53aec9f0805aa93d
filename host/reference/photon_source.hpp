// The sources of photons: a light, an emitting surface, or the environment, each chosen with the probability
// with which paths sample it. Positions are chosen by area, directions by the light emitted there.
#pragma once

#include <functional>

#include "host/reference/media.hpp"
#include "host/scene/photons.hpp"

namespace eyeray::engine::reference {

struct PhotonSource {
  Ray ray;
  Vec3 flux{0};        // of all photons, if each were as this one
  uint64_t light;      // its number; of the surroundings −1
  bool below = false;  // it leaves a surface against its normal
  uint64_t aim = 0;    // Event::aim
  MediaStack media{};  // that it starts in
};

// The uses of a photon's pairs of random numbers that paths do not draw.
inline constexpr uint32_t source_pair = 0, start_pair = 1, heading_pair = 2, side_pair = 3;
// In place of a pixel, with a sample's number, for its photons.
inline constexpr uint32_t photons_of = 0x80000000u;

// The materials whose media surround each light, outermost first; lights from afar stand in none. Light i has
// two lists: 2i before its surface, and 2i + 1 behind it, where its own material may be one more medium.
std::vector<std::vector<int>> media_of_lights(const Tracer& tracer);

class PhotonSources {
 public:
  // `tracer` must outlive it.
  explicit PhotonSources(const Tracer& tracer);

  // `pair`: random numbers for each use.
  PhotonSource draw(const std::function<Vec2(uint32_t)>& pair) const;
  const PhotonSettings& settings() const { return settings_; }

 private:
  const Tracer& tracer_;
  PhotonSettings settings_;
  double around_;                  // the probability that a photon comes from the surroundings
  std::vector<MediaStack> media_;  // of media_of_lights
};

}  // namespace eyeray::engine::reference
