#include "host/raster/flat_regions.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::raster {
namespace {

// The axes of the coordinate plane in which the outline is widest.
std::array<int, 2> widest_plane(const std::vector<Vec3>& outline) {
  Vec3 area(0.0);
  for (size_t i = 0; i < outline.size(); ++i)
    area += glm::cross(outline[i] - outline[0], outline[(i + 1) % outline.size()] - outline[0]);
  area = glm::abs(area);
  if (area.x >= area.y && area.x >= area.z) return {1, 2};
  return area.y >= area.z ? std::array{2, 0} : std::array{0, 1};
}

bool convex(const std::vector<Vec3>& outline, const std::array<int, 2>& axes) {
  bool left = false, right = false;
  double turns = 0;
  const size_t n = outline.size();
  for (size_t i = 0; i < n; ++i) {
    const Vec3 a = outline[(i + 1) % n] - outline[i], b = outline[(i + 2) % n] - outline[(i + 1) % n];
    const double turn = a[axes[0]] * b[axes[1]] - a[axes[1]] * b[axes[0]];
    (turn < 0 ? right : left) = true;
    turns += std::atan2(turn, a[axes[0]] * b[axes[0]] + a[axes[1]] * b[axes[1]]);
  }
  return left != right && std::fabs(turns) < 7;  // once around is 2π
}

struct Edge {
  Vec3 from, to;  // from left to right
};

Vec3 at(const Edge& edge, double x, int axis) {
  if (x == edge.from[axis]) return edge.from;
  if (x == edge.to[axis]) return edge.to;
  return edge.from + (edge.to - edge.from) * ((x - edge.from[axis]) / (edge.to[axis] - edge.from[axis]));
}

}  // namespace

void add_region(const std::vector<std::vector<Vec3>>& outlines, std::vector<Vec3>& points,
                std::vector<std::array<uint32_t, 3>>& triangles) {
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    if (a == b || b == c || c == a) return;
    const auto first = uint32_t(points.size());
    points.insert(points.end(), {a, b, c});
    triangles.push_back({first, first + 1, first + 2});
  };
  const std::array<int, 2> axes = widest_plane(outlines[0]);
  if (outlines.size() == 1 && convex(outlines[0], axes)) {
    for (size_t i = 2; i < outlines[0].size(); ++i) add(outlines[0][0], outlines[0][i - 1], outlines[0][i]);
    return;
  }

  // Cut the area into vertical slabs at the corners. Within a slab the edges lie above each other and do not
  // cross.
  const auto [across, up] = axes;
  std::vector<Edge> edges;
  std::vector<double> ends;
  for (const auto& outline : outlines) {
    for (size_t i = 0; i < outline.size(); ++i) {
      Edge edge{outline[i], outline[(i + 1) % outline.size()]};
      if (edge.from[across] > edge.to[across]) std::swap(edge.from, edge.to);
      if (edge.from[across] < edge.to[across]) edges.push_back(edge);
      ends.push_back(outline[i][across]);
    }
  }
  const int left_axis = across, up_axis = up;
  std::ranges::sort(edges, {}, [&](const Edge& edge) { return edge.from[left_axis]; });
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<Edge> crossed;
  size_t next = 0;
  for (size_t i = 0; i + 1 < ends.size(); ++i) {
    const double left = ends[i], right = ends[i + 1], middle = (left + right) / 2;
    std::erase_if(crossed, [&](const Edge& edge) { return edge.to[left_axis] <= left; });
    while (next < edges.size() && edges[next].from[left_axis] <= left) crossed.push_back(edges[next++]);
    std::ranges::sort(crossed, {}, [&](const Edge& edge) { return at(edge, middle, left_axis)[up_axis]; });
    for (size_t k = 0; k + 1 < crossed.size(); k += 2) {
      const Vec3 a = at(crossed[k], left, left_axis), b = at(crossed[k], right, left_axis),
                 c = at(crossed[k + 1], right, left_axis), d = at(crossed[k + 1], left, left_axis);
      add(a, b, c);
      add(a, c, d);
    }
  }
}

}  // namespace eyeray::engine::raster
