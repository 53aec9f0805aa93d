#include "host/generate/classic.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/generate/batch_text.hpp"

namespace eyeray::engine::generate {
namespace {

std::string point(const Vec3& p) {
  return fmt::format("[{}, {}, {}]", p.x, p.y, p.z);
}

// The product as TOML, rounded to ten digits, which removes the noise behind its last digit.
std::string share(double weight, const Vec3& color) {
  if (weight == 0) return "0";
  return fmt::format("[{:.10g}, {:.10g}, {:.10g}]", weight * color.x, weight * color.y, weight * color.z);
}

}  // namespace

std::string classic_stage(const ClassicView& view) {
  const double root = std::sqrt(double(view.lights.size()));
  std::string text = fmt::format(R"([image]
width = 512
height = 512

[camera]
eye = {}
target = {}
up = {}
fov = 45.07926149

[render]
max_depth = 4
min_throughput = 0
background = [0.078, 0.361, 0.753]
ambient = {:.10g}
)",
                                 point(view.eye), point(view.target), point(view.up), 1 / (2 * root));
  for (const Vec3& light : view.lights) {
    text += fmt::format(R"(
[[light]]
type = "point"
falloff = "none"
position = {}
intensity = {:.10g}
)",
                        point(light), 1 / root);
  }
  return text;
}

std::string classic_material(const ClassicSurface& surface) {
  std::string text =
      fmt::format(R"(
[[material]]
name = "{}"
type = "phong"
diffuse = {}
ambient = {}
)",
                  surface.name, share(surface.diffuse, surface.color), share(surface.ambient, surface.color));
  if (surface.reflectance > 0) text += fmt::format("reflectance = {}\n", surface.reflectance);
  if (surface.specular > 0)
    text += fmt::format("specular = {}\nshininess = {}\n", surface.specular, surface.shininess);
  return text;
}

std::string classic_square(std::string_view material, const std::array<Vec3, 4>& corners) {
  const auto& [a, b, c, d] = corners;
  BatchText triangles("triangle", fmt::format("material = \"{}\"\n", material), {"vertices"});
  triangles.add(std::array{a, b, c});
  triangles.add(std::array{c, d, a});
  return triangles.text();
}

}  // namespace eyeray::engine::generate
