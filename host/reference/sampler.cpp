#include "host/reference/sampler.hpp"

#include "host/reference/filter.hpp"

namespace eyeray::engine::reference {

// Each sampler's .cpp defines its variable. If one is missing, the linker's error names it.
#define X(name, ...) extern const Sampler name##_sampler;
SAMPLERS(X)
#undef X

const Sampler& sampler(SamplePattern pattern) {
#define X(name, ...) &name##_sampler,
  static constexpr const Sampler* samplers[] = {SAMPLERS(X)};
#undef X
  return *samplers[uint32_t(pattern)];
}

Vec2 sample_position(const ImageSettings& image, uint32_t seed, int x, int y, uint32_t index) {
  const uint32_t pixel = uint32_t(y) * uint32_t(image.width) + uint32_t(x);
  return filtered(image, sampler(image.pattern).position(image.samples, pixel, index, seed));
}

}  // namespace eyeray::engine::reference
