// The warnings about a picture, for any interface.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/render/render.hpp"

namespace eyeray::engine::session {

struct PictureQuality {
  uint32_t flags = 0;          // all SampleFlags seen …
  uint64_t flagged = 0;        // … in so many pixels
  uint64_t fireflies = 0;      // RenderTotals::fireflies, where paths walk at random
  double clamp = 0;            // render::RenderOptions::clamp …
  uint64_t clamped = 0;        // … and how many samples it changed
  double noise = 0;            // render::RenderOptions::noise …
  double greatest_noise = 0;   // … the greatest of a pixel …
  double quiet_share = 1;      // … and the share of the pixels that have no more than was wanted
  int most_samples = 0;        // of a pixel
  std::string illegible = {};  // render::Legibility::warning()
};

// The quality that a render's totals show, of so many pixels; whoever traced first hits or examined the
// picture adds to it. `noise`, `clamp`: RenderOptions.
PictureQuality quality_of(const Scene& scene, double noise, double clamp, int64_t pixels,
                          const render::RenderTotals& totals);

// One for each doubt, without a position.
std::vector<Diagnostic> warnings_of(const PictureQuality& quality);
// A sentence as such a warning.
Diagnostic warning(std::string sentence);

}  // namespace eyeray::engine::session
