#include "host/compare/paired_sums.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::compare {

namespace {

struct Sums {
  Vec3 difference{0.0}, squares{0.0}, reference{0.0};

  void add(const Sums& other) {
    difference += other.difference;
    squares += other.squares;
    reference += other.reference;
  }
};

Sums sums_of(const Frame& value, const Frame& reference, const Rect& tile) {
  const size_t width = size_t(reference.area.width),
               each = reference.samples.size() / size_t(reference.area.pixels());
  Sums sums;
  for (int y = tile.y; y < tile.y + tile.height; ++y) {
    const size_t begin = (size_t(y) * width + size_t(tile.x)) * each;
    for (size_t i = begin; i < begin + size_t(tile.width) * each; ++i) {
      const Vec3 r(reference.samples[i].color), d = Vec3(value.samples[i].color) - r;
      sums.add({d, d * d, glm::abs(r)});
    }
  }
  return sums;
}

// The largest number of the tile's pixels whose points lie within `distance` of one pixel's point. Each pixel
// is tried as that one. If there are many, an even selection is tried: neighbours have nearly equal numbers.
double most_near(const Frame& frame, const Rect& tile, double distance) {
  constexpr int sampled_along = 16;
  std::vector<Vec3> positions;
  const auto each_position = [&](int step_x, int step_y, const auto& visit) {
    for (int y = tile.y; y < tile.y + tile.height; y += step_y)
      for (int x = tile.x; x < tile.x + tile.width; x += step_x)
        if (const FirstHit& hit = frame.first_hit(x, y); hit.primitive >= 0) visit(hit.position);
  };
  each_position(1, 1, [&](const Vec3& position) { positions.push_back(position); });
  int64_t most = 1;
  const auto step = [&](int size) { return (size + sampled_along - 1) / sampled_along; };
  each_position(step(tile.width), step(tile.height), [&](const Vec3& from) {
    most = std::max<int64_t>(most, std::ranges::count_if(positions, [&](const Vec3& position) {
                               return glm::length(position - from) < distance;
                             }));
  });
  return double(most);
}

}  // namespace

PairedSum worst_paired_sum(const Frame& value, const Frame& reference, double shared) {
  const Rect& area = reference.area;
  const auto along = [](int size) { return (size + paired_tile - 1) / paired_tile; };
  const double count = 3.0 * (along(area.width) * along(area.height) + 1);
  const double errors = std::sqrt(2 * std::log(2 * count / paired_false_alarms));

  PairedSum worst{{}, 0, 0, 1};
  const auto look_at = [&](const Rect& tile, const Sums& sums) {
    const double of_one_cause = shared > 0 ? most_near(reference, tile, shared) : 1;
    for (int c = 0; c < 3; ++c) {
      if (sums.difference[c] == 0) continue;
      const double allowed =
          paired_rounding * sums.reference[c] + errors * std::sqrt(of_one_cause * sums.squares[c]);
      const double scale = std::max(sums.reference[c], 1e-300);
      const PairedSum sum{{area.x + tile.x, area.y + tile.y, tile.width, tile.height},
                          c,
                          std::abs(sums.difference[c]) / scale,
                          allowed / scale};
      // Written so that a NaN counts as the worst.
      if (!(sum.excess() <= worst.excess())) worst = sum;
    }
  };
  Sums all;
  for (int y = 0; y < area.height; y += paired_tile) {
    for (int x = 0; x < area.width; x += paired_tile) {
      const Rect tile{x, y, std::min(paired_tile, area.width - x), std::min(paired_tile, area.height - y)};
      const Sums sums = sums_of(value, reference, tile);
      look_at(tile, sums);
      all.add(sums);
    }
  }
  look_at({0, 0, area.width, area.height}, all);
  return worst;
}

}  // namespace eyeray::engine::compare
