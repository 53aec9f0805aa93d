// Estimators of the same light against each other, by altered shaders. The way of finding an area light, by
// shadow rays or by paths that hit it, and the way of ending paths change the noise and not the mean. Such
// comparisons test scenes without a closed form.
#include "host/scene/integrator.hpp"
#include "host/scene/sampler.hpp"
#include "tests/support/environments.hpp"
#include "tests/support/estimate.hpp"
#include "tests/support/shader_overlay.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::test;
using executors::Backend;

namespace {

// A change of the path integrator's text.
struct Change {
  const char* from;
  const char* to;
};
using Changes = std::vector<Change>;

const Change no_found_emitters{"light = light * power_heuristic(path.density, density);",
                               "light = light * 0.0f;"};
const Change no_found_surroundings{"light = light * power_heuristic(path.density, environment_share",
                                   "light = light * 0.0f * (environment_share"};
const Change shadow_rays_alone{"power_heuristic(density, lobes.density) / density", "1.0f / density"};
const Change all_found_emitters{"light = light * power_heuristic(path.density, density);", ""};
const Change all_found_surroundings{"light = light * power_heuristic(path.density, environment_share",
                                    "light = light * max(1.0f, 0.0f * environment_share"};
const Change no_shadow_rays{"power_heuristic(density, lobes.density) / density", "0.0f"};
const Change no_roulette{"FIRST_ROULETTE 3u", "FIRST_ROULETTE 99u"};
const Change early_roulette{"FIRST_ROULETTE 3u", "FIRST_ROULETTE 0u"};
const Change unpaid_roulette{"next.throughput = next.throughput / survival",
                             "next.throughput = next.throughput"};

Estimate estimated(const Scene& scene, const Changes& changes) {
  const TemporaryFolder folder;
  std::string text = own_shader("integrators/path.glsl");
  for (const Change& change : changes) text = replaced(text, change.from, change.to);
  lay_shader(folder.path(), "integrators/path.glsl", text);
  executors::ExecutorOptions options;
  options.shader_folder = folder.path();
  return estimate(scene, Backend::gpu, options);
}

// The difference of two estimates in standard errors.
double apart(const Estimate& a, const Estimate& b) {
  return std::abs(a.mean - b.mean) / std::hypot(a.error, b.error);
}

void check_all(const Scene& scene, const std::vector<std::pair<const char*, Changes>>& estimators) {
  const Estimate usual = estimated(scene, {});
  for (const auto& estimator : estimators) {
    const char* const name = estimator.first;
    const Changes& changes = estimator.second;
    const Estimate other = estimated(scene, changes);
    CAPTURE(name);
    CAPTURE(usual.mean);
    CAPTURE(other.mean);
    CAPTURE(other.error);
    // Otherwise the comparison below could not fail.
    CHECK(std::hypot(usual.error, other.error) < 0.005 * usual.mean);
    CHECK(other.mean != usual.mean);
    // At five standard errors, one in a million and a half fails by chance.
    CHECK(apart(usual, other) < 5);
  }
}

// A glossy floor in a corner of two walls, seen around a point near them; a block stands in front of the area
// lights.
Scene corner() {
  Scene scene = one_pixel({0.4, 0.9, 0.5}, {0, 0, 0});
  scene.image = {.width = 8, .height = 8, .samples = 4096, .pattern = SamplePattern::sobol};
  scene.camera.projection = cameras::make_projection(PerspectiveCamera{.fov_degrees = 1e-3});
  scene.render.integrator = IntegratorType::path;
  scene.render.max_depth = 12;
  const int white = add(scene, make_phong({.diffuse = gray(0.8)}));
  add(scene, make_plane({0, 0, 0}, {0, 1, 0}), add(scene, make_principled({.color = gray(0.6)})));
  add(scene, make_plane({-0.5, 0, 0}, {1, 0, 0}), white);
  add(scene, make_plane({0, 0, -0.6}, {0, 0, 1}), white);
  add(scene, make_box({0.1, 0.2, 0.05}, {0.3, 0.5, 0.3}), white);
  return scene;
}

int emissive(Scene& scene, double radiance) {
  return add(scene, make_phong({.diffuse = gray(0), .emission = gray(radiance)}));
}

}  // namespace

TEST_CASE("shadow rays alone, paths alone and both agree for area lights of every form") {
  Scene scene = corner();
  add(scene, make_sphere({1, 1.4, 0.2}, 0.4), emissive(scene, 2));
  add(scene, make_disk({-0.1, 1.4, 0.4}, {0.1, -1, 0}, 0.4), emissive(scene, 3));
  add(scene, make_parallelogram({-0.4, 0.9, -0.2}, {0.6, 0, 0}, {0, 0.3, 0.5}), emissive(scene, 2));
  check_all(scene, {{"shadow rays alone", {no_found_emitters, shadow_rays_alone}},
                    {"paths alone", {all_found_emitters, no_shadow_rays}},
                    {"no roulette", {no_roulette}},
                    {"roulette from the first vertex on", {early_roulette}}});
}

TEST_CASE("shadow rays alone, paths alone and both agree for an environment with a bright region") {
  Scene scene = corner();
  scene.environment = environment(32, 16, [](const Vec3& d) {
    return Vec3(0.5 + 4 * std::pow(std::max(0.0, glm::dot(d, glm::normalize(Vec3(1, 1, 0.5)))), 20));
  });
  check_all(scene, {{"shadow rays alone", {no_found_surroundings, shadow_rays_alone}},
                    {"paths alone", {all_found_surroundings, no_shadow_rays}},
                    {"no roulette", {no_roulette}}});
}

TEST_CASE("the comparison detects roulette that does not weight its survivors") {
  Scene scene = corner();
  add(scene, make_sphere({1, 1.4, 0.2}, 0.4), emissive(scene, 2));
  CHECK(apart(estimated(scene, {}), estimated(scene, {early_roulette, unpaid_roulette})) > 5);
}
