#include "classics.hpp"

namespace eyeray::engine::classics {
namespace {

// A map of space: applies `linear`, then moves by `offset`.
struct Map {
  glm::dmat3 linear{1.0};
  Vec3 offset{0.0};
};

// The map of a child onto its parent's tip: shrinks, leans by turning y towards z, turns x towards y, and
// moves to the tip.
Map onto_tip(double scale, double turn_degrees, double lean_degrees) {
  const Vec2 turn = unit_circle(turn_degrees), lean = unit_circle(lean_degrees);
  const glm::dmat3 about_x(Vec3(1, 0, 0), Vec3(0, lean.x, lean.y), Vec3(0, -lean.y, lean.x));
  const glm::dmat3 about_z(Vec3(turn.x, turn.y, 0), Vec3(-turn.y, turn.x, 0), Vec3(0, 0, 1));
  return {scale * about_z * about_x, {0, 0, 1}};
}

struct Grower {
  const Map children[2] = {onto_tip(0.65, 90, 40), onto_tip(0.7, 230, 25)};
  const std::function<void(const Branch&)>& visit;

  void grow(const Map& map, double size, int levels) const {
    const double radius = 0.15 * size;
    visit({map.offset, map.linear[2] + map.offset, radius, 0.67 * radius});
    if (levels == 0) return;
    for (const Map& child : children)
      grow({map.linear * child.linear, map.linear * child.offset + map.offset}, 0.67 * size, levels - 1);
  }
};

uint64_t branches(int size_factor) {
  return (uint64_t{2} << size_factor) - 1;
}

std::string scene(int size_factor) {
  BatchText cones("cone", "material = \"bark\"\nopen = true\n", {"from", "to", "radius", "to_radius"});
  BatchText spheres("sphere", "material = \"bark\"\n", {"center", "radius"});
  for_each_branch(size_factor, [&](const Branch& branch) {
    cones.add(branch.foot, branch.tip, branch.radius, branch.tip_radius);
    spheres.add(branch.tip, branch.tip_radius);
  });
  return classic_stage({.eye = {4.5, 0.4, 2},
                        .target = {0, 0, 1.5},
                        .lights = {{-5, 5, 50},
                                   {30, -30, 30},
                                   {-40, -30, 20},
                                   {10, 30, 40},
                                   {-30, 40, 10},
                                   {50, 25, 20},
                                   {-10, -60, 30}}}) +
         classic_material({.name = "field", .color = {0.2, 0.7, 0.2}}) +
         classic_material({.name = "bark", .color = {0.55, 0.4, 0.2}}) +
         classic_square("field", {{{50, 50, 0}, {-50, 50, 0}, {-50, -50, 0}, {50, -50, 0}}}) + cones.text() +
         spheres.text();
}

}  // namespace

void for_each_branch(int size_factor, const std::function<void(const Branch&)>& visit) {
  Grower{.visit = visit}.grow({}, 1, size_factor);
}

const Classic tree_classic = {
    .name = "tree",
    .size_factor = 11,
    .shapes = [](int n) { return 2 * branches(n) + 2; },
    .scene = scene,
};

}  // namespace eyeray::engine::classics
