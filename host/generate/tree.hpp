// "tree" of Haines' databases: a branch bears two shorter ones, each turned its own way.
#pragma once

#include <functional>

#include "host/generate/classic.hpp"

namespace eyeray::generate {

// A cone from `foot` to `tip`, and a sphere of `tip_radius` at its tip.
struct Branch {
  Vec3 foot;
  Vec3 tip;
  double radius;
  double tip_radius;
};

// All 2ⁿ⁺¹ − 1, parents before children, depth first.
void for_each_branch(int size_factor, const std::function<void(const Branch&)>& visit);

extern const Classic tree_classic;

}  // namespace eyeray::generate
