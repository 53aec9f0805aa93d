#include "host/shapes/bezier_clipping.hpp"

#include <algorithm>
#include <cmath>

#include "host/scene/affine.hpp"

namespace eyeray::engine::shapes {
namespace {

// Limits on the cuts of one search. Beyond many_cuts a ray runs along the patch.
constexpr int most_cuts = 5000, many_cuts = 1000;
constexpr double small = 1e-13;  // the size of a small patch, in u and v

// The patch as the ray sees it: two distances from the ray and one along it.
struct Part {
  BezierNet net;
  BezierRange range;
};

struct Interval {
  double from, to;
};

// The interval of parameters 0 … 1 in which the hull of a polynomial's bounds comes within `room` of 0. `low`
// and `high` are its four lower and four upper bounds, at 0, 1/3, 2/3 and 1. If no parameter does, from > to.
Interval hull_at_zero(const std::array<double, 4>& low, const std::array<double, 4>& high, double room) {
  Interval found{2, -1};
  const auto include = [&](double x) { found = {std::min(found.from, x), std::max(found.to, x)}; };
  // Include the hull's points in the strip around 0, and the points where its edges cross a border of the
  // strip.
  for (size_t i = 0; i < 4; ++i) {
    if (low[i] <= room && high[i] >= -room) include(double(i) / 3);
    for (size_t k = 0; k < 4; ++k) {
      for (const double a : {low[i], high[i]}) {
        for (const double b : {low[k], high[k]}) {
          for (const double border : {room, -room}) {
            if (a > border && b < border)
              include((double(i) + (double(k) - double(i)) * ((a - border) / (a - b))) / 3);
          }
        }
      }
    }
  }
  return found;
}

class Search {
 public:
  Search(const BezierNet& net, const Ray& ray) {
    // Start at the ray's point nearest to the patch.
    Vec3 middle(0.0);
    for (const Vec3& p : net) middle += p / 16.0;
    speed_ = glm::length(ray.d);
    const Vec3 d = ray.d / speed_;
    start_ = glm::dot(middle - ray.o, d);
    const Vec3 o = ray.o + d * start_;
    const Vec3 across = unit(std::fabs(d.x) < 0.5 ? Vec3(0, -d.z, d.y) : Vec3(-d.z, 0, d.x));
    const Vec3 third = glm::cross(d, across);
    Part whole;
    double reach = 0;
    for (size_t i = 0; i < 16; ++i) {
      const Vec3 p = net[i] - o;
      whole.net[i] = {glm::dot(p, across), glm::dot(p, third), glm::dot(p, d)};
      reach = std::max(reach, magnitude(whole.net[i]));
    }
    room_ = 2e-15 * reach + 2e-16 * (magnitude(ray.o) + magnitude(middle));
    parts_.push_back(whole);
  }

  std::optional<Intersection> nearest() {
    std::optional<Intersection> best;
    for (int cuts = 0; !parts_.empty() && cuts < most_cuts; ++cuts) {
      Part part = parts_.back();
      parts_.pop_back();
      if ((best && t_of(least_z(part)) > best->t) || t_of(greatest_z(part)) <= 0) continue;
      const Vec2 before = part.range.to - part.range.from;
      if (!clip(part, 0) || !clip(part, 1)) continue;
      const Vec2 size = part.range.to - part.range.from;
      // If the search takes many cuts, the ray grazes the patch: accept a hit that is 10⁴ times less precise.
      const double blur = cuts < many_cuts ? 1 : 1e4;
      if (std::max(size.x, size.y) > small * blur && extent(part) > room_ * blur) {
        // If clipping gains little, the ray may hit the piece several times.
        if (std::max(size.x / before.x, size.y / before.y) > 0.7)
          split(part);
        else
          parts_.push_back(part);
        continue;
      }
      const Vec2 at = (part.range.from + part.range.to) * 0.5;
      const double t = t_of(bezier_point(part.net, 0.5, 0.5).position.z);
      if (t > 0 && (!best || t < best->t)) best = Intersection{.t = t, .u = at.x, .v = at.y};
    }
    // The remaining pieces cannot be hit earlier than their control points.
    double sure_until = best ? best->t : HUGE_VAL;
    for (const Part& part : parts_) sure_until = std::min(sure_until, t_of(least_z(part)));
    if (sure_until < (best ? best->t : HUGE_VAL))
      return Intersection{.t = std::max(sure_until, 0.0), .iteration_limit = true};
    return best;
  }

 private:
  double t_of(double z) const { return (start_ + z) / speed_; }
  static double least_z(const Part& part) {
    double least = HUGE_VAL;
    for (const Vec3& p : part.net) least = std::min(least, p.z);
    return least;
  }
  static double greatest_z(const Part& part) {
    double greatest = -HUGE_VAL;
    for (const Vec3& p : part.net) greatest = std::max(greatest, p.z);
    return greatest;
  }
  static double extent(const Part& part) {
    Vec3 low = part.net[0], high = part.net[0];
    for (const Vec3& p : part.net) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    return magnitude(high - low);
  }

  // Cuts off, on either side along `axis`, the part that the ray cannot hit. True if anything is left.
  bool clip(Part& part, int axis) const {
    // Distances from a line that crosses the ray in the direction in which the other parameter grows.
    const BezierNet& p = part.net;
    const size_t step = axis == 0 ? 1 : 4, other = axis == 0 ? 4 : 1;
    Vec2 line = Vec2(p[3 * other] - p[0]) + Vec2(p[15] - p[3 * step]);
    const double length = glm::length(line);
    line = length > 0 ? line / length : Vec2(1, 0);
    std::array<double, 4> low, high;
    for (size_t i = 0; i < 4; ++i) {
      low[i] = HUGE_VAL;
      high[i] = -HUGE_VAL;
      for (size_t k = 0; k < 4; ++k) {
        const Vec3& q = p[i * step + k * other];
        const double distance = line.x * q.y - line.y * q.x;
        low[i] = std::min(low[i], distance);
        high[i] = std::max(high[i], distance);
      }
    }
    const Interval kept = hull_at_zero(low, high, room_);
    if (kept.from > kept.to) return false;
    if (kept.from < 0.01 && kept.to > 0.99) return true;
    BezierRange within;
    within.from[axis] = std::clamp(kept.from, 0.0, 1.0);
    within.to[axis] = std::clamp(kept.to, 0.0, 1.0);
    restrict(part, within);
    return true;
  }

  static void restrict(Part& part, const BezierRange& within) {
    part.net = bezier_part(part.net, within);
    const Vec2 from = part.range.from, size = part.range.to - part.range.from;
    part.range = {from + size * within.from, from + size * within.to};
  }

  // Halves the part across its longer parameter. The half that begins nearer comes last, to be examined
  // first.
  void split(const Part& part) {
    const Vec2 size = part.range.to - part.range.from;
    const int axis = size.x >= size.y ? 0 : 1;
    Part halves[2] = {part, part};
    BezierRange low, high;
    low.to[axis] = high.from[axis] = 0.5;
    restrict(halves[0], low);
    restrict(halves[1], high);
    if (least_z(halves[0]) < least_z(halves[1])) std::swap(halves[0], halves[1]);
    for (const Part& half : halves) parts_.push_back(half);
  }

  double speed_;
  double start_;
  double room_;
  std::vector<Part> parts_;
};

}  // namespace

std::optional<Intersection> clip_bezier(const BezierNet& net, const Ray& ray) {
  return Search(net, ray).nearest();
}

}  // namespace eyeray::engine::shapes
