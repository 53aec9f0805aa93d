#include "host/compare/plane.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <span>

#include "host/core/parallel_for.hpp"

namespace eyeray::engine::compare {

Kernel gaussian(double sigma, int radius) {
  Kernel kernel(size_t(2 * radius + 1));
  for (int x = -radius; x <= radius; ++x) kernel[size_t(x + radius)] = std::exp(-x * x / (2 * sigma * sigma));
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

namespace {

// Two numbers in one register, by an extension of GCC and Clang.
using Pair = double __attribute__((vector_size(16)));

Pair load(const double* from) {
  Pair pair;
  std::memcpy(&pair, from, sizeof pair);
  return pair;
}

// Writes `width` sums of the `taps`, weighted by `kernel` and added in their order.
void weigh(const Kernel& kernel, std::span<const double* const> taps, int width, double* sums) {
  int x = 0;
  for (; x + 8 <= width; x += 8) {
    Pair sum[4] = {};
    for (size_t i = 0; i < kernel.size(); ++i) {
      const double* const from = taps[i] + x;
      sum[0] += kernel[i] * load(from);
      sum[1] += kernel[i] * load(from + 2);
      sum[2] += kernel[i] * load(from + 4);
      sum[3] += kernel[i] * load(from + 6);
    }
    std::memcpy(sums + x, sum, sizeof sum);
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

}  // namespace eyeray::engine::compare
