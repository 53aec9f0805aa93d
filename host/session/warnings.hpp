// The warnings about a picture, for any interface.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/render/render.hpp"

namespace eyeray::engine::session {

struct PictureQuality {
  uint32_t flags = 0;            // all SampleFlags seen …
  uint64_t flagged = 0;          // … and the number of flagged pixels
  uint64_t fireflies = 0;        // RenderTotals::fireflies, where paths walk at random
  double clamp = 0;              // render::RenderOptions::clamp …
  uint64_t clamped = 0;          // … and how many samples it changed
  film::Outliers outliers = {};  // RenderTotals::outliers …
  double outlier_share = 0;      // … and the share of the light that they had
  double noise = 0;              // render::RenderOptions::noise …
  double greatest_noise = 0;     // … the greatest of a pixel …
  double quiet_share = 1;        // … and the share of the pixels with no more noise than `noise`
  int most_samples = 0;          // the most that a pixel has
  std::string illegible = {};    // render::Legibility::warning()
};

// The quality of a picture of `pixels` pixels, as its totals show it. A caller that traced first hits or
// examined the picture adds its findings. `noise`, `clamp`: RenderOptions.
PictureQuality quality_of(const Scene& scene, double noise, double clamp, int64_t pixels,
                          const render::RenderTotals& totals);

// One warning for each doubt, without a position.
std::vector<Diagnostic> warnings_of(const PictureQuality& quality);
// `sentence` as a warning without a position.
Diagnostic warning(std::string sentence);

}  // namespace eyeray::engine::session
