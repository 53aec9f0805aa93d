// "gears" of Haines' databases: a block of gears that mesh, some of glass.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "host/generate/classic.hpp"

namespace eyeray::generate {

struct Gear {
  Vec3 center;  // of its top
  double radius;
  double thickness;
  Vec3 color;
  bool glass;
  std::string material;  // its name; gears of one surface share it
  // Counter-clockwise from above at the top, clockwise at the bottom, which has the same corners below.
  std::array<Vec3, 144> top, bottom;
};

// All n³, layer below layer.
void for_each_gear(int size_factor, const std::function<void(const Gear&)>& visit);

extern const Classic gears_classic;

}  // namespace eyeray::generate
