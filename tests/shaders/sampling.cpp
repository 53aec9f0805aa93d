// Random numbers of samples, and places on emitters: the shaders' beside the reference's.
#include <set>

#include "host/pack/emitter_records.hpp"
#include "host/pack/environment_records.hpp"
#include "host/reference/emitter_sample.hpp"
#include "host/reference/environment.hpp"
#include "host/reference/sampler.hpp"
#include "host/twin/shader_functions.hpp"
#include "tests/support/environments.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray;
using test::Random;

namespace {

shader::Frame seeded(uint32_t seed) {
  shader::Frame frame{};
  frame.seed = seed;
  return frame;
}

uint32_t number(float u) {
  return uint32_t(u * 0x1p24f);
}

Vec3 anywhere(Random& random, double reach) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

shader::Emitter packed(const EmitterForm& form) {
  records::Packer packer(Vec3(0));
  pack::pack_light_choice(
      {.emitters = {{0, Vec3(1), form, area_of(form)}}, .ends = {1u << 24}, .unsampled = {}}, packer);
  return packer.scene.emitters[0];
}

}  // namespace

TEST_CASE("shaders and reference draw the same Sobol' numbers, bit by bit") {
  Random random(1);
  int differ = 0;
  for (int i = 0; i < 200'000; ++i) {
    const auto any = [&] { return uint32_t(random.below(1 << 24)) * 257u; };
    const uint32_t pixel = any(), index = any() >> (i % 32), pair = any() % 80, seed = any();
    const shader::vec2 ours = shader::sobol_pair(seeded(seed), pixel, index, pair);
    differ += Vec2(ours) != reference::sampler(SamplePattern::sobol).pair(pixel, index, pair, seed);
  }
  CHECK(differ == 0);
}

