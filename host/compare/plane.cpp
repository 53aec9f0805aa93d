#include "host/compare/plane.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "host/core/parallel_for.hpp"

namespace eyeray::compare {

Kernel gaussian(double sigma, int radius) {
  Kernel kernel(size_t(2 * radius + 1));
  for (int x = -radius; x <= radius; ++x) kernel[size_t(x + radius)] = std::exp(-x * x / (2 * sigma * sigma));
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

namespace {

// Of each of `width` places the sum over `taps`, each weighted, in their order. Several places at a time stay
// in registers, and compilers do them together.
void weigh(const Kernel& kernel, std::span<const double* const> taps, int width, double* sums) {
  constexpr int lanes = 8;
  int x = 0;
  for (; x + lanes <= width; x += lanes) {
    double sum[lanes] = {};
    for (size_t i = 0; i < kernel.size(); ++i)
      for (int k = 0; k < lanes; ++k) sum[k] += kernel[i] * taps[i][x + k];
    std::copy_n(sum, lanes, sums + x);
  }
  for (; x < width; ++x) {
    double sum = 0;
    for (size_t i = 0; i < kernel.size(); ++i) sum += kernel[i] * taps[i][x];
    sums[x] = sum;
  }
}

}  // namespace

Plane convolve(const Plane& plane, const Kernel& horizontal, const Kernel& vertical) {
  const int width = plane.width, height = plane.height;
  Plane rows(width, height), result(width, height);

  const int rx = int(horizontal.size() / 2);
  parallel_for(0, height, [&](int y) {
    std::vector<double> padded;
    for (int x = -rx; x < width + rx; ++x) padded.push_back(plane.at(std::clamp(x, 0, width - 1), y));
    std::vector<const double*> taps;
    for (size_t i = 0; i < horizontal.size(); ++i) taps.push_back(&padded[i]);
    weigh(horizontal, taps, width, &rows.at(0, y));
  });

  const int ry = int(vertical.size() / 2);
  parallel_for(0, height, [&](int y) {
    std::vector<const double*> taps;
    for (int i = -ry; i <= ry; ++i)
      taps.push_back(&rows.values[size_t(std::clamp(y + i, 0, height - 1)) * size_t(width)]);
    weigh(vertical, taps, width, &result.at(0, y));
  });
  return result;
}

double percentile(std::vector<double>& values, double share) {
  const double rank = std::max(0.0, std::ceil(share * double(values.size())) - 1);
  const auto at = values.begin() + std::ptrdiff_t(std::min(values.size() - 1, size_t(rank)));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace eyeray::compare
