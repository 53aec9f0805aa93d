// "rings" of Haines' databases: pyramids of six rings that interlock, of cylinders and spheres.
#pragma once

#include <functional>

#include "host/generate/classic.hpp"

namespace eyeray::generate {

// A cylinder from one point to another, and a sphere of its radius at the first.
struct Rod {
  Vec3 from;
  Vec3 to;
  int ring;  // 0 … 5
};

inline constexpr double rod_radius = 0.07412;

// All 5 n (n + 1) (2 n + 1), from the front layer backwards.
void for_each_rod(int size_factor, const std::function<void(const Rod&)>& visit);

extern const Classic rings_classic;

}  // namespace eyeray::generate