TEST_CASE("each elementary interval has one of the first 2^k Sobol' numbers, of any pixel") {
  int wrong = 0;
  for (uint32_t pixel = 0; pixel < 300; ++pixel) {
    const uint32_t k = pixel % 9;
    for (uint32_t rows = 0; rows <= k; ++rows) {
      std::set<uint32_t> hit;
      for (uint32_t i = 0; i < 1u << k; ++i) {
        const shader::vec2 u = shader::sobol_pair(seeded(7), pixel, i, 5);
        const uint32_t x = number(u.x) >> (24 - rows), y = number(u.y) >> (24 - (k - rows));
        hit.insert(x << 16 | y);
      }
      wrong += hit.size() != size_t{1} << k;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("two pairs, and the two numbers of one, do not depend on each other") {
  constexpr int count = 1 << 16;
  for (const auto& [first, second] : {std::pair(4u, 5u), std::pair(5u, 9u), std::pair(6u, 7u)}) {
    double sums[3] = {};
    for (int i = 0; i < count; ++i) {
      // One sample each of many pixels, so that no stratification helps.
      const auto a = shader::sobol_pair(seeded(3), uint32_t(i), uint32_t(i % 7), first);
      const auto b = shader::sobol_pair(seeded(3), uint32_t(i), uint32_t(i % 7), second);
      sums[0] += (double(a.x) - 0.5) * (double(b.x) - 0.5);
      sums[1] += (double(a.x) - 0.5) * (double(b.y) - 0.5);
      sums[2] += (double(a.x) - 0.5) * (double(a.y) - 0.5);
    }
    for (const double sum : sums) CHECK(std::abs(12 * sum / count) < 5 / std::sqrt(count));
  }
}

TEST_CASE("places on emitters and their densities are those of the reference") {
  Random random(2);
  double apart = 0, denser = 0;
  for (int i = 0; i < 40'000; ++i) {
    const Vec3 a = anywhere(random, 3), b = anywhere(random, 1), c = anywhere(random, 1),
               from = anywhere(random, 4);
    Mat4 map(1.0);
    map[0] = {b, 0};
    map[2] = {c, 0};
    map[3] = {a, 1};
    const EmitterForm forms[] = {SphereForm{a, random.uniform(0.01, 2)},
                                 DiskForm{map, random.uniform(0, 0.9)}, TriangleForm{{a, a + b, a + c}},
                                 ParallelogramForm{a, b, c}};
    for (const EmitterForm& form : forms) {
      const shader::vec2 u{float(random.below(1 << 24)) * 0x1p-24f, float(random.below(1 << 24)) * 0x1p-24f};
      const shader::Emitter record = packed(form);
      const shader::vec3 rounded(from);
      const shader::EmitterSample ours = shader::sample_emitter(record, rounded, u);
      const reference::EmitterSample theirs = reference::sample_emitter(form, Vec3(rounded), Vec2(u));
      apart = std::max(apart, glm::length(Vec3(ours.p) - theirs.position));

      // Of the same place; one that is seen edge-on is as dense as its normal is rounded.
      const reference::EmitterSample same{Vec3(ours.p), Vec3(ours.normal)};
      const double density = reference::emitter_density(form, Vec3(rounded), same);
      const Vec3 way = glm::normalize(same.position - Vec3(rounded));
      const bool sphere = std::holds_alternative<SphereForm>(form);
      const double edge_on = sphere ? 1 : std::abs(glm::dot(way, same.normal));
      const double near = std::min(1.0, glm::length(same.position - Vec3(rounded)));
      denser =
          std::max(denser, std::abs(double(shader::emitter_density(record, rounded, ours)) / density - 1) *
                               edge_on * near);
    }
  }
  MESSAGE("places are up to " << apart << " apart, densities to " << denser << " of themselves");
  // At a sphere's rim places run like a square root.
  CHECK(apart < 1e-4);
  CHECK(denser < 2e-6);
}

TEST_CASE("light from all around, its density and places in it are those of the reference") {
  Random random(3);
  for (const auto& [width, height] :
       {std::pair(1, 1), std::pair(1, 7), std::pair(5, 1), std::pair(33, 16), std::pair(700, 900)}) {
    CAPTURE(width);
    CAPTURE(height);
    const auto map = test::environment(
        width, height,
        [&](const Vec3&) {
          return random.below(3) == 0 ? Vec3(0) : Vec3(std::pow(10, random.uniform(-3, 3)), 1, 0.2);
        },
        random.uniform(-1, 1));
    const auto texels = pack::pack_environment(*map);
    shader::Frame frame{};
    frame.environment_width = uint32_t(width);
    frame.environment_height = uint32_t(height);
    frame.environment_turn = float(map->turn());
    twin::SceneView scene{};
    scene.environment = texels.data();
    const shader::Binding binding(scene);

    double apart = 0, denser = 0, brighter = 0, sum = 0, steepest = 0;
    int elsewhere = 0;
    constexpr int count = 100'000;
    for (int i = 0; i < count; ++i) {
      const shader::vec2 u{float(random.below(1 << 24)) * 0x1p-24f, float(random.below(1 << 24)) * 0x1p-24f};
      const shader::EnvironmentSample ours = shader::sample_environment(frame, u);
      const reference::EnvironmentSample theirs = reference::sample_environment(*map, Vec2(u));
      apart = std::max(apart, glm::length(Vec3(ours.direction) - theirs.d));
      denser = std::max(denser, std::abs(double(ours.density) / theirs.density - 1));
      // The density of a direction is that of its choice, but on the border of two cells.
      const auto differs = [](double a, double b) { return std::abs(a / b - 1) > 1e-5; };
      elsewhere +=
          differs(double(shader::environment_density(frame, ours.direction)), double(ours.density)) ||
          differs(reference::environment_density(*map, theirs.d), theirs.density);
      const Vec3 here = reference::environment_radiance(*map, theirs.d);
      brighter = std::max(brighter,
                          std::abs(double(shader::environment_radiance(frame, ours.direction).x) - here.x));
      steepest = std::max(steepest, here.x);

      // Of even directions: the mean density is 1 / 4π.
      const double y = random.uniform(-1, 1), azimuth = random.uniform(0, 2 * M_PI),
                   across = std::sqrt(1 - y * y);
      sum +=
          reference::environment_density(*map, {across * std::cos(azimuth), y, across * std::sin(azimuth)});
    }
    CHECK(apart < 2e-6);
    CHECK(denser < 2e-6);
    CHECK(elsewhere < 20);
    CHECK(brighter < 1e-5 * width * steepest);
    CHECK(4 * M_PI * sum / count == doctest::Approx(1).epsilon(0.1));
  }
}
