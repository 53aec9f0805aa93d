#include "host/raster/possible.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace eyeray::engine::raster {
namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a.x * b.y - a.y * b.x;
}

double distance_to_edge(const Vec2& point, const Vec2& from, const Vec2& to) {
  const Vec2 along = to - from;
  const double square = glm::dot(along, along);
  const double share = square > 0 ? std::clamp(glm::dot(point - from, along) / square, 0.0, 1.0) : 0;
  return glm::length(point - from - share * along);
}

// The sign shows on which side of the line from a to b the point lies.
double side(const Vec2& point, const Vec2& a, const Vec2& b) {
  return cross(b - a, point - a);
}

bool contains(const ScreenTriangle& triangle, const Vec2& point) {
  const Vec2 a(triangle.at[0]), b(triangle.at[1]), c(triangle.at[2]);
  const double ab = side(point, a, b), bc = side(point, b, c), ca = side(point, c, a);
  if (cross(b - a, c - a) == 0) return false;
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

// The error of a driver's floats in the plane through a sliver. The plane's slope is a quotient: differences
// between products of coordinates as long as the triangle, divided by its area.
double plane_error(const ScreenTriangle& triangle, double range) {
  const Vec2 u(triangle.at[1] - triangle.at[0]), v(triangle.at[2] - triangle.at[0]), w = v - u;
  const double square = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
  return 8 * 0x1p-24 * range * square / std::fabs(cross(u, v));
}

// The slope of nearness along x and y; empty if the triangle is seen edge-on.
std::optional<Vec2> slope(const ScreenTriangle& triangle) {
  const Vec3 u = triangle.at[1] - triangle.at[0], v = triangle.at[2] - triangle.at[0];
  const double area = u.x * v.y - u.y * v.x;
  if (!(std::fabs(area) > 1e-12 * (glm::dot(Vec2(u), Vec2(u)) + glm::dot(Vec2(v), Vec2(v)))))
    return std::nullopt;
  return Vec2(u.z * v.y - u.y * v.z, u.x * v.z - u.z * v.x) / area;
}

struct Range {
  double low, high;
};

// The range of the triangle's nearness within `radius` of a point.
Range nearness_about(const ScreenTriangle& triangle, const Vec2& point, double radius, Viewer viewer) {
  const auto [least, most] = std::minmax({triangle.at[0].z, triangle.at[1].z, triangle.at[2].z});
  const std::optional<Vec2> rise = slope(triangle);
  if (!rise || std::isinf(radius)) return {least, most};
  const double middle = triangle.at[0].z + glm::dot(*rise, point - Vec2(triangle.at[0]));
  const double reach = glm::length(*rise) * radius;
  if (viewer == Viewer::rasteriser) {
    const double error = plane_error(triangle, most - least);
    return {middle - reach - error, middle + reach + error};
  }
  return {std::clamp(middle - reach, least, most), std::clamp(middle + reach, least, most)};
}

// Groups triangles into sheets (a union-find over their numbers): triangles that share an edge are joined.
struct Sheets {
  std::vector<size_t> parent;
  explicit Sheets(size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), size_t{0}); }
  size_t of(size_t i) const {
    while (parent[i] != i) i = parent[i];
    return i;
  }
  void join(size_t a, size_t b) { parent[of(a)] = of(b); }
};

// The corner of `triangle` opposite the edge from a to b; empty if the triangle lacks that edge.
std::optional<Vec2> corner_beside(const ScreenTriangle& triangle, const Vec3& a, const Vec3& b) {
  for (size_t i = 0; i < 3; ++i) {
    const Vec3 &from = triangle.at[i], &to = triangle.at[(i + 1) % 3];
    if ((from == a && to == b) || (from == b && to == a)) return Vec2(triangle.at[(i + 2) % 3]);
  }
  return std::nullopt;
}

}  // namespace

double distance(const ScreenTriangle& triangle, const Vec2& point) {
  if (contains(triangle, point)) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < 3; ++i)
    least = std::min(least, distance_to_edge(point, triangle.at[i], triangle.at[(i + 1) % 3]));
  return least;
}

