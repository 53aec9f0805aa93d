// What there is to warn of in a picture, whoever asked for it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/render/render.hpp"

namespace eyeray::render {

struct PictureQuality {
  uint32_t flags = 0;          // all SampleFlags seen …
  uint64_t flagged = 0;        // … in so many pixels
  uint64_t fireflies = 0;      // Fireflies::samples, where paths walk at random
  double clamp = 0;            // RenderOptions::clamp …
  uint64_t clamped = 0;        // … and how many samples it changed
  double noise = 0;            // RenderOptions::noise …
  double greatest_noise = 0;   // … the greatest of a pixel …
  double quiet_share = 1;      // … and the share of the pixels that have no more than was wanted
  int most_samples = 0;        // of a pixel
  std::string illegible = {};  // Legibility::warning()
};

// The quality that a render's totals show; whoever traced first hits or looked at the picture adds to it.
PictureQuality quality_of(const Scene& scene, const RenderOptions& options, const RenderTotals& totals);

// A sentence each; none where nothing is wrong.
std::vector<std::string> warnings_of(const PictureQuality& quality);

}  // namespace eyeray::render
