#include <fmt/ranges.h>
#include <algorithm>
#include <set>

#include "classics.hpp"

namespace eyeray::engine::classics {
namespace {

constexpr int teeth = 36;

// Angles are whole tenths of a degree, so that top and bottom have the same corners to the last bit.
std::array<Vec3, 4 * teeth> outline(const Gear& gear, double z, int start, int direction) {
  constexpr struct {
    double radius;
    int angle;
  } tooth[4] = {{0.995, -19}, {0.995, 19}, {0.9, 30}, {0.9, 70}};
  std::array<Vec3, 4 * teeth> corners;
  for (int k = 0; k < teeth; ++k) {
    for (int m = 0; m < 4; ++m) {
      const int angle = (start + direction * (100 * k + tooth[m].angle) + 3600) % 3600;
      const Vec2 out = tooth[m].radius * gear.radius * unit_circle(angle / 10.0);
      corners[size_t(4 * k + m)] = {gear.center.x + out.x, gear.center.y + out.y, z};
    }
  }
  return corners;
}

Gear gear_at(int n, int x, int y, int z) {
  Gear gear;
  gear.radius = 1 / (n - 0.05 * (n - 1));
  gear.thickness = std::min(0.1, 1 / (2.0 * n));
  gear.center = {-1 + gear.radius + 1.9 * gear.radius * x, -1 + gear.radius + 1.9 * gear.radius * y,
                 1 - double(z) / n};
  const int shades[3] = {5 * (3 * x + 2 * y + z + 1) % 7, 3 * (3 * y + 2 * z + x + 1) % 7,
                         2 * (3 * z + 2 * x + y + 1) % 7};
  const Vec3 color = 0.01 + Vec3(shades[0], shades[1], shades[2]) / 7.0;
  gear.color = color / std::max({color.x, color.y, color.z});
  gear.glass = (4 * x + 2 * y + z) % 5 == 0;
  gear.material = fmt::format("{}-{}", gear.glass ? "glass" : "gear", fmt::join(shades, ""));
  const int start = 50 * ((x + y + z) % 2);
  gear.top = outline(gear, gear.center.z, start, +1);
  gear.bottom = outline(gear, gear.center.z - gear.thickness, start, -1);
  return gear;
}

// The package's glass scatters a fifth of the light in its colour and lets four fifths through, at each
// surface. A dielectric does not scatter, so absorption between the two faces gives it the colour instead.
std::string glass(const Gear& gear) {
  Vec3 absorption;
  for (int i = 0; i < 3; ++i)
    absorption[i] = std::max(0.0, -2 * std::log(0.8 + 0.2 * gear.color[i]) / gear.thickness);
  return fmt::format(
      "\n[[material]]\nname = \"{}\"\ntype = \"dielectric\"\nior = 1.1\nshadow = 0.8\n"
      "absorption = [{:.10g}, {:.10g}, {:.10g}]\n",
      gear.material, absorption.x, absorption.y, absorption.z);
}

std::string scene(int size_factor) {
  std::string text =
      classic_stage(
          {.eye = {-1.1, -2.1, 2.6},
           .target = {0, 0, 0},
           .lights = {{2, 4, 4}, {-2, 4, 3}, {2, -2.5, 2.5}, {-1, -4, 2}, {-1.111, -2.121, 2.626}}}) +
      classic_material(
          {.name = "ground", .color = {1, 0.85, 0.7}, .diffuse = 0.3, .reflectance = 0.6, .specular = 0.3});
  std::set<std::string> materials;
  BatchText polygons("polygon", "", {"vertices", "material"});
  for_each_gear(size_factor, [&](const Gear& gear) {
    if (materials.insert(gear.material).second)
      text += gear.glass ? glass(gear) : classic_material({.name = gear.material, .color = gear.color});
    polygons.add(gear.top, gear.material);
    const double z = gear.bottom[0].z;
    for (size_t i = 0; i < gear.top.size(); ++i) {
      const Vec3 &a = gear.top[i], &b = gear.top[(i + 1) % gear.top.size()];
      polygons.add(std::array{a, Vec3(a.x, a.y, z), Vec3(b.x, b.y, z), b}, gear.material);
    }
    polygons.add(gear.bottom, gear.material);
  });
  return text + classic_square("ground", {{{2, 2, 0}, {-2, 2, 0}, {-2, -2, 0}, {2, -2, 0}}}) +
         polygons.text();
}

}  // namespace

void for_each_gear(int size_factor, const std::function<void(const Gear&)>& visit) {
  for (int z = 0; z < size_factor; ++z) {
    for (int y = 0; y < size_factor; ++y) {
      for (int x = 0; x < size_factor; ++x) visit(gear_at(size_factor, x, y, z));
    }
  }
}

const Classic gears_classic = {
    .name = "gears",
    .size_factor = 4,
    .shapes = [](int n) { return 146 * uint64_t(n) * uint64_t(n) * uint64_t(n) + 2; },
    .scene = scene,
};

}  // namespace eyeray::engine::classics