Vec2 slack(const ScreenTriangle& triangle, const Vec2& center, const View& view, const Exactness& exactness,
           bool tessellated) {
  Vec2 most(exactness.snap, 0);
  const double nearest = std::max({triangle.at[0].z, triangle.at[1].z, triangle.at[2].z});
  // The bound spans the most pixels at the nearest corner.
  if (tessellated && triangle.bound > 0) most += view.shift(center.x, center.y, nearest, triangle.bound);
  most.y += exactness.depth_error * (nearest - exactness.depth_floor);
  // If a large object is close, t is only as exact as that object's coordinates.
  if (triangle.reach > 0)
    most.y += view.shift(center.x, center.y, nearest, coordinate_error * triangle.reach).y;
  return most;
}

Possible::Possible(Viewer viewer, const Vec2& center, std::span<const ScreenTriangle> triangles,
                   const View& view, const Exactness& exactness, bool tessellated) {
  tolerance_ = exactness.t;

  // The triangles that are near enough to the centre to be seen, and the ranges of their nearness.
  std::vector<const ScreenTriangle*> near;
  std::vector<double> radii;
  for (const ScreenTriangle& triangle : triangles) {
    const Vec2 most = slack(triangle, center, view, exactness, tessellated);
    if (!(distance(triangle, center) <= most.x)) continue;
    const Range range = nearness_about(triangle, center, most.x, viewer);
    pieces_.push_back({triangle.id, range.low - most.y - view.nearness_error(range.low, exactness.t),
                       range.high + most.y + view.nearness_error(range.high, exactness.t),
                       contains(triangle, center)});
    near.push_back(&triangle);
    radii.push_back(most.x);
  }

  // Join sheets: a neighbour on the other side of an edge continues the sheet beyond this triangle.
  Sheets sheets(near.size());
  std::vector<bool> ends(near.size(), false);
  for (size_t i = 0; i < near.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 &a = near[i]->at[k], &b = near[i]->at[(k + 1) % 3];
      if (distance_to_edge(center, a, b) > radii[i]) continue;
      const double own = side(near[i]->at[(k + 2) % 3], a, b);
      bool goes_on = false;
      for (size_t j = 0; j < near.size(); ++j) {
        if (j == i) continue;
        const auto beside = corner_beside(*near[j], a, b);
        if (!beside || side(*beside, a, b) * own >= 0) continue;
        goes_on = true;
        sheets.join(i, j);
      }
      if (!goes_on) ends[i] = true;
    }
  }
  struct Sheet {
    bool within = false, ends = false;
    double low = std::numeric_limits<double>::infinity();
  };
  std::vector<Sheet> all(near.size());
  for (size_t i = 0; i < near.size(); ++i) {
    Sheet& sheet = all[sheets.of(i)];
    sheet.within = sheet.within || pieces_[i].within;
    sheet.ends = sheet.ends || ends[i];
    sheet.low = std::min(sheet.low, pieces_[i].low);
  }
  for (const Sheet& sheet : all) {
    if (!sheet.within || sheet.ends) continue;
    covered_ = true;
    surely_ = std::max(surely_, sheet.low);
  }
  // Drop the pieces that are surely behind a sheet: they cannot be seen.
  std::erase_if(pieces_, [&](const Piece& piece) { return piece.high < surely_; });
}

bool Possible::allows(uint32_t id, double nearness) const {
  return std::ranges::any_of(pieces_, [&](const Piece& piece) {
    return piece.id == id && nearness >= piece.low && nearness <= piece.high;
  });
}

bool Possible::may_hide_all(double nearness) const {
  return nearness + tolerance_ * std::fabs(nearness) >= surely_;
}

bool Possible::is_within(uint32_t id) const {
  return std::ranges::any_of(pieces_, [&](const Piece& piece) { return piece.id == id && piece.within; });
}

}  // namespace eyeray::engine::raster
