// The surface where a formula is 0, in float64, in the space where its box is the cube from −1 to 1.
#pragma once

#include <optional>

#include "host/scene/shape.hpp"

namespace eyeray::engine::shapes {

class FormulaSurface {
 public:
  // `use` must outlive it.
  explicit FormulaSurface(const FormulaUse& use);

  double value(const Vec3& q) const;
  // By differences of the fourth order. The step is 1/256 for a formula with a Lipschitz constant and without
  // its own gradient, else 1e-4.
  Vec3 gradient(const Vec3& q) const;
  // The first point from `start` to `end` at which the sign differs from that at `start`. With a Lipschitz
  // constant, the values at two points exclude roots on a stretch between them. Only such stretches are
  // skipped, so no change is missed, except pairs of roots closer than 1e-8. Without a Lipschitz constant,
  // Chebyshev series replace it. The number of steps is limited, so that the search ends for any function. At
  // the limit `iteration_limit` is set, and there is no change up to s.
  struct Change {
    double s;
    double beyond;  // a point past `s` that has the other sign
    bool iteration_limit = false;
  };
  std::optional<Change> first_change(const Ray& ray, double start, double end) const;

 private:
  const FormulaUse& use_;
  Vec3 center_, extent_;
};

}  // namespace eyeray::engine::shapes
