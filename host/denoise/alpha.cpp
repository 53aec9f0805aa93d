#include "host/denoise/alpha.hpp"

#include <algorithm>

#include "host/core/parallel_for.hpp"

namespace eyeray::engine::denoise {
namespace {

// True if the pixel and those around it are wholly covered, or not at all.
bool evenly_covered(const image::Image& coverage, int x, int y) {
  const float here = *coverage.pixel(x, y);
  bool even = here == 0 || here == 1;
  for (int j = std::max(0, y - 1); j <= std::min(coverage.height() - 1, y + 1); ++j)
    for (int i = std::max(0, x - 1); i <= std::min(coverage.width() - 1, x + 1); ++i)
      even = even && *coverage.pixel(i, j) == here;
  return even;
}

}  // namespace

image::Image with_alpha(const NoisyPicture& picture, const image::Image& color,
                        const std::function<float(int x, int y)>& alpha_at) {
  image::Image result(color.width(), color.height(), 4);
  parallel_for(0, color.height(), [&](int y) {
    for (int x = 0; x < color.width(); ++x) {
      const float noisy = *picture.coverage.pixel(x, y);
      const bool even = evenly_covered(picture.coverage, x, y);
      float* const pixel = result.pixel(x, y);
      std::copy_n((even && noisy == 0 ? picture.color : color).pixel(x, y), 3, pixel);
      pixel[3] = even ? noisy : std::min(1.0f, alpha_at(x, y));
    }
  });
  return result;
}

}  // namespace eyeray::engine::denoise
