// Random numbers of samples, and points on emitters: compares the shaders' with the reference's.
#include <set>

#include "host/pack/emitter_records.hpp"
#include "host/pack/environment_records.hpp"
#include "host/reference/emitter_sample.hpp"
#include "host/reference/environment.hpp"
#include "host/reference/filter.hpp"
#include "host/reference/sampler.hpp"
#include "host/twin/shader_functions.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/environments.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
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
  pack::pack_light_choice({.emitters = {{0, Vec3(1), form, area_of(form)}}, .ends = {1u << 24}}, packer);
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

TEST_CASE("each elementary interval has one of the first 2^k Sobol' numbers, for any pixel") {
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

TEST_CASE("two pairs, and the two numbers of a pair, are uncorrelated") {
  constexpr int count = 1 << 16;
  for (const auto& [first, second] : {std::pair(4u, 5u), std::pair(5u, 9u), std::pair(6u, 7u)}) {
    double sums[3] = {};
    for (int i = 0; i < count; ++i) {
      // One sample each of many pixels, so that no stratification hides a correlation.
      const auto a = shader::sobol_pair(seeded(3), uint32_t(i), uint32_t(i % 7), first);
      const auto b = shader::sobol_pair(seeded(3), uint32_t(i), uint32_t(i % 7), second);
      sums[0] += (double(a.x) - 0.5) * (double(b.x) - 0.5);
      sums[1] += (double(a.x) - 0.5) * (double(b.y) - 0.5);
      sums[2] += (double(a.x) - 0.5) * (double(a.y) - 0.5);
    }
    for (const double sum : sums) CHECK(std::abs(12 * sum / count) < 5 / std::sqrt(count));
  }
}

TEST_CASE("points on emitters and their densities agree with the reference") {
  Random random(2);
  double apart = 0, denser = 0;
  for (int i = 0; i < test::amount(6'000, 40'000, 40'000); ++i) {
    const Vec3 a = anywhere(random, 3), b = anywhere(random, 1), c = anywhere(random, 1),
               from = anywhere(random, 4);
    Mat4 map(1.0);
    map[0] = {b, 0};
    map[2] = {c, 0};
    map[3] = {a, 1};
    // The map is not too flat, so that its inverse keeps enough digits in float32.
    Mat4 solid(1.0);
    for (int axis = 0; axis < 3; ++axis) solid[axis] = Vec4(anywhere(random, 0.2), 0);
    for (int axis = 0; axis < 3; ++axis) solid[axis][axis] += random.uniform(0.5, 1);
    solid[3] = {a, 1};
    const EmitterForm forms[] = {SphereForm{a, random.uniform(0.01, 2)},
                                 DiskForm{map, random.uniform(0, 0.9)},
                                 TriangleForm{{a, a + b, a + c}},
                                 ParallelogramForm{a, b, c},
                                 ParallelogramForm{a, b, glm::cross(b, c)},
                                 BoxForm{solid},
                                 EllipsoidForm{solid},
                                 CylinderForm{solid, i % 2 == 0}};
    for (const EmitterForm& form : forms) {
      const shader::vec2 u{float(random.below(1 << 24)) * 0x1p-24f, float(random.below(1 << 24)) * 0x1p-24f};
      const shader::Emitter record = packed(form);
      const shader::vec3 rounded(from);
      const shader::EmitterSample ours = shader::sample_emitter(record, rounded, u);
      const reference::EmitterSample theirs = reference::sample_emitter(form, Vec3(rounded), Vec2(u));
      apart = std::max(apart, glm::length(Vec3(ours.p) - theirs.position));

      // Compares densities at the same point. If its surface is seen edge-on, the density depends on the
      // rounding of the normal.
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
  // At a sphere's rim, points move like a square root.
  CHECK(apart < 1e-4);
  CHECK(denser < 4e-6);
}

TEST_CASE("an environment's radiance, density and sampled directions agree with the reference") {
  Random random(3);
  for (const auto& size :
       {std::pair(1, 1), std::pair(1, 7), std::pair(5, 1), std::pair(33, 16), std::pair(700, 900)}) {
    const int width = size.first, height = size.second;
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
      // The density of a direction is that with which it was chosen, except on the border of two cells.
      const auto differs = [](double a, double b) { return std::abs(a / b - 1) > 1e-5; };
      elsewhere +=
          differs(double(shader::environment_density(frame, ours.direction)), double(ours.density)) ||
          differs(reference::environment_density(*map, theirs.d), theirs.density);
      const Vec3 here = reference::environment_radiance(*map, theirs.d);
      brighter = std::max(brighter,
                          std::abs(double(shader::environment_radiance(frame, ours.direction).x) - here.x));
      steepest = std::max(steepest, here.x);

      // The directions are uniform, so the mean density is 1 / 4π.
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

namespace {

// Points of pixel filters by the shaders, relative to the filter's middle and in units of its width.
std::vector<Vec2> filtered_points(PixelFilter filter, uint32_t count) {
  shader::Frame frame = seeded(3);
  frame.pixel_filter = uint32_t(filter);
  frame.filter_width = 1;
  std::vector<Vec2> points;
  for (uint32_t i = 0; i < count; ++i)
    points.push_back(Vec2(shader::filtered(frame, shader::random_pair(frame, 5, i, 0))) - Vec2(0.5));
  return points;
}

// The excess of chi² over its expectation, in standard deviations, for equally likely cells.
double excess(const std::vector<int>& cells, uint32_t count) {
  const double expected = double(count) / double(cells.size());
  double chi_squared = 0;
  for (const int found : cells) chi_squared += (found - expected) * (found - expected) / expected;
  const double degrees = double(cells.size()) - 1;
  return (chi_squared - degrees) / std::sqrt(2 * degrees);
}

// The cell of 0 … n − 1 that a share of [0, 1] belongs to.
int cell(double share, int n) {
  return std::clamp(int(share * n), 0, n - 1);
}

constexpr double blackman_harris[] = {0.35875, 0.48829, 0.14128, 0.01168};

}  // namespace

TEST_CASE("pixel filters: shaders and reference map a sample to the same position") {
  Random random(11);
  for (const PixelFilter filter : {PixelFilter::gaussian, PixelFilter::blackman_harris}) {
    shader::Frame frame{};
    frame.pixel_filter = uint32_t(filter);
    frame.filter_width = 3;
    double worst = 0, mean = 0;
    constexpr int count = 20'000;
    for (int i = 0; i < count; ++i) {
      const shader::vec2 u(float(random.below(1 << 24)) * 0x1p-24f, float(random.below(1 << 24)) * 0x1p-24f);
      const Vec2 expected = reference::filtered({.filter = filter, .filter_width = 3}, Vec2(u));
      const double apart = glm::length(Vec2(shader::filtered(frame, u)) - expected);
      worst = std::max(worst, apart);
      mean += apart / count;
    }
    CHECK(mean < 1e-6);
    CHECK(worst < 1e-3);  // at the filter's edge, where it is nearly 0
    // The middle stays the middle, and a point drawn on one side of it stays on that side.
    CHECK(Vec2(shader::filtered(frame, {0.5f, 0.5f})) == Vec2(0.5));
    CHECK(shader::filtered(frame, {0.25f, 0.5f}).x < 0.5f);
    CHECK(shader::filtered(frame, {0.5f, 0.75f}).y > 0.5f);
  }
}

TEST_CASE("a Gaussian filter's points are uniform by ring and sector, with the truncated bell's variance") {
  constexpr uint32_t count = 400'000;
  std::vector<int> cells(16 * 16);
  double squares = 0;
  int outside = 0;
  for (const Vec2& point : filtered_points(PixelFilter::gaussian, count)) {
    const double r2 = 36 * glm::dot(point, point);  // in standard deviations
    const double within = std::expm1(-r2 / 2) / std::expm1(-4.5);
    outside += within > 1 + 1e-5;
    const double turn = std::atan2(point.y, point.x) / (2 * M_PI) + 0.5;
    ++cells[size_t(16 * cell(within, 16) + cell(turn, 16))];
    squares += r2 / count;
  }
  CHECK(outside == 0);
  CHECK(excess(cells, count) < 4);
  CHECK(squares == doctest::Approx(2 * (1 - 4.5 * std::exp(-4.5) / (1 - std::exp(-4.5)))).epsilon(0.01));
}

TEST_CASE("a Blackman-Harris filter's points are uniform over equally likely cells, with its variance") {
  constexpr uint32_t count = 400'000;
  const auto below = [&](double x) {
    double share = 0.5 + x;
    for (int k = 1; k < 4; ++k)
      share += blackman_harris[k] / blackman_harris[0] * std::sin(2 * M_PI * k * x) / (2 * M_PI * k);
    return share;
  };
  double variance = 1.0 / 12;
  for (int k = 1; k < 4; ++k)
    variance += blackman_harris[k] / blackman_harris[0] * (k % 2 ? -1 : 1) / (2 * M_PI * M_PI * k * k);
  std::vector<int> cells(16 * 16);
  Vec2 squares(0.0);
  int outside = 0;
  for (const Vec2& point : filtered_points(PixelFilter::blackman_harris, count)) {
    outside += std::max(std::abs(point.x), std::abs(point.y)) > 0.5;
    ++cells[size_t(16 * cell(below(point.x), 16) + cell(below(point.y), 16))];
    squares += point * point / double(count);
  }
  CHECK(outside == 0);
  CHECK(excess(cells, count) < 4);
  CHECK(squares.x == doctest::Approx(variance).epsilon(0.01));
  CHECK(squares.y == doctest::Approx(variance).epsilon(0.01));
}
