// Lengths of rays in a medium that has an extent: compares the shaders' and the reference's with numerical
// integrals.
#include "host/reference/medium_extent.hpp"

#include "host/twin/shader_functions.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/medium_column.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using test::Random;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr auto miss = double(T_MISS);

// The extent as the packer writes it, for an eye at the origin.
shader::Frame frame_of(const MediumExtent& extent) {
  const Bounds box = extent.bounds();
  shader::Frame frame{};
  frame.has_medium_extent = 1;
  frame.medium_min = glm::vec3(glm::max(box.min, Vec3(-miss)));
  frame.medium_max = glm::vec3(glm::min(box.max, Vec3(miss)));
  frame.medium_decay = float(1 / extent.scale_height);
  frame.medium_base = float(extent.base);
  return frame;
}

// A random extent: each side of the box and the scale height may be missing.
MediumExtent any_extent(Random& random) {
  MediumExtent extent;
  for (int axis = 0; axis < 3; ++axis) {
    if (random.below(2)) extent.min[axis] = random.uniform(-8, 0);
    if (random.below(2)) extent.max[axis] = random.uniform(0.1, 8);
  }
  if (random.below(3)) {
    extent.scale_height = random.log_uniform(0.2, 200);
    extent.base = random.uniform(-5, 5);
  }
  return extent;
}

// A random ray of float32 numbers, as the shaders take it; every fifth goes along an axis or perpendicular to
// one.
Ray any_ray(Random& random) {
  const Vec3 o = random.point(10);
  Vec3 d = random.direction();
  if (const int degenerate = random.below(15); degenerate < 3) {
    d[degenerate] = 0;
    if (random.below(2)) d[(degenerate + 1) % 3] = 0;
    d = glm::normalize(d);
  } else if (degenerate == 3) {
    d = glm::normalize(Vec3(d.x, 1e-6 * d.y, d.z));
  }
  return {Vec3(glm::vec3(o)), Vec3(glm::vec3(d))};
}

double by_shader(const MediumExtent& extent, const Ray& ray, double t) {
  return double(shader::extent_length(frame_of(extent), glm::vec3(ray.o), glm::vec3(ray.d), float(t)));
}

}  // namespace

TEST_CASE("the length of a ray in a medium is the integral of its density") {
  Random random(1);
  int inside = 0;
  for (int i = 0; i < test::amount(500, 2000, 20000); ++i) {
    CAPTURE(i);
    const MediumExtent extent = any_extent(random);
    const Ray ray = any_ray(random);
    const double t = random.uniform(0, 30), expected = test::length_in(extent, ray, t, 4000);
    inside += expected > 0;
    if (expected > 1e9) {
      CHECK(reference::medium_length(extent, ray, t) > 1e8);
      CHECK(by_shader(extent, ray, t) > 1e8);
      continue;
    }
    // The length in a grazed corner depends on rounding; heights are rounded by 1e-6 of a coordinate.
    const double lowest = ray.o.y + std::min(0.0, t * ray.d.y);
    const double densest = std::exp((extent.base - lowest) / extent.scale_height);
    const double rounding = 1e-17 + 1e-5 * (densest + expected * (1 + 1 / extent.scale_height));
    CHECK(std::abs(reference::medium_length(extent, ray, t) - expected) < 1e-8 * (1 + expected));
    CHECK(std::abs(by_shader(extent, ray, t) - expected) < rounding);
  }
  CHECK(inside > 100);
}

TEST_CASE("a flight's distance has the optical length that was drawn for it") {
  Random random(2);
  int inside = 0;
  for (int i = 0; i < test::amount(2000, 20000, 200000); ++i) {
    CAPTURE(i);
    const MediumExtent extent = any_extent(random);
    const Ray ray = any_ray(random);
    const double whole = std::min(reference::medium_length(extent, ray, infinity), 50.0);
    if (!(whole > 1e-3)) continue;
    ++inside;
    const double length = whole * random.uniform(0.01, 0.9);
    const double t = reference::medium_distance(extent, ray, length);
    const auto found =
        double(shader::extent_distance(frame_of(extent), glm::vec3(ray.o), glm::vec3(ray.d), float(length)));
    CAPTURE(t);
    CAPTURE(found);
    // Rounding of t alone changes the length in proportion to the density at t.
    const double density = std::exp((extent.base - ray.o.y - t * ray.d.y) / extent.scale_height);
    CHECK(std::abs(reference::medium_length(extent, ray, t) - length) <
          1e-9 * length + 1e-14 * density * (1 + t));
    CHECK(std::abs(reference::medium_length(extent, ray, found) - length) <
          1e-4 * length + 1e-5 * density * (1 + t));
  }
  CHECK(inside > 1000);
}

TEST_CASE(
    "rays to infinity have a finite length in a bounded or thinning medium, else they transmit nothing") {
  const Vec3 up(0, 1, 0), across(1, 0, 0), down(0, -1, 0), slanted = glm::normalize(Vec3(3, 1, 2));
  const auto both = [](const MediumExtent& extent, const Vec3& o, const Vec3& d, double expected) {
    CAPTURE(expected);
    const Ray ray{o, d};
    const double exact = reference::medium_length(extent, ray, infinity),
                 found = by_shader(extent, ray, miss);
    if (expected == infinity) {
      CHECK(exact > 1e10);
      CHECK(found > 1e10);
      CHECK(found <= miss);
    } else {
      CHECK(exact == doctest::Approx(expected).epsilon(1e-6));
      CHECK(found == doctest::Approx(expected).epsilon(1e-5));
    }
  };
  MediumExtent fog;
  fog.scale_height = 2;
  fog.base = 1;
  both(fog, {0, 3, 0}, up, 2 * std::exp(-1));
  both(fog, {0, 3, 0}, slanted, 2 * std::exp(-1) / slanted.y);
  both(fog, {0, 3, 0}, across, infinity);
  both(fog, {0, 3, 0}, down, infinity);
  // Points hundreds of scale heights above, and below.
  both(fog, {0, 1000, 0}, up, 0);
  both(fog, {0, 1000, 0}, across, 0);
  both(fog, {0, 1000, 0}, down, infinity);
  both(fog, {0, -1000, 0}, up, infinity);
  both(fog, {0, -1000, 0}, down, infinity);
  MediumExtent slab;
  slab.max.y = 5;
  both(slab, {0, 3, 0}, up, 2);
  both(slab, {0, 3, 0}, slanted, 2 / slanted.y);
  both(slab, {0, 3, 0}, across, infinity);
  both(slab, {0, 7, 0}, across, 0);
  both(slab, {0, 7, 0}, down, infinity);
  MediumExtent box;
  box.min = {-1, -2, -3};
  box.max = {4, 5, 6};
  both(box, {0, 3, 0}, up, 2);
  both(box, {0, 3, 0}, across, 4);
  both(box, {-9, 3, 0}, across, 5);
  both(box, {-9, 3, 0}, down, 0);
  // A ray beside the box, parallel to a side, and rays that start on a side.
  both(box, {-9, 9, 0}, across, 0);
  both(box, {0, 5, 0}, up, 0);
  both(box, {0, 5, 0}, down, 7);
}
