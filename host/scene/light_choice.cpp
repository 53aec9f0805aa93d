#include "host/scene/light_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "host/scene/extent.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/luminance.hpp"
#include "host/scene/scene.hpp"
#include "host/scene/whole_shares.hpp"

namespace eyeray::engine {

namespace {

// The share of the total weight that is distributed evenly.
constexpr double even_share = 1.0 / 16;
// With fewer lights, sampling a BVH costs more than it gains.
constexpr size_t least_for_bvh = 64;

// The radius of a sphere around all bounded shapes and the eye.
double reach(const Scene& scene) {
  Bounds all = extent(scene);
  all.include(scene.camera.eye);
  return glm::length(all.max - all.min) / 2;
}

// The power that a light emits into the scene. A light of a form unknown to other programs counts like a
// directional light of intensity 1.
double power(const Light& light, double radius) {
  const LightForm form = light.form();
  if (const auto* point = std::get_if<PointLight>(&form); point && point->falloff == Falloff::inverse_square)
    return 4 * M_PI * M_PI * luminance(point->intensity);
  if (const auto* spot = std::get_if<SpotLight>(&form)) {
    const double inner = std::cos(spot->inner), outer = std::cos(spot->outer);
    return 2 * M_PI * M_PI * luminance(spot->intensity) * (1 - inner + (inner - outer) / 3);
  }
  Vec3 intensity(1);
  if (const auto* point = std::get_if<PointLight>(&form)) intensity = point->intensity;
  if (const auto* directional = std::get_if<DirectionalLight>(&form)) intensity = directional->intensity;
  return M_PI * M_PI * radius * radius * luminance(intensity);
}

// The share of each weight in the sum of all; a sixteenth of the total is distributed evenly.
std::vector<double> shares_of(const std::vector<double>& weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const auto count = double(weights.size());
  std::vector<double> shares;
  for (const double weight : weights)
    shares.push_back(sum > 0 ? (1 - even_share) * weight / sum + even_share / count : 1 / count);
  return shares;
}

// The bounds of a light in the scene. Empty if the light shines everywhere alike.
std::optional<LightBounds> bounds_of(const Light& light) {
  const LightForm form = light.form();
  if (const auto* point = std::get_if<PointLight>(&form); point && point->falloff == Falloff::inverse_square)
    return LightBounds{.center = point->position};
  if (const auto* spot = std::get_if<SpotLight>(&form))
    return LightBounds{.center = spot->position,
                       .axis = spot->direction,
                       .spread = spot->inner,
                       .reach = spot->outer - spot->inner};
  return std::nullopt;
}

// The irradiance at distance 1 in the light's main direction: of two lights with equal power the one with the
// narrower cone is stronger there.
double strength(const Light& light) {
  const LightForm form = light.form();
  if (const auto* spot = std::get_if<SpotLight>(&form)) return M_PI * luminance(spot->intensity);
  if (const auto* point = std::get_if<PointLight>(&form)) return M_PI * luminance(point->intensity);
  return 0;
}
// A convex body shows a quarter of its area on average.
double strength(const Emitter& emitter) {
  return (is_flat(emitter.form) ? 1 : 0.25) * emitter.area * luminance(emitter.radiance);
}

LightBvh bvh_of(const Scene& scene, const std::vector<Emitter>& emitters) {
  std::vector<LightBounds> all;
  std::vector<double> strengths;
  for (const auto& light : scene.lights) {
    all.push_back(bounds_of(*light).value_or(LightBounds()));
    strengths.push_back(strength(*light));
  }
  for (const Emitter& emitter : emitters) {
    LightBounds bounds = bounds_of(emitter.form);
    if (emitter.side != 0) {
      bounds.both_sides = false;
      bounds.axis *= emitter.side;
    }
    all.push_back(bounds);
    strengths.push_back(strength(emitter));
  }
  const std::vector<double> shares = shares_of(strengths);
  for (size_t i = 0; i < all.size(); ++i) all[i].power = shares[i];
  for (size_t i = 0; i < scene.lights.size(); ++i)
    if (!bounds_of(*scene.lights[i])) all[i].power = 0;
  return light_bvh(all);
}

bool wants_bvh(const Scene& scene, size_t lights) {
  if (sends_photons(scene.render.integrator)) return false;
  return scene.render.light_sampler == LightSampler::bvh ||
         (scene.render.light_sampler == LightSampler::automatic && lights >= least_for_bvh);
}

}  // namespace

uint32_t LightChoice::bvh_numbers() const {
  return bvh.nodes.empty() ? 0 : choice_numbers - ends.back();
}

LightChoice light_choice(const Scene& scene) {
  LightChoice choice{.emitters = emitters(scene).sampled, .ends = {}};
  std::vector<double> weights;
  const double radius = reach(scene);
  for (const auto& light : scene.lights) weights.push_back(power(*light, radius));
  for (const Emitter& emitter : choice.emitters)
    weights.push_back((emitter.side == 0 ? 2 : 1) * M_PI * emitter.area * luminance(emitter.radiance));
  if (scene.render.light_sampler == LightSampler::uniform) std::ranges::fill(weights, 0);
  std::vector<double> shares = shares_of(weights);
  if (wants_bvh(scene, weights.size())) choice.bvh = bvh_of(scene, choice.emitters);

  // All lights in the BVH together count as one more light, the last.
  double together = 0;
  if (!choice.bvh.nodes.empty())
    for (size_t i = 0; i < shares.size(); ++i)
      if (choice.bvh.trails[i] != LightBvh::no_trail) together += std::exchange(shares[i], 0);
  shares.push_back(together);
  choice.ends.resize(shares.size());
  whole_shares(shares, choice.ends);
  choice.ends.pop_back();
  return choice;
}

}  // namespace eyeray::engine
