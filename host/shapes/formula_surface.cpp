#include "shapes/formula_surface.hpp"

#include <cmath>

#include "formula/formula.hpp"

namespace eyeray {

namespace {

constexpr double difference = 1e-4;
// Lengths in the cube: pairs of roots closer than this are not seen, and a root is known to that.
constexpr double least_gap = 1e-8;
constexpr double least_width = 1e-14;
// The search gives up after so many values: along a surface that is flat on the ray, none ends.
constexpr int most_values = 400000;

// Looks through a segment, from its start on.
class Search {
 public:
  // `rate`: how fast f can change along the ray; `unit`: by how much a length of 1 changes the ray's
  // parameter.
  Search(const FormulaSurface& surface, const Ray& ray, double rate, double unit)
      : surface_(surface), ray_(ray), rate_(rate), unit_(unit) {}

  struct Sample {
    double s, f;
  };
  Sample sample(double s) {
    ++values_;
    return {s, surface_.value(ray_.o + ray_.d * s)};
  }

  using Change = FormulaSurface::Change;
  std::optional<Change> between(const Sample& a, const Sample& b, bool inside) {
    const bool changes = (b.f < 0) != inside;
    if (!changes && (std::fabs(a.f) + std::fabs(b.f) > rate_ * (b.s - a.s) || std::isnan(a.f + b.f)))
      return std::nullopt;
    const double width = (b.s - a.s) / unit_;
    if (width < least_gap) return changes ? std::optional(Change{narrow(a, b, inside)}) : std::nullopt;
    if (values_ > most_values) return Change{a.s, true};
    const Sample middle = sample(0.5 * (a.s + b.s));
    if (const auto left = between(a, middle, inside)) return left;
    return (middle.f < 0) == inside ? between(middle, b, inside) : std::nullopt;
  }

 private:
  double narrow(Sample a, Sample b, bool inside) {
    for (int i = 0; i < 60 && (b.s - a.s) / unit_ > least_width; ++i) {
      const Sample middle = sample(0.5 * (a.s + b.s));
      ((middle.f < 0) == inside ? a : b) = middle;
    }
    return 0.5 * (a.s + b.s);
  }

  const FormulaSurface& surface_;
  const Ray& ray_;
  double rate_, unit_;
  int values_ = 0;
};

}  // namespace

FormulaSurface::FormulaSurface(const FormulaUse& use)
    : use_(use), center_((use.box.max + use.box.min) * 0.5), extent_((use.box.max - use.box.min) * 0.5) {}

double FormulaSurface::value(const Vec3& q) const {
  const Vec3 p = center_ + extent_ * q;
  return use_.formula->value(std::array{p.x, p.y, p.z});
}

Vec3 FormulaSurface::gradient(const Vec3& q) const {
  Vec3 gradient(0);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 step(0);
    step[axis] = difference;
    gradient[axis] =
        (8 * (value(q + step) - value(q - step)) - (value(q + step * 2.0) - value(q - step * 2.0))) /
        (12 * difference);
  }
  return gradient;
}

std::optional<FormulaSurface::Change> FormulaSurface::first_change(const Ray& ray, double start,
                                                                   double end) const {
  Search search(*this, ray, use_.lipschitz * glm::length(extent_ * ray.d), 1 / glm::length(ray.d));
  const Search::Sample first = search.sample(start);
  return search.between(first, search.sample(end), first.f < 0);
}

}  // namespace eyeray
