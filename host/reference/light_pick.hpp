// Chooses the light that a vertex of a path samples: in float64, from the formulas.
#pragma once

#include <optional>

#include "host/scene/light_choice.hpp"

namespace eyeray::engine::reference {

struct LightPick {
  size_t light;  // its number in LightChoice
  double share;  // its probability
};

// A point at which lights are sampled. `normal`: unit; empty if the surface also transmits light from behind
// it.
struct LitPoint {
  Vec3 position;
  std::optional<Vec3> normal;
};

// Chooses a light by a random number u in [0, 1). Empty if no light shines on the point.
std::optional<LightPick> pick_light(const LightChoice& choice, const LitPoint& point, double u);
// The probability that the choice picks the light.
double light_share(const LightChoice& choice, const LitPoint& point, size_t light);
// Estimate of a node's light that may arrive at the point: above 0 wherever any does.
double importance(const LightBounds& bounds, const LitPoint& point);

}  // namespace eyeray::engine::reference
