// Frames whose z is a given direction: that of a surface's normal, for BSDFs.
#pragma once

#include <cmath>

#include "host/reference/emitter_sample.hpp"
#include "host/scene/shape.hpp"

namespace eyeray::engine::reference {

class LocalFrame {
 public:
  // n: unit.
  explicit LocalFrame(const Vec3& n) : n_(n) {
    const auto [s, t] = tangents(n_);
    s_ = s;
    t_ = t;
  }

  // The frame of a surface that a BSDF scatters in: x is the direction along which its microfacets are wider.
  static LocalFrame of(const SurfacePoint& point) {
    if (point.rough_axis == Vec3(0)) return LocalFrame(point.normal);
    return {point.rough_axis, glm::cross(point.normal, point.rough_axis), point.normal};
  }

  // The frame in which n is given, rotated the shortest way until its z is n: by two half turns.
  static LocalFrame turned_to(const Vec3& n) {
    const Vec3 h = glm::normalize(n + Vec3(0, 0, 1));
    return {Vec3(1, 0, 0) - 2 * h.x * h, Vec3(0, 1, 0) - 2 * h.y * h, n};
  }

  Vec3 into(const Vec3& v) const { return {glm::dot(v, s_), glm::dot(v, t_), glm::dot(v, n_)}; }
  Vec3 out_of(const Vec3& v) const { return v.x * s_ + v.y * t_ + v.z * n_; }
  // A direction towards the viewer, in this frame. If the bent normal is turned away from the viewer, the
  // direction is made edge-on.
  Vec3 seen(const Vec3& to_viewer) const {
    constexpr double least_cosine = 1e-4;
    const Vec3 o = into(to_viewer);
    if (o.z >= least_cosine) return o;
    const double across = std::hypot(o.x, o.y);
    return glm::normalize(across < 1e-6 ? Vec3(1, 0, least_cosine)
                                        : Vec3(o.x / across, o.y / across, least_cosine));
  }

 private:
  LocalFrame(const Vec3& s, const Vec3& t, const Vec3& n) : s_(s), t_(t), n_(n) {}

  Vec3 s_, t_, n_;
};

}  // namespace eyeray::engine::reference
