#include "host/importers/gltf_lights.hpp"

#include <algorithm>
#include <numbers>

#include "host/scene/affine.hpp"

namespace eyeray::engine::importers {

namespace {

// Factor for the intensity of lights: surfaces in glTF scatter 1/π of the arriving light, ours all of it.
constexpr double unit_of_light = 1 / std::numbers::pi;
constexpr double quarter_turn = std::numbers::pi / 2;
// Least width of the border of a spot light's cone, in radians; lights/spot.cpp requires a little less.
constexpr double least_border = 2e-5;

// The spot light of a node: it shines along −z. Angles out of range are clamped, so it stays a spot light.
SpotLight spot_light(const GltfObject& light, const Mat4& world, const Vec3& intensity,
                     GltfBreaches& breaches) {
  const auto cone = light.object("spot");
  const double inner = cone ? cone->number("innerConeAngle", 0) : 0;
  const double outer = cone ? cone->number("outerConeAngle", quarter_turn / 2) : quarter_turn / 2;
  // Allow for a quarter turn in float32, which is a little larger.
  if (!cone || !(inner >= 0 && inner < outer && outer <= quarter_turn + 1e-6))
    breaches.add("spot lights whose angles do not grow from 0 to a quarter turn, clamped", light.location());
  if (outer >= 0 && outer < least_border)
    breaches.add("spot lights whose outerConeAngle is too small to light anything, set to 0.00002",
                 light.location());
  const double border = std::clamp(outer, least_border, quarter_turn);
  return {.position = Vec3(world[3]),
          .direction = -unit(Vec3(world[2])),
          .intensity = intensity,
          .inner = std::clamp(inner, 0.0, border - least_border),
          .outer = border};
}

}  // namespace

void add_gltf_light(const GltfObject& source, const Mat4& world, GltfLeftOut& left_out,
                    GltfBreaches& breaches, ImportedScene& scene) {
  const std::string type = source.text("type");
  const std::vector<double> color = source.numbers("color", {1, 1, 1});
  const double intensity = source.number("intensity", 1);
  const Vec3 arriving = Vec3(color[0], color[1], color[2]) * intensity * unit_of_light;
  const bool right = intensity >= 0 && *std::ranges::min_element(color) >= 0 && magnitude(arriving) < 1e12;
  if (!right) source.fail("has an intensity that is out of range");
  if (*std::ranges::max_element(color) > 1)
    breaches.add("colours of lights above 1, used unchanged", source.location());
  if (source.has("spot") && type != "spot")
    breaches.add("cones of lights that are not spot lights, left out", source.location());
  if (source.has("range")) left_out.add("ranges of lights");
  if (source.has("range") && !(source.number("range", 0) > 0))
    breaches.add("ranges of lights that are not above 0", source.location());
  if (type == "directional") {
    scene.lights.push_back(DirectionalLight{unit(Vec3(world[2])), arriving});
  } else if (type == "point") {
    scene.lights.push_back(PointLight{.position = Vec3(world[3]), .intensity = arriving});
  } else if (type == "spot") {
    scene.lights.push_back(spot_light(source, world, arriving, breaches));
  } else {
    source.fail("has a type that glTF does not define");
  }
}

}  // namespace eyeray::engine::importers
