#include "host/compare/plane.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/core/parallel_for.hpp"

namespace eyeray::compare {

Kernel gaussian(double sigma, int radius) {
  Kernel kernel(size_t(2 * radius + 1));
  for (int x = -radius; x <= radius; ++x) kernel[size_t(x + radius)] = std::exp(-x * x / (2 * sigma * sigma));
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

Plane convolve(const Plane& plane, const Kernel& horizontal, const Kernel& vertical) {
  const int width = plane.width, height = plane.height;
  Plane rows(width, height), result(width, height);

  const int rx = int(horizontal.size() / 2);
  parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      for (int i = -rx; i <= rx; ++i)
        sum += horizontal[size_t(i + rx)] * plane.at(std::clamp(x + i, 0, width - 1), y);
      rows.at(x, y) = sum;
    }
  });

  const int ry = int(vertical.size() / 2);
  parallel_for(0, height, [&](int y) {
    for (int i = -ry; i <= ry; ++i) {
      const int from = std::clamp(y + i, 0, height - 1);
      for (int x = 0; x < width; ++x) result.at(x, y) += vertical[size_t(i + ry)] * rows.at(x, from);
    }
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
