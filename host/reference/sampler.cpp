#include "host/reference/sampler.hpp"

#include <cmath>

namespace eyeray::reference {

// Each sampler's .cpp defines its own; one that is missing is a link error that bears its name.
#define X(name, number) extern const Sampler name##_sampler;
SAMPLERS(X)
#undef X

const Sampler& sampler(SamplePattern pattern) {
#define X(name, number) &name##_sampler,
  static constexpr const Sampler* samplers[] = {SAMPLERS(X)};
#undef X
  return *samplers[uint32_t(pattern)];
}

Vec2 sample_position(const ImageSettings& image, uint32_t seed, int x, int y, uint32_t index) {
  // Take the sample's cell of the n × n that the pixel is cut into, and a place in it.
  const auto n = uint32_t(std::lround(std::sqrt(image.samples)));
  const uint32_t pixel = uint32_t(y) * uint32_t(image.width) + uint32_t(x);
  const Vec2 cell(index % n, index / n);
  return (cell + sampler(image.pattern).in_cell(pixel, index, seed)) / double(n);
}

}  // namespace eyeray::reference
