#include "host/reference/facets.hpp"

#include <cmath>

namespace eyeray::engine::reference {

double Facets::density(const Vec3& h) const {
  const double x = widths_.x, y = widths_.y;
  const double cos_squared = h.z * h.z;
  const double slope = x == y ? (h.x * h.x + h.y * h.y) / cos_squared / (x * x)
                              : (h.x * h.x / (x * x) + h.y * h.y / (y * y)) / cos_squared;
  return 1 / (M_PI * x * y * cos_squared * cos_squared * (1 + slope) * (1 + slope));
}

double Facets::lambda(const Vec3& w) const {
  const double x = widths_.x, y = widths_.y;
  const double slope = x == y ? x * x * ((w.x * w.x + w.y * w.y) / (w.z * w.z))
                              : (x * x * w.x * w.x + y * y * w.y * w.y) / (w.z * w.z);
  return (std::sqrt(1 + slope) - 1) / 2;
}

Vec3 Facets::normal(const Vec3& o, const Vec2& u) const {
  const Vec3 stretch(widths_, 1);
  const Vec3 v = glm::normalize(stretch * o);
  const double z = 1 - u.y * (1 + v.z);
  const double radius = std::sqrt(std::max(0.0, 1 - z * z)), turn = 2 * M_PI * u.x;
  return glm::normalize(stretch * (v + Vec3(radius * std::cos(turn), radius * std::sin(turn), z)));
}

Facets::Once Facets::once(const Vec3& w) const {
  constexpr int points = 64;
  constexpr double golden = 0.6180339887498949;
  Once sum;
  for (int n = 0; n < points; ++n) {
    const double turn = (n + 0.5) * golden;
    const Vec3 h = normal(w, {turn - std::floor(turn), (n + 0.5) / points});
    const double along = std::min(1.0, glm::dot(w, h));
    const Vec3 i = 2 * along * h - w;
    if (i.z <= 0) continue;
    const double share = (1 + lambda(w)) / (1 + lambda(w) + lambda(i)) / points;
    sum.all += share;
    sum.edge += share * std::pow(1 - along, 5);
  }
  return sum;
}

Facets::Reflection Facets::reflection(const Vec3& o, const Vec3& i) const {
  if (i.z <= 0) return {};
  const Vec3 h = glm::normalize(o + i);
  const double along_o = glm::dot(o, h);
  const double masking = 1 / (1 + lambda(o)), both = 1 / (1 + lambda(o) + lambda(i));
  return {density(h) * both / (4 * o.z), density(h) * masking * along_o / o.z / (4 * along_o)};
}

}  // namespace eyeray::engine::reference
