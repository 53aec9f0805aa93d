// Tests of the probability of each light, which is in whole numbers that every executor shares.
#include <numeric>

#include "host/core/error.hpp"
#include "host/scene/light_choice.hpp"
#include "patch.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::test;

TEST_CASE("lights are chosen by power, and all shares add up to one") {
  Scene scene = empty_scene();
  add_point_light(scene, {0, 5, 0}, Vec3(1 / M_PI), Falloff::inverse_square);
  const int bright = emissive(scene, 4);
  add(scene, make_sphere({0, 0, 0}, 1), bright);
  add(scene, make_sphere({5, 0, 0}, 0.5), bright);
  add(scene, make_parallelogram({0, 9, 0}, {1, 0, 0}, {0, 0, 2}), emissive(scene, 0.001));
  const LightChoice choice = light_choice(scene);
  REQUIRE(choice.emitters.size() == 3);
  REQUIRE(choice.ends.size() == 4);
  CHECK(choice.ends.back() == 1u << 24);
  CHECK(emitters(scene).unsampled.empty());
  // A sixteenth of the probability is shared evenly.
  const double powers[] = {4 * M_PI, 2 * M_PI * 4 * M_PI * 4, 2 * M_PI * M_PI * 4, 2 * M_PI * 2 * 0.001};
  const double sum = std::accumulate(std::begin(powers), std::end(powers), 0.0);
  for (size_t i = 0; i < 4; ++i)
    CHECK(choice.share(i) == doctest::Approx(15.0 / 16 * powers[i] / sum + 1.0 / 64).epsilon(1e-5));
}

TEST_CASE("a spot's power is that of its cone's light") {
  Scene scene = empty_scene();
  add_spot(scene, {{0, 5, 0}, {0, -1, 0}, Vec3(1), 0.2, 0.5});
  add_point_light(scene, {0, 5, 0}, Vec3(1), Falloff::inverse_square);
  // ∫ s² dω by the midpoint rule.
  double sum = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double angle = 0.5 * (i + 0.5) / 100'000;
    const double s = std::min(1.0, (std::cos(angle) - std::cos(0.5)) / (std::cos(0.2) - std::cos(0.5)));
    sum += 2 * M_PI * s * s * std::sin(angle) * 0.5 / 100'000;
  }
  const double part = sum / (sum + 4 * M_PI);
  CHECK(light_choice(scene).share(0) == doctest::Approx(15.0 / 16 * part + 1.0 / 32).epsilon(1e-5));
}

TEST_CASE("emitters that cannot be sampled are reported: those with holes, and other shapes") {
  Scene scene = empty_scene();
  add(scene, make_torus({0, 0, 0}, {0, 1, 0}, 1, 0.2), emissive(scene, 1));
  const int checkered =
      add(scene, make_phong({.emission = textures::make_checker(Vec3(0), Vec3(1), Vec2(1))}));
  scene.materials[size_t(checkered)]->mask = AlphaMask{gray(1), 0.5};
  add(scene, make_disk({3, 0, 0}, {0, 1, 0}, 1), checkered);
  add(scene, make_sphere({6, 0, 0}, 1), emissive(scene, 0));
  CHECK(light_choice(scene).ends.empty());
  CHECK(emitters(scene).sampled.empty());
  CHECK(emitters(scene).unsampled.size() == 2);
}

TEST_CASE("an emitter that shall not be sampled is no light of paths, but sends photons") {
  Scene scene = empty_scene();
  const int dim = emissive(scene, 1);
  scene.materials[size_t(dim)]->samples_emission = false;
  add(scene, make_sphere({0, 0, 0}, 1), dim);
  CHECK(emitters(scene).sampled.empty());
  CHECK(emitters(scene).unsampled.empty());  // so nothing is reported
  scene.render.integrator = IntegratorType::sppm;
  CHECK(emitters(scene).sampled.size() == 1);
}

TEST_CASE("an area light without power has its share, and more than 2^20 are refused") {
  Scene scene = empty_scene();
  scene.render.light_sampler = LightSampler::power;
  scene.meshes.push_back({.name = "",
                          .positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                          .triangles = {{0, 1, 2}},
                          .normals = {},
                          .uv = {}});
  scene.meshes[0].triangles.resize(size_t{1} << 20, {0, 1, 2});
  scene.instances.push_back(
      {.mesh = 0, .transform = Mat4(1.0), .material = emissive(scene, 1e-30), .position = {}});
  const LightChoice choice = light_choice(scene);
  CHECK(choice.ends.back() == 1u << 24);
  CHECK(std::ranges::adjacent_find(choice.ends, std::greater_equal()) == choice.ends.end());
  scene.meshes[0].triangles.push_back({0, 1, 2});
  CHECK_THROWS_AS(light_choice(scene), Error);
}
