// Photons that go another way than the reference's: rounding explains some of them, and nothing explains
// others.
#include "host/verify/photon_judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "host/core/error.hpp"
#include "host/executors/executors.hpp"
#include "host/loader/scene_file.hpp"
#include "host/reference/photon_map.hpp"
#include "tests/support/meshes.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

namespace {

Scene scene_of(const std::string& file) {
  return loader::load_scene(file, std::vector<loader::Override>{{"render.integrator=\"sppm\""},
                                                                {"render.photons=4096"},
                                                                {"image.samples=1"},
                                                                {"image.width=24"},
                                                                {"image.height=18"}});
}

// The twin's photons, some of them changed.
verify::JudgedPhotons judge(const Scene& scene, const std::function<void(std::vector<PhotonWay>&)>& change) {
  const auto twin = executors::make_twin_executor(scene, {});
  const auto changed = [&](uint32_t index) {
    std::vector<PhotonWay> ways = twin->photon_ways(index);
    change(ways);
    return ways;
  };
  return verify::judge_photons(scene, changed, reference::Renderer(scene));
}

// The number of photons that are stored without flux.
int64_t lost(const std::vector<PhotonWay>& ways) {
  return std::ranges::count_if(
      ways, [](const PhotonWay& way) { return way.positions != Vec3(0) && way.flux == Vec3(0); });
}

const Scene& box() {
  static const Scene scene = scene_of("scenes/sppm/box.toml");
  return scene;
}

}  // namespace

TEST_CASE("a photon that no rounding explains fails, though many may diverge") {
  const verify::JudgedPhotons sound = judge(box(), [](auto&) {});
  CHECK(sound.tally.sent == 4096);
  CHECK(sound.tally.unexplained == 0);
  CHECK(sound.tally.passes());

  // Finds a photon whose way rounding does not change.
  uint32_t number = 7;
  while (std::ranges::binary_search(sound.left_out.of(0), number)) ++number;
  const verify::JudgedPhotons diverged = judge(box(), [&](auto& ways) { ways[number].trail ^= 1; });
  CHECK(diverged.tally.diverged == sound.tally.diverged + 1);
  CHECK(diverged.tally.may_diverge() > diverged.tally.diverged);
  CHECK(diverged.tally.unexplained == 1);
  CHECK(diverged.tally.worst.starts_with("photon " + std::to_string(number) +
                                         " of sample 0; the reference's "));
  CHECK_FALSE(diverged.tally.passes());
  CHECK(std::ranges::binary_search(diverged.left_out.of(0), number));

  const auto displaces = [&](const std::string& worst, const std::function<void(PhotonWay&)>& change) {
    CAPTURE(worst);
    const verify::JudgedPhotons displaced = judge(box(), [&](auto& ways) { change(ways[number]); });
    CHECK(displaced.tally.displaced == sound.tally.displaced + 1);
    CHECK(displaced.tally.unexplained == 1);
    CHECK(displaced.tally.worst.find(worst) != std::string::npos);
    CHECK_FALSE(displaced.tally.passes());
  };
  displaces(", which is displaced by 0.01,", [](PhotonWay& way) { way.positions.x += 0.01; });
  displaces(", turned by 0.1,", [](PhotonWay& way) { way.directions.x += 0.1; });
  displaces(" and carries 1.5 times the flux", [](PhotonWay& way) { way.flux *= 1.5; });
}

TEST_CASE("float32 may hit either of two coincident surfaces, and the reference allows both") {
  // Light from below reaches the floor and the shape that stands on it at the same point.
  const verify::JudgedPhotons judged = judge(scene_of("scenes/cameras/formula.toml"), [](auto&) {});
  CHECK(judged.tally.diverged > 4);
  CHECK(judged.tally.unexplained == 0);
  CHECK(judged.tally.worst == "");
  CHECK(judged.tally.passes());
}

TEST_CASE("a photon at a corner, which few roundings send where float32 does, is explained") {
  Scene scene =
      loader::load_scene("scenes/sppm/box.toml", std::vector<loader::Override>{{"render.seed=101"}});
  const verify::JudgedPhotons judged = judge(scene, [](auto&) {});
  CHECK(judged.tally.diverged > 0);
  CHECK(judged.tally.unexplained == 0);
}

TEST_CASE("more diverged or displaced photons than allowed fail, explained or not") {
  compare::PhotonTally tally;
  tally.sent = 100'000;
  tally.depth = 8;
  tally.diverged = tally.may_diverge();
  tally.displaced = tally.may_be_displaced();
  CHECK(tally.passes());
  ++tally.diverged;
  CHECK_FALSE(tally.passes());
  --tally.diverged;
  ++tally.displaced;
  CHECK_FALSE(tally.passes());
}

TEST_CASE("float32 may lose the flux of a photon that a medium has all but absorbed") {
  // A lit wall scatters photons to another wall, at this distance.
  const auto across = [](int distance) {
    return loader::parse_scene(fmt::format(R"(
[image]
width = 24
height = 18
samples = 1
[camera]
eye = [0, 0, 2]
[render]
integrator = "sppm"
photons = 4096
photon_radius = 2
[medium]
absorption = 0.5
[[light]]
type = "point"
position = [0, 0, 1]
intensity = 1000
[[material]]
name = "white"
type = "diffuse"
[[parallelogram]]
origin = [-10, -10, 0]
edge_u = [20, 0, 0]
edge_v = [0, 20, 0]
material = "white"
[[parallelogram]]
origin = [-{0}, -{0}, {0}]
edge_u = [{1}, 0, 0]
edge_v = [0, {1}, 0]
material = "white"
)",
                                           distance, 2 * distance),
                               "scene.toml");
  };
  // In float32 e⁻¹⁵⁰ is 0.
  const Scene dark = across(300);
  CHECK(lost(reference::Renderer(dark).tracer().photons(0)->ways()) == 0);
  const verify::JudgedPhotons absorbed = judge(dark, [&](auto& ways) { CHECK(lost(ways) > 100); });
  CHECK(absorbed.tally.passes());
  CHECK(absorbed.tally.displaced < 100);

  // With e⁻²⁵ each photon counts.
  const verify::JudgedPhotons dimmed = judge(across(50), [&](auto& ways) {
    CHECK(lost(ways) == 0);
    std::ranges::find_if(ways, [](const PhotonWay& way) { return way.flux != Vec3(0); })->flux = Vec3(0);
  });
  CHECK(dimmed.tally.unexplained == 1);
}

TEST_CASE("a photon ends where a smooth triangle scatters it behind the triangle's own plane") {
  Scene scene = test::empty_scene();
  scene.render.integrator = IntegratorType::sppm;
  scene.render.photons = 16384;
  scene.render.photon_radius = 0.1;
  const int white = test::add(scene, materials::make_phong({.diffuse = test::gray(0.8)}));
  test::add_instance(scene, test::add(scene, test::globe(5, 3)), white);
  test::add(scene, shapes::make_box({-2, -1.5, -2}, {2, -1, 2}), white);
  test::add_sun(scene, glm::normalize(Vec3(1, 1, 0)), Vec3(1));
  CHECK(lost(reference::Renderer(scene).tracer().photons(0)->ways()) == 0);
  CHECK(judge(scene, [](auto& ways) { CHECK(lost(ways) == 0); }).tally.passes());
}
