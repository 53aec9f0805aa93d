#include "host/executors/formula_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "host/formula/formula.hpp"

namespace eyeray::engine::executors {
namespace {

// Each formula once, with the first shape that it is used by.
std::vector<const Shape*> users(const Scene& scene) {
  std::vector<const Shape*> all;
  for_each_leaf(scene, [&](const Shape& shape) {
    const FormulaUse* use = shape.formula_use();
    if (use && std::ranges::none_of(all, [&](const Shape* other) {
          const FormulaUse& known = *other->formula_use();
          return known.formula->same(*use->formula) && known.lipschitz == use->lipschitz &&
                 known.box.min == use->box.min && known.box.max == use->box.max;
        }))
      all.push_back(&shape);
  });
  return all;
}

struct Steepest {
  double slope = 0;
  Vec3 at{0.0};
};

// The steepest slope found by differences over short steps at random points. Half of the points lie near the
// steepest so far. There are fewer points if each takes long.
Steepest steepest(const FormulaUse& use) {
  constexpr int points = 20000;
  constexpr uint64_t most_iterations = 1 << 22;
  uint64_t iterations = 0;
  const Vec3 extent = (use.box.max - use.box.min) * 0.5, center = (use.box.max + use.box.min) * 0.5;
  const double step = 1e-4 * std::min({extent.x, extent.y, extent.z});
  const auto value = [&](const Vec3& p) {
    return use.formula->value(std::array{p.x, p.y, p.z}, &iterations);
  };
  const auto slope = [&](const Vec3& p) {
    Vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 offset(0);
      offset[axis] = step;
      gradient[axis] = (value(p + offset) - value(p - offset)) / (2 * step);
    }
    const Vec3 along = glm::normalize(gradient) * step;
    // Only a difference between two points can disprove a Lipschitz constant: at a crease the gradient is
    // steeper than either side.
    const double found = std::fabs(value(p + along) - value(p - along)) / (2 * step);
    return std::isfinite(found) ? found : 0;
  };
  std::mt19937_64 random(1);
  const auto uniform = [&] { return double(random() >> 11) * 0x1p-52 - 1; };
  Steepest worst;
  for (int i = 0; i < points && iterations < most_iterations; ++i) {
    // Half of the points lie anywhere, the others near the steepest point so far.
    const double reach = i % 2 == 0 ? 1 : std::ldexp(1.0, -(i / 2 % 10));
    Vec3 q = Vec3(uniform(), uniform(), uniform()) * reach;
    if (i % 2 == 1) q += (worst.at - center) / extent;
    const Vec3 p = center + extent * glm::clamp(q, -1.0, 1.0);
    if (const double here = slope(p); here > worst.slope) worst = {here, p};
  }
  return worst;
}

}  // namespace

void check_formulas(const Scene& scene) {
  for (const Shape* shape : users(scene))
    if (shape->formula_use()->lipschitz == 0) (void)shape->formula_use()->formula->straight_line();
}

std::vector<Diagnostic> doubt_lipschitz_constants(const Scene& scene) {
  std::vector<Diagnostic> warnings;
  for (const Shape* shape : users(scene)) {
    const FormulaUse& use = *shape->formula_use();
    if (!use.declared) continue;
    const Steepest found = steepest(use);
    if (found.slope <= use.lipschitz * (1 + 1e-3)) continue;
    Diagnostic& warning = warnings.emplace_back();
    warning.severity = Severity::warning;
    warning.position = shape->position;
    warning.message = fmt::format(
        "`lipschitz` is {:.4g}, but the function's slope is {:.4g} at [{:.4g}, {:.4g}, {:.4g}] in its own "
        "space: rays may pass through the surface",
        use.lipschitz, found.slope, found.at.x, found.at.y, found.at.z);
  }
  return warnings;
}

}  // namespace eyeray::engine::executors
