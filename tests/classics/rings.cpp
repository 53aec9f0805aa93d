#include <array>
#include <cmath>

#include "classics.hpp"

namespace eyeray::engine::classics {
namespace {

// Distance from one layer of rings to the next, 1 / sin 22.5°.
const double layer = std::sqrt(4 + 2 * std::sqrt(2.0));

// The corners of the six rings, five for each ring. One ring lies flat, and five stand around it.
std::array<Vec3, 30> corners() {
  std::array<Vec3, 30> all;
  for (size_t j = 0; j < 5; ++j) {
    const Vec3 flat = Vec3(unit_circle(72.0 * double(j)), 0) / (1 + rod_radius);
    const Vec3 upright = Vec3(flat.x, flat.y, 2 * flat.y) / Vec3(1, std::sqrt(5.0), std::sqrt(5.0));
    all[j] = flat;
    for (size_t ring = 1; ring < 6; ++ring) {
      const Vec2 turn = unit_circle(36.0 * (2 * double(ring) - 1));
      all[5 * ring + j] = {turn.x * upright.x - turn.y * upright.y, turn.y * upright.x + turn.x * upright.y,
                           upright.z};
    }
  }
  return all;
}

uint64_t rods(int n) {
  return 5 * uint64_t(n) * uint64_t(n + 1) * uint64_t(2 * n + 1);
}

std::string scene(int size_factor) {
  constexpr std::string_view names[6] = {"red", "green", "blue", "cyan", "magenta", "yellow"};
  constexpr Vec3 colors[6] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {1, 1, 0}};
  std::string text = classic_stage({.eye = {-1, -layer, 0.5},
                                    .target = {-1, 1 - layer, 0.5},
                                    .lights = {{3, -layer, 3}, {-4, -layer, 1}, {2, -layer, -4}}}) +
                     classic_material({.name = "wall", .color = Vec3(1)});
  std::vector<BatchText> cylinders, spheres;
  for (int ring = 0; ring < 6; ++ring) {
    text += classic_material(
        {.name = names[ring], .color = colors[ring], .diffuse = 0.5, .reflectance = 0.2, .specular = 0.3});
    const std::string common = fmt::format("material = \"{}\"\nradius = {}\n", names[ring], rod_radius);
    cylinders.emplace_back("cylinder", common + "open = true\n", std::vector<std::string_view>{"from", "to"});
    spheres.emplace_back("sphere", common, std::vector<std::string_view>{"center"});
  }

  const double y = layer * (size_factor + 1);
  const double reach =
      1.01 * (y + layer) * (std::sqrt(2.0) - 1);  // spans the whole picture and a little more
  text += classic_square("wall", {{{reach - 1, y, reach + 0.5},
                                   {-reach - 1, y, reach + 0.5},
                                   {-reach - 1, y, -reach + 0.5},
                                   {reach - 1, y, -reach + 0.5}}});
  for_each_rod(size_factor, [&](const Rod& rod) {
    cylinders[size_t(rod.ring)].add(rod.from, rod.to);
    spheres[size_t(rod.ring)].add(rod.from);
  });
  for (const BatchText& batch : cylinders) text += batch.text();
  for (const BatchText& batch : spheres) text += batch.text();
  return text;
}

}  // namespace

void for_each_rod(int size_factor, const std::function<void(const Rod&)>& visit) {
  const std::array<Vec3, 30> all = corners();
  for (int depth = 0; depth < size_factor; ++depth) {
    for (int row = 0; row <= depth; ++row) {
      for (int column = 0; column <= depth; ++column) {
        const Vec3 at(2 * column - depth, layer * (depth + 1), 2 * row - depth);
        for (size_t i = 0; i < all.size(); ++i)
          visit({all[i] + at, all[i % 5 == 0 ? i + 4 : i - 1] + at, int(i / 5)});
      }
    }
  }
}

const Classic rings_classic = {
    .name = "rings",
    .size_factor = 7,
    .shapes = [](int n) { return 2 * rods(n) + 2; },
    .scene = scene,
};

}  // namespace eyeray::engine::classics
