// The positions of samples in a pixel, in float64. A sampler is one .cpp here, one .glsl in shaders/samplers
// and one row in samplers/rows.h.
#pragma once

#include <string_view>

#include "host/scene/sampler.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::reference {

struct Sampler {
  std::string_view manual;  // Markdown
  // The position of sample `index` of `samples` in its pixel; both coordinates are in [0, 1). `pixel`:
  // counted along the rows.
  Vec2 (*position)(int samples, uint32_t pixel, uint32_t index, uint32_t seed);
  // The random numbers of a path, a pair for each use (listed in path_sample.hpp): each in [0, 1), a multiple
  // of 2^-24.
  Vec2 (*pair)(uint32_t pixel, uint32_t index, uint32_t pair, uint32_t seed);
};

const Sampler& sampler(SamplePattern pattern);

// The position of sample `index` of pixel (x, y), by pattern and filter, in pixels from the pixel's top left
// corner.
Vec2 sample_position(const ImageSettings& image, uint32_t seed, int x, int y, uint32_t index);

}  // namespace eyeray::engine::reference
