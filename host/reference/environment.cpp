#include "host/reference/environment.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "host/scene/whole_shares.hpp"

namespace eyeray::engine::reference {

namespace {

// The position of a direction in the picture, as a column and a row. The column is counted from the centre of
// the first one, and is in [−½, width − ½). The row is counted likewise, with half a row at each pole.
Vec2 position_of(const EnvironmentMap& environment, const Vec3& d) {
  const double u = 0.5 + std::atan2(d.x, -d.z) / (2 * M_PI) + environment.turn();
  const double polar = std::acos(std::clamp(d.y, -1.0, 1.0));
  return {(u - std::floor(u)) * environment.width() - 0.5, polar / M_PI * environment.height() - 0.5};
}

struct Cell {
  int column, row;
};

Cell cell_at(const EnvironmentMap& environment, const Vec2& position) {
  const int column = int(std::floor(position.x)), row = int(std::floor(position.y)) + 1;
  return {(column + environment.width()) % environment.width(), std::min(row, environment.height())};
}

// The cosines of the angles from the axis up to a row's upper and lower border.
Vec2 cosines(const EnvironmentMap& environment, int row) {
  const double height = environment.height();
  return {std::cos(M_PI * std::max(row - 0.5, 0.0) / height),
          std::cos(M_PI * std::min(row + 0.5, height) / height)};
}

std::span<const uint32_t> column_ends(const EnvironmentMap& environment, int row) {
  const auto width = size_t(environment.width());
  return std::span(environment.cells().column_ends).subspan(size_t(row) * width, width);
}

// The random numbers, from `begin` to below `end`, that choose one row or column.
struct Stretch {
  uint32_t begin, end;
  double share() const { return (end - begin) / double(choice_numbers); }
};
Stretch stretch(std::span<const uint32_t> ends, int i) {
  return {i == 0 ? 0 : ends[size_t(i) - 1], ends[size_t(i)]};
}

double density(const EnvironmentMap& environment, const Cell& cell) {
  const Vec2 heights = cosines(environment, cell.row);
  return stretch(environment.cells().row_ends, cell.row).share() *
         stretch(column_ends(environment, cell.row), cell.column).share() /
         (2 * M_PI / environment.width() * (heights.x - heights.y));
}

// The row or column i that a random number chooses, and the relative position of that number in the Stretch
// of i.
struct Choice {
  int i;
  double within;
};
Choice choose(std::span<const uint32_t> ends, double u) {
  const auto number = uint32_t(u * choice_numbers);
  const auto i = int(std::ranges::upper_bound(ends, number) - ends.begin());
  const auto [begin, end] = stretch(ends, i);
  return {i, (number - begin + 0.5) / (end - begin)};
}

}  // namespace

Vec3 environment_radiance(const EnvironmentMap& environment, const Vec3& d) {
  const Vec2 at = position_of(environment, d);
  const auto [right, lower] = cell_at(environment, at + Vec2(1, 0));
  const int left = (right + environment.width() - 1) % environment.width();
  const int below = std::min(lower, environment.height() - 1), above = std::max(lower - 1, 0);
  const double x = at.x - std::floor(at.x), y = at.y - std::floor(at.y);
  return (1 - y) * ((1 - x) * environment.texel(left, above) + x * environment.texel(right, above)) +
         y * ((1 - x) * environment.texel(left, below) + x * environment.texel(right, below));
}

EnvironmentSample sample_environment(const EnvironmentMap& environment, const Vec2& u) {
  const Choice row = choose(environment.cells().row_ends, u.y);
  const Choice column = choose(column_ends(environment, row.i), u.x);
  const Vec2 heights = cosines(environment, row.i);
  const double y = glm::mix(heights.x, heights.y, row.within);
  const double across = std::sqrt(std::max(0.0, 1 - y * y));
  const double turns = (column.i + 0.5 + column.within) / environment.width() - environment.turn() - 0.5;
  return {{std::sin(2 * M_PI * turns) * across, y, -std::cos(2 * M_PI * turns) * across},
          density(environment, {column.i, row.i})};
}

double environment_density(const EnvironmentMap& environment, const Vec3& d) {
  return density(environment, cell_at(environment, position_of(environment, d)));
}

}  // namespace eyeray::engine::reference
