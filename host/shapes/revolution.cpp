#include "host/shapes/revolution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace eyeray::engine::shapes {

namespace {

// Intersection::u: the part hit.
constexpr double side = 0;
constexpr double bottom_cap = 1;
constexpr double top_cap = 2;

std::vector<float> with_open(bool open, const std::vector<float>& parameters) {
  std::vector<float> all{open ? 1.0f : 0.0f};
  all.insert(all.end(), parameters.begin(), parameters.end());
  return all;
}

}  // namespace

double Revolution::Profile::radius(double y) const {
  return std::sqrt(std::max((square * y + 2 * linear) * y + constant, 0.0));
}

Revolution::Revolution(uint32_t kind, const Mat4& to_world, const Profile& profile, bool open,
                       std::vector<float> parameters)
    : ObjectShape(kind, to_world, with_open(open, parameters)), profile_(profile), open_(open) {}

ShapeForm Revolution::form() const {
  const auto& [square, linear, constant, bottom, top] = profile_;
  // The clip's other faces stay clear of the side.
  const double wide = 2 * extent().max.x;
  return QuadricForm{.to_world = to_world().matrix(),
                     .square = {1, -square, 1},
                     .product = Vec3(0),
                     .linear = {0, -2 * linear, 0},
                     .constant = -constant,
                     .clip = {{-wide, bottom, -wide}, {wide, top, wide}},
                     .open = open_};
}

// Tests each part by itself: the side where it is between the planes, the caps where they are within the
// side.
ObjectShape::Crossings Revolution::crossings(const Ray& ray) const {
  const Vec3 &o = ray.o, &d = ray.d;
  const auto& [square, linear, constant, bottom, top] = profile_;
  Crossings all;
  const double a = d.x * d.x + d.z * d.z - square * d.y * d.y;
  const double b = o.x * d.x + o.z * d.z - (square * o.y + linear) * d.y;
  const double c = o.x * o.x + o.z * o.z - (square * o.y + 2 * linear) * o.y - constant;
  for (const double t : quadratic_roots(a, b, c)) {
    const double y = o.y + t * d.y;
    if (y >= bottom && y <= top) all.add({t, side, 0});
  }
  if (open_ || d.y == 0) return all;
  for (const double part : {bottom_cap, top_cap}) {
    const double y = part == bottom_cap ? bottom : top;
    const double t = (y - o.y) / d.y;
    if (std::hypot(o.x + t * d.x, o.z + t * d.z) <= profile_.radius(y)) all.add({t, part, 0});
  }
  return all;
}

ObjectShape::Point Revolution::point(const Vec3& near, const Intersection& hit) const {
  const auto& [square, linear, constant, bottom, top] = profile_;
  const double distance = std::hypot(near.x, near.z);
  const double end = hit.u == bottom_cap ? bottom : top;
  const double rim = profile_.radius(end);
  // A cap without a rim is the side's tip.
  if (hit.u == side || rim == 0) {
    const Vec2 outward = distance > 0 ? Vec2(near.x, near.z) / distance : Vec2(1, 0);
    const double y = std::clamp(near.y, bottom, top);
    const double radius = profile_.radius(y);
    const Vec3 p(outward.x * radius, y, outward.y * radius);
    // Half the gradient of x² + z² − square·y² − 2·linear·y, over the radius; at an apex or a tip, its
    // limit.
    const double rise = square * y + linear;
    const double slope = radius > 0 ? rise / radius : std::copysign(std::sqrt(std::fabs(square)), rise);
    const Vec3 gradient = radius > 0 || square != 0 ? Vec3(outward.x, -slope, outward.y) : Vec3(0, -rise, 0);
    const double u = 0.5 + std::atan2(-outward.y, outward.x) / (2 * std::numbers::pi);
    return {p,
            gradient,
            {u < 1 ? u : 0, (y - bottom) / (top - bottom)},
            along_turn(p),
            (top - bottom) * Vec3(outward.x * slope, 1, outward.y * slope)};
  }
  const double up = hit.u == bottom_cap ? -1 : 1;
  const double within = distance > rim ? rim / distance : 1;
  const Vec3 p(near.x * within, end, near.z * within);
  return {p,
          {0, up, 0},
          {0.5 + 0.5 * p.x / rim, 0.5 - 0.5 * p.z / rim * up},
          {2 * rim, 0, 0},
          {0, 0, -2 * rim * up}};
}

Bounds Revolution::extent() const {
  const double widest = std::max(profile_.radius(profile_.bottom), profile_.radius(profile_.top));
  return {{-widest, profile_.bottom, -widest}, {widest, profile_.top, widest}};
}

}  // namespace eyeray::engine::shapes
