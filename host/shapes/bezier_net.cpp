#include "host/shapes/bezier_net.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "host/scene/affine.hpp"

namespace eyeray::engine::shapes {
namespace {

constexpr double flat_enough = 0.3;
constexpr double beyond_flat = 0.2;  // twice the largest shift of a border by the derivatives' variation
constexpr double beyond_others = 1;
constexpr double speck = 2;  // BEZIER_SPECK
constexpr double smallest = 0x1p-14;
constexpr double largest_speck =
    0x1p-12;  // share of the patch; such a piece is flat to float32's last bit, wherever it has a curvature
constexpr size_t most_pieces = 4096;

using Curve = std::array<Vec3, 4>;

// The value of the curve's polar form, which is the curve itself where r = s = t.
Vec3 blossom(const Curve& c, double r, double s, double t) {
  const auto between = [](const Vec3& a, const Vec3& b, double x) { return a * (1 - x) + b * x; };
  const Vec3 a = between(c[0], c[1], r), b = between(c[1], c[2], r), d = between(c[2], c[3], r);
  return between(between(a, b, s), between(b, d, s), t);
}

Curve part(const Curve& c, double from, double to) {
  return {blossom(c, from, from, from), blossom(c, from, from, to), blossom(c, from, to, to),
          blossom(c, to, to, to)};
}

Curve row(const BezierNet& net, size_t i) {
  return {net[4 * i], net[4 * i + 1], net[4 * i + 2], net[4 * i + 3]};
}
Curve column(const BezierNet& net, size_t j) {
  return {net[j], net[4 + j], net[8 + j], net[12 + j]};
}

Vec3 slope(const Curve& c, double t) {
  const double s = 1 - t;
  return 3.0 * ((c[1] - c[0]) * (s * s) + (c[2] - c[1]) * (2 * s * t) + (c[3] - c[2]) * (t * t));
}

// The variation of a part's derivatives along u and along v, in units of the derivatives in its middle.
struct Bend {
  double along_u = 0, along_v = 0;
};

// The edges of the box around some control points of a derivative.
template <size_t n>
Vec3 spread(const std::array<Vec3, n>& values) {
  Vec3 low = values[0], high = values[0];
  for (const Vec3& v : values) {
    low = glm::min(low, v);
    high = glm::max(high, v);
  }
  return high - low;
}

Bend bend(const BezierNet& net) {
  // Map the derivatives in the middle to (1, 0, 0) and (0, 1, 0). Scale the normal to the length of the
  // shorter one, and map it to (0, 0, 1).
  const BezierPoint middle = bezier_point(net, 0.5, 0.5);
  const Vec3 normal = glm::cross(middle.along_u, middle.along_v);
  const double shorter = std::min(glm::length(middle.along_u), glm::length(middle.along_v));
  const Mat3 axes(middle.along_u, middle.along_v, normal * (shorter / glm::length(normal)));
  const double volume = glm::determinant(axes);
  const double size = std::max(glm::length(middle.along_u), glm::length(middle.along_v));
  if (!(volume > 1e-9 * size * shorter * shorter)) return {HUGE_VAL, HUGE_VAL};
  const Mat3 to_axes = glm::inverse(axes);
  std::array<std::array<Vec3, 3>, 4> by_u;  // derivatives by u, for each row
  std::array<std::array<Vec3, 3>, 4> by_v;  // derivatives by v, for each column
  for (size_t i = 0; i < 4; ++i)
    for (size_t k = 0; k < 3; ++k) {
      by_u[i][k] = to_axes * (3.0 * (net[4 * i + k + 1] - net[4 * i + k]));
      by_v[i][k] = to_axes * (3.0 * (net[4 * (k + 1) + i] - net[4 * k + i]));
    }
  Bend result;
  for (size_t i = 0; i < 4; ++i) {
    result.along_u = std::max(result.along_u, magnitude(spread(by_u[i])));
    result.along_v = std::max(result.along_v, magnitude(spread(by_v[i])));
  }
  // The variation of each derivative along the other parameter, in units of the derivative by u, is
  // proportional to the length of the piece along v, and vice versa. So halving along u does not improve a
  // piece next to an edge that is one point.
  const bool u_is_shorter = glm::length(middle.along_u) < glm::length(middle.along_v);
  for (size_t k = 0; k < 3; ++k) {
    for (const auto& derivative : {std::array{by_u[0][k], by_u[1][k], by_u[2][k], by_u[3][k]},
                                   std::array{by_v[0][k], by_v[1][k], by_v[2][k], by_v[3][k]}}) {
      const Vec3 twist = spread(derivative);
      result.along_v = std::max({result.along_v, twist.x, u_is_shorter ? twist.z : 0});
      result.along_u = std::max({result.along_u, twist.y, u_is_shorter ? 0 : twist.z});
    }
  }
  return result;
}

// The normal in the middle of a piece. If there is none, the normal of the piece's corners, or any.
Vec3 normal_of(const BezierNet& net) {
  const BezierPoint middle = bezier_point(net, 0.5, 0.5);
  for (const Vec3& normal :
       {glm::cross(middle.along_u, middle.along_v), glm::cross(net[15] - net[0], net[12] - net[3])})
    if (magnitude(normal) > 0) return unit(normal);
  return {0, 0, 1};
}

}  // namespace

BezierPoint bezier_point(const BezierNet& net, double u, double v) {
  Curve along_v, slopes;
  for (size_t i = 0; i < 4; ++i) {
    along_v[i] = blossom(row(net, i), u, u, u);
    slopes[i] = slope(row(net, i), u);
  }
  return {blossom(along_v, v, v, v), blossom(slopes, v, v, v), slope(along_v, v)};
}

BezierNet bezier_part(const BezierNet& net, const BezierRange& range) {
  BezierNet result = net;
  if (range.from.x != 0 || range.to.x != 1)
    for (size_t i = 0; i < 4; ++i) {
      const Curve c = part(row(net, i), range.from.x, range.to.x);
      std::copy(c.begin(), c.end(), result.begin() + 4 * i);
    }
  if (range.from.y != 0 || range.to.y != 1)
    for (size_t j = 0; j < 4; ++j) {
      const Curve c = part(column(result, j), range.from.y, range.to.y);
      for (size_t i = 0; i < 4; ++i) result[4 * i + j] = c[i];
    }
  return result;
}

std::vector<BezierPiece> bezier_pieces(const BezierNet& net) {
  double extent = 0;
  for (const Vec3& p : net) extent = std::max(extent, glm::length(p - net[0]));
  std::vector<BezierPiece> pieces;
  std::deque<BezierRange> waiting{{}};
  while (!waiting.empty()) {
    const BezierRange range = waiting.front();
    waiting.pop_front();
    const BezierNet here = bezier_part(net, range);

    // Halve the piece along the parameter in which it bends more, unless it is too small or there are too
    // many.
    const Bend bent = bend(here);
    const Vec2 size = range.to - range.from;
    const bool may_u = bent.along_u > flat_enough && size.x > smallest;
    const bool may_v = bent.along_v > flat_enough && size.y > smallest;
    if ((may_u || may_v) && pieces.size() + waiting.size() < most_pieces) {
      const int axis = may_u && (!may_v || bent.along_u > bent.along_v ||
                                 (bent.along_u == bent.along_v && size.x >= size.y))
                           ? 0
                           : 1;
      BezierRange low = range, high = range;
      low.to[axis] = high.from[axis] = 0.5 * (range.from[axis] + range.to[axis]);
      waiting.push_back(low);
      waiting.push_back(high);
      continue;
    }

    BezierPiece piece;
    piece.range = range;
    piece.middle = bezier_point(here, 0.5, 0.5).position;
    piece.radius = 0;
    for (const Vec3& p : here) {
      piece.radius = std::max(piece.radius, glm::length(p - piece.middle));
      piece.bounds.include(p);
    }
    piece.normal = normal_of(here);
    piece.beyond = std::max(bent.along_u, bent.along_v) <= flat_enough ? beyond_flat
                   : piece.radius <= largest_speck * extent            ? speck
                                                                       : beyond_others;
    pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace eyeray::engine::shapes
