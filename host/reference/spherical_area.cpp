#include "host/reference/spherical_area.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::reference {

namespace {

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// The angle of a spherical polygon at the corner b.
double corner_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return angle_between(glm::cross(b, a), glm::cross(b, c));
}

// The component of v perpendicular to the unit vector n, normalised.
Vec3 beside(const Vec3& v, const Vec3& n) {
  return glm::normalize(v - glm::dot(v, n) * n);
}

}  // namespace

SphericalTriangle::SphericalTriangle(const std::array<Vec3, 3>& corners)
    : corners_{glm::normalize(corners[0]), glm::normalize(corners[1]), glm::normalize(corners[2])},
      angle_(corner_angle(corners_[0], corners_[1], corners_[2])),
      solid_angle_(angle_ + corner_angle(corners_[1], corners_[2], corners_[0]) +
                   corner_angle(corners_[2], corners_[0], corners_[1]) - M_PI) {}

Vec3 SphericalTriangle::direction(const Vec2& u) const {
  // The vertices B, A and C of Arvo's paper.
  const auto& [apex, first, second] = corners_;
  const double part = u.y * solid_angle_ - angle_, s = std::sin(part), t = std::cos(part);
  const double sine = std::sin(angle_), cosine = std::cos(angle_);
  const double a = t - cosine, b = s + sine * glm::dot(first, apex);
  const double q = std::clamp(((b * t - a * s) * cosine - b) / ((b * s + a * t) * sine), -1.0, 1.0);
  const Vec3 opposite = q * first + std::sqrt(1 - q * q) * beside(second, first);
  const double z = 1 - u.x * (1 - glm::dot(opposite, apex));
  return z * apex + std::sqrt(std::max(0.0, 1 - z * z)) * beside(opposite, apex);
}

SphericalRectangle::SphericalRectangle(const Vec3& corner, const Vec3& edge_u, const Vec3& edge_v) {
  const Vec3 x = glm::normalize(edge_u), y = glm::normalize(edge_v), z = glm::cross(x, y);
  low_ = {glm::dot(corner, x), glm::dot(corner, y), -std::abs(glm::dot(corner, z))};
  high_ = low_ + Vec3(glm::length(edge_u), glm::length(edge_v), 0);
  const Vec3 c01(low_.x, high_.y, low_.z), c10(high_.x, low_.y, low_.z);
  b0_ = glm::normalize(glm::cross(low_, c10)).z;
  b1_ = glm::normalize(glm::cross(high_, c01)).z;
  const double at_high = corner_angle(c10, high_, c01), at_c01 = corner_angle(high_, c01, low_),
               at_low = corner_angle(c01, low_, c10), at_c10 = corner_angle(low_, c10, high_);
  k_ = 2 * M_PI - at_c01 - at_low;
  solid_angle_ = at_c10 + at_high - k_;
}

Vec2 SphericalRectangle::position(const Vec2& u) const {
  const double turn = u.x * solid_angle_ + k_;
  // p / q is Ureña's f. His c is the cosine of the plane through x, so that x = −z c / √(1 − c²).
  const double p = std::cos(turn) * b0_ - b1_, q = std::sin(turn);
  const double across = std::sqrt(std::max(0.0, p * p - (1 - b0_) * (1 + b0_) * q * q));
  const double x = std::clamp(-low_.z * std::copysign(1.0, p) * q / across, low_.x, high_.x);
  const double d = std::hypot(x, low_.z);
  const double h0 = low_.y / std::hypot(d, low_.y), h1 = high_.y / std::hypot(d, high_.y);
  const double h = h0 + u.y * (h1 - h0);
  const double y = std::clamp(h * d / std::sqrt((1 - h) * (1 + h)), low_.y, high_.y);
  return {(x - low_.x) / (high_.x - low_.x), (y - low_.y) / (high_.y - low_.y)};
}

}  // namespace eyeray::engine::reference
