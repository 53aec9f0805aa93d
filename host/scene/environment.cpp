#include "host/scene/environment.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"
#include "host/scene/luminance.hpp"
#include "host/scene/whole_shares.hpp"

namespace eyeray::engine {

namespace {

// Divides the weights by their sum, and returns the sum. It is added in order, never by several threads.
double normalise(std::span<double> weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights) weight = sum > 0 ? weight / sum : 0;
  return sum;
}

EnvironmentCells make_cells(const image::Image& image) {
  CHECK_EQ(image.channels(), 3);
  const int width = image.width(), height = image.height();
  const auto bright = [&](int column, int row) {
    const float* samples = image.pixel(column == width ? 0 : column, std::clamp(row, 0, height - 1));
    // Light that is too weak to have a luminance still counts as light.
    const Vec3 color(samples[0], samples[1], samples[2]);
    return color == Vec3(0) ? 0 : std::max(luminance(color), 1e-300);
  };
  EnvironmentCells cells;
  cells.row_ends.resize(size_t(height) + 1);
  cells.column_ends.resize((size_t(height) + 1) * size_t(width));
  std::vector<double> rows(size_t(height) + 1);
  parallel_for(0, height + 1, [&](int row) {
    std::vector<double> weights;
    for (int column = 0; column < width; ++column)
      weights.push_back(bright(column, row - 1) + bright(column + 1, row - 1) + bright(column, row) +
                        bright(column + 1, row));
    const double sum = normalise(weights);
    const double upper = M_PI * std::max(row - 0.5, 0.0) / height;
    const double lower = M_PI * std::min(row + 0.5, double(height)) / height;
    rows[size_t(row)] = sum * std::sin((upper + lower) / 2) * std::sin((lower - upper) / 2);
    whole_shares(weights, std::span(cells.column_ends).subspan(size_t(row) * size_t(width), size_t(width)));
  });
  normalise(rows);
  whole_shares(rows, cells.row_ends);
  return cells;
}

}  // namespace

EnvironmentMap::EnvironmentMap(image::Image image, double turn)
    : image_(std::move(image)), turn_(turn - std::floor(turn)), cells_(make_cells(image_)) {}

uint32_t environment_numbers(const EnvironmentMap* environment, bool lights) {
  if (!environment || !environment->cells().lit()) return 0;
  if (!lights) return choice_numbers;
  return std::clamp(uint32_t(environment->share * choice_numbers), 1u, choice_numbers - 1);
}

}  // namespace eyeray::engine
