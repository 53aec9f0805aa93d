// One channel of a picture in float64, and the separable filters that picture metrics are made of.
#pragma once

#include <cstddef>
#include <vector>

namespace eyeray::engine::compare {

struct Plane {
  int width = 0;
  int height = 0;
  std::vector<double> values;  // row by row

  Plane(int w, int h) : width(w), height(h), values(size_t(w) * size_t(h)) {}
  double& at(int x, int y) { return values[size_t(y) * size_t(width) + size_t(x)]; }
  double at(int x, int y) const { return values[size_t(y) * size_t(width) + size_t(x)]; }
};

// An odd number of weights, its middle at the pixel.
using Kernel = std::vector<double>;

// exp(−x² / (2 σ²)) at −radius … radius, scaled to a sum of 1.
Kernel gaussian(double sigma, int radius);

// `plane` filtered by `horizontal`, then by `vertical`; beyond the border, the values of the border are used.
Plane convolve(const Plane& plane, const Kernel& horizontal, const Kernel& vertical);

// The least of `values` that `share` of them do not exceed; reorders them.
double percentile(std::vector<double>& values, double share);

}  // namespace eyeray::engine::compare
