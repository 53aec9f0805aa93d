// The control points of Newell's teapot.
#include "classics.hpp"

namespace eyeray::engine::classics {
namespace {

struct Ring {
  double radius;
  double z;
  double bulge = 0.56;  // offset of a quarter's inner control points, as a share of the radius
};

// Adds a surface of revolution about z, of four quarters; `side` ±1 is the direction in which the quarters go
// round.
void turn(std::vector<BezierPatch>& patches, double side, const std::array<Ring, 4>& rings) {
  for (int quarter = 0; quarter < 4; ++quarter) {
    BezierPatch patch;
    for (size_t row = 0; row < 4; ++row) {
      const auto& [r, z, bulge] = rings[row];
      patch[row] = {{{r, 0, z}, {r, side * bulge * r, z}, {bulge * r, side * r, z}, {0, side * r, z}}};
      for (Vec3& p : patch[row]) {
        for (int i = 0; i < quarter; ++i) p = {-side * p.y, side * p.x, p.z};
      }
    }
    patches.push_back(patch);
  }
}

// A section across a tube, from one side of the tube to the other.
struct Section {
  double from_x, from_z;
  double to_x, to_z;
  double reach;  // in y
};

// Adds the two halves of a tube that goes from section to section.
void tube(std::vector<BezierPatch>& patches, const Section* sections) {
  BezierPatch left, right;
  for (size_t row = 0; row < 4; ++row) {
    const auto& [xa, za, xb, zb, h] = sections[row];
    left[row] = {{{xa, 0, za}, {xa, -h, za}, {xb, -h, zb}, {xb, 0, zb}}};
    right[row] = {{{xb, 0, zb}, {xb, h, zb}, {xa, h, za}, {xa, 0, za}}};
  }
  patches.push_back(left);
  patches.push_back(right);
}

constexpr Section handle[] = {
    {-1.6, 2.025, -1.5, 2.25, 0.3}, {-2.3, 2.025, -2.5, 2.25, 0.3}, {-2.7, 2.025, -3, 2.25, 0.3},
    {-2.7, 1.8, -3, 1.8, 0.3},      {-2.7, 1.575, -3, 1.35, 0.3},   {-2.5, 1.125, -2.65, 0.9375, 0.3},
    {-2, 0.9, -1.9, 0.6, 0.3},
};
constexpr Section spout[] = {
    {1.7, 1.425, 1.7, 0.6, 0.66}, {2.6, 1.425, 3.1, 0.825, 0.66},     {2.3, 2.1, 2.4, 2.025, 0.25},
    {2.7, 2.4, 3.3, 2.4, 0.25},   {2.8, 2.475, 3.525, 2.49375, 0.25}, {2.9, 2.475, 3.45, 2.5125, 0.15},
    {2.8, 2.4, 3.2, 2.4, 0.15},
};

}  // namespace

std::vector<BezierPatch> teapot_patches() {
  std::vector<BezierPatch> all;
  turn(all, -1, {{{1.4, 2.4}, {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4}}});  // rim
  turn(all, -1, {{{1.5, 2.4}, {1.75, 1.875}, {2, 1.35}, {2, 0.9}}});                // body
  turn(all, -1, {{{2, 0.9}, {2, 0.45}, {1.5, 0.225}, {1.5, 0.15}}});
  tube(all, handle);
  tube(all, handle + 3);
  tube(all, spout);
  tube(all, spout + 3);
  turn(all, -1, {{{0, 3.15}, {0.8, 3.15, 0.5625}, {0, 2.85}, {0.2, 2.7}}});  // lid
  turn(all, -1, {{{0.2, 2.7}, {0.4, 2.55}, {1.3, 2.55}, {1.3, 2.4}}});
  turn(all, +1, {{{0, 0}, {1.425, 0}, {1.5, 0.075}, {1.5, 0.15}}});  // bottom
  return all;
}

}  // namespace eyeray::engine::classics
