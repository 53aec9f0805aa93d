#include "host/shapes/formula_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/formula/formula.hpp"
#include "host/shapes/chebyshev.hpp"

namespace eyeray::engine::shapes {

namespace {

// Distances, in the cube, between the points from whose values a gradient is computed. The wide distance is
// that of docs/implicit-surfaces.md for a function with a Lipschitz constant and without its own gradient.
// The other is so small that the result is the derivative.
constexpr double wide_difference = 1.0 / 256;
constexpr double difference = 1e-4;
// Lengths in the cube. Pairs of roots closer than least_gap may be missed; a root is located to within
// least_width.
constexpr double least_gap = 1e-8;
constexpr double least_width = 1e-14;
// The search gives up after so many values: along a ray on which f is flat at 0, no search would end.
constexpr int most_values = 400000;

// Searches a segment, from its start on, by a bound of f's slope.
class LipschitzSearch {
 public:
  // `rate`: how fast f can change along the ray; `unit`: by how much a length of 1 changes the ray's
  // parameter.
  LipschitzSearch(const FormulaSurface& surface, const Ray& ray, double rate, double unit)
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
    if (width < least_gap) return changes ? std::optional(narrow(a, b, inside)) : std::nullopt;
    if (values_ > most_values) return Change{a.s, a.s, true};
    const Sample middle = sample(0.5 * (a.s + b.s));
    if (const auto left = between(a, middle, inside)) return left;
    return (middle.f < 0) == inside ? between(middle, b, inside) : std::nullopt;
  }

 private:
  Change narrow(Sample a, Sample b, bool inside) {
    for (int i = 0; i < 60 && (b.s - a.s) / unit_ > least_width; ++i) {
      const Sample middle = sample(0.5 * (a.s + b.s));
      ((middle.f < 0) == inside ? a : b) = middle;
    }
    return {0.5 * (a.s + b.s), b.s};
  }

  const FormulaSurface& surface_;
  const Ray& ray_;
  double rate_, unit_;
  int values_ = 0;
};

// Searches without a bound of f's slope: represents f piece by piece as Chebyshev series.
class SeriesSearch {
 public:
  SeriesSearch(const FormulaSurface& surface, const Ray& ray, double unit)
      : surface_(surface), ray_(ray), unit_(unit) {}

  std::optional<FormulaSurface::Change> between(double from, double to, bool inside) {
    std::array<double, ChebyshevSeries::points> values;
    for (size_t i = 0; i < values.size(); ++i)
      values[i] = value(0.5 * (from + to) + 0.5 * (to - from) * ChebyshevSeries::sample_points()[i]);
    double size = 0;
    for (const double v : values) size = std::max(size, std::fabs(v));
    largest_ = std::max(largest_, size);

    // If the series decides, there is no change of sign, or one change if the signs at the ends differ.
    const ChebyshevSeries series(values);
    const bool ends = series.ends(1e-10 * size + 1e-14 * largest_);
    const bool narrow = (to - from) / unit_ < least_gap;
    if (series.clearance() > (ends ? 1e-9 : 0.8) * size && (values[0] < 0) == inside) return std::nullopt;
    if (narrow || (ends && series.monotone())) {
      if ((values[0] < 0) == inside) return std::nullopt;
      return narrowed(from, to, inside);
    }
    if (values_ > most_values) return FormulaSurface::Change{from, from, true};

    const double middle = 0.5 * (from + to);
    if (const auto left = between(from, middle, inside)) return left;
    return between(middle, to, inside);
  }

 private:
  double value(double s) {
    ++values_;
    return surface_.value(ray_.o + ray_.d * s);
  }
  FormulaSurface::Change narrowed(double from, double to, bool inside) {
    for (int i = 0; i < 60 && (to - from) / unit_ > least_width; ++i) {
      const double middle = 0.5 * (from + to);
      ((value(middle) < 0) == inside ? from : to) = middle;
    }
    return {0.5 * (from + to), to};
  }

  const FormulaSurface& surface_;
  const Ray& ray_;
  double unit_;
  double largest_ = 0;
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
  const double apart = use_.lipschitz > 0 && !use_.formula->has_other() ? wide_difference : difference;
  Vec3 gradient(0);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 step(0);
    step[axis] = apart;
    gradient[axis] =
        (8 * (value(q + step) - value(q - step)) - (value(q + step * 2.0) - value(q - step * 2.0))) /
        (12 * apart);
  }
  return gradient;
}

std::optional<FormulaSurface::Change> FormulaSurface::first_change(const Ray& ray, double start,
                                                                   double end) const {
  const double unit = 1 / glm::length(ray.d);
  if (use_.lipschitz == 0)
    return SeriesSearch(*this, ray, unit).between(start, end, value(ray.o + ray.d * start) < 0);
  LipschitzSearch search(*this, ray, use_.lipschitz * glm::length(extent_ * ray.d), unit);
  const LipschitzSearch::Sample first = search.sample(start);
  return search.between(first, search.sample(end), first.f < 0);
}

}  // namespace eyeray::engine::shapes
