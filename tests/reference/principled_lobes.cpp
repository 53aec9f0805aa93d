// Each lobe of `principled` in the reference against its published formulas: the value for every direction,
// and the light that samples bring. The executors agree with the reference in tests/shaders/bsdf.cpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "host/reference/bsdf.hpp"
#include "principled_formulas.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;
using reference::BsdfSample;
using reference::BsdfValue;
using reference::ViewedBsdf;

namespace {

struct NamedLook {
  const char* name;
  Look look;
};

constexpr NamedLook looks[] = {
    {"paint", {.roughness = 0.5, .color = 0.7}},
    {"metal", {.metallic = 1, .roughness = 0.6, .color = 0.6}},
    {"metal and paint", {.metallic = 0.4, .roughness = 0.7, .color = 0.5}},
    {"a coat on paint", {.roughness = 0.8, .coat = 1, .color = 0.4, .coat_roughness = 0.4}},
    {"a coat on half of a metal", {.metallic = 1, .coat = 0.5, .color = 0.5, .coat_roughness = 0.6}},
    {"sheen", {.roughness = 0.9, .sheen = 0.8, .color = 0.3, .sheen_roughness = 0.4}},
    {"wide sheen", {.roughness = 0.9, .sheen = 0.5, .color = 0.3, .sheen_roughness = 0.9}},
    {"glass", {.transmission = 1, .roughness = 0.6, .color = 0.8}},
    {"rough glass of high index", {.transmission = 1, .roughness = 0.8, .color = 0.9, .ior = 2.5}},
    {"a pane", {.transmission = 1, .roughness = 0.6, .color = 0.7, .thin = true}},
    {"metal and glass", {.metallic = 0.5, .transmission = 0.5, .roughness = 0.8, .color = 0.9, .ior = 2.5}},
    {"paper", {.roughness = 0.7, .color = 0.8, .diffuse_transmission = 0.6}},
    {"brushed metal", {.metallic = 1, .roughness = 0.6, .color = 0.6, .anisotropy = 0.6}},
    {"brushed metal and paint", {.metallic = 0.5, .roughness = 0.5, .color = 0.5, .anisotropy = 0.8}},
    {"opaline glass", {.transmission = 0.5, .roughness = 0.6, .color = 0.8, .diffuse_transmission = 0.5}},
    {"all lobes",
     {.metallic = 0.2, .transmission = 0.5, .roughness = 0.6, .coat = 0.6, .sheen = 0.4, .color = 0.7}},
};

template <typename Check>
void for_each_view(const Check& check) {
  for (const NamedLook& named : looks)
    for (const bool leaving : {false, true}) {
      if (leaving && (named.look.transmission == 0 || named.look.thin)) continue;
      for (const double cosine : {0.95, 0.5, 0.2}) {
        const std::string name = named.name;
        CAPTURE(name);
        CAPTURE(leaving);
        CAPTURE(cosine);
        check(named.look, bsdf_of(named.look, cosine, leaving), cosine, leaving);
      }
    }
}

// Functions whose integrals show how light is distributed: all light, light before the surface, and the
// light's average direction.
using Moments = std::array<double, 4>;
Moments moments_of(const Vec3& i) {
  return {1, i.z > 0 ? 1.0 : 0.0, i.x, i.z};
}
void accumulate(Moments& sum, double weight, const Vec3& i) {
  for (size_t m = 0; m < sum.size(); ++m) sum[m] += weight * moments_of(i)[m];
}

template <typename F>
void for_each_direction(const F& f) {
  for (int row = 0; row < HalfSphere::rows; ++row)
    for (int turn = 0; turn < HalfSphere::turns; ++turn)
      for (const double side : {1.0, -1.0}) {
        const Vec3 up = HalfSphere::direction(row, turn);
        f(Vec3(up.x, up.y, side * up.z), row);
      }
}

// By strata of all three random numbers: of(direction, value and density), or of(0, nothing) for a lost
// sample.
template <typename F>
void for_each_sample(const ViewedBsdf& viewed, const F& of) {
  constexpr int lobes = 32, side = 24;
  Random random(7);
  for (int l = 0; l < lobes; ++l)
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y) {
        const double u = (x + random.uniform()) / side, v = (y + random.uniform()) / side;
        const BsdfSample sample = viewed.sample((l + random.uniform()) / lobes, {u, v});
        const BsdfValue value = viewed.at(sample.i, sample.i.z > 0);
        of(sample.i, value, 1.0 / (lobes * side * side));
      }
}

}  // namespace

TEST_CASE("principled has the value of its published formulas in every direction") {
  double worst_of_all = 0;
  for_each_view([&](const Look& look, const Bsdf& bsdf, double cosine, bool leaving) {
    const ViewedBsdf viewed(bsdf, direction_of(cosine));
    const PrincipledFormulas formulas(look, cosine, leaving);
    double worst = 0;
    for_each_direction([&](const Vec3& i, int row) {
      const double expected = formulas.at(i, row), found = viewed.at(i, i.z > 0).value.x;
      worst = std::max(worst, std::abs(found - expected) / std::max(expected, 0.02));
    });
    CHECK(worst < (look.anisotropy > 0 ? 0.05 : 0.02));  // its albedo is a sum over few microfacets
    worst_of_all = std::max(worst_of_all, worst);
  });
  MESSAGE("off by up to " << worst_of_all << " of themselves");
}

TEST_CASE("principled's samples bring the light of its published formulas, and their density is 1") {
  for_each_view([](const Look& look, const Bsdf& bsdf, double cosine, bool leaving) {
    const ViewedBsdf viewed(bsdf, direction_of(cosine));
    const PrincipledFormulas formulas(look, cosine, leaving);
    Moments expected{}, found{};
    double density = 0;
    for_each_direction([&](const Vec3& i, int row) {
      accumulate(expected, formulas.at(i, row) * HalfSphere::angle(row), i);
      density += viewed.at(i, i.z > 0).density * HalfSphere::angle(row);
    });
    for_each_sample(viewed, [&](const Vec3& i, const BsdfValue& value, double share) {
      if (value.density > 0)
        accumulate(found, share * value.value.x / value.density, i);
      else
        density += share;
    });
    for (size_t m = 0; m < expected.size(); ++m) {
      CAPTURE(m);
      CHECK(std::abs(found[m] - expected[m]) < (look.anisotropy > 0 ? 0.01 : 0.005));
    }
    // The density of light through glass jumps where microfacets would stand upright.
    CHECK(density == doctest::Approx(1).epsilon(0.008));
  });
}

TEST_CASE("no sample of principled weighs more than 100 times the light that is scattered") {
  const Look bases[] = {{.metallic = 1},
                        {.metallic = 0.5, .transmission = 0.5, .ior = 2.5},
                        {.transmission = 1, .ior = 2.5},
                        {.transmission = 1, .thin = true},
                        {.transmission = 0.5, .coat = 1, .sheen = 0.5},
                        {.sheen = 1}};
  double greatest = 0, greatest_square = 0, worst_light = 0;
  for (Look look : bases)
    for (const double roughness : {0.03, 0.1, 0.3, 0.8, 1.0})
      for (const bool leaving : {false, true}) {
        if (leaving && (look.transmission == 0 || look.thin)) continue;
        look.roughness = look.coat_roughness = look.sheen_roughness = roughness;
        for (const double cosine : {1.0, 0.2, 0.05, 0.01, 0.001}) {
          CAPTURE(look.metallic);
          CAPTURE(look.transmission);
          CAPTURE(look.sheen);
          CAPTURE(roughness);
          CAPTURE(leaving);
          CAPTURE(cosine);
          const Bsdf bsdf = bsdf_of(look, cosine, leaving);
          double most = 0, light = 0, square = 0;
          for_each_sample(ViewedBsdf(bsdf, direction_of(cosine)),
                          [&](const Vec3&, const BsdfValue& value, double share) {
                            if (!(value.density > 0)) return;
                            const double weight = value.value.x / value.density;
                            most = std::max(most, weight);
                            light += share * weight;
                            square += share * weight * weight;
                          });
          CHECK(most < 100);
          CHECK(square < 8);
          CHECK(light == doctest::Approx(1).epsilon(0.03));  // all of these are white
          worst_light = std::max(worst_light, std::abs(light - 1));
          greatest = std::max(greatest, most);
          greatest_square = std::max(greatest_square, square);
        }
      }
  MESSAGE("weights up to " << greatest << ", their squares on average up to " << greatest_square
                           << ", light 1 but for " << worst_light);
}

TEST_CASE("a brushed metal's highlight is as much longer than wide as its slopes are") {
  const Look look{.metallic = 1, .roughness = 0.2, .anisotropy = 0.5};
  const Bsdf bsdf = bsdf_of(look, 1);
  const ViewedBsdf viewed(bsdf, Vec3(0, 0, 1));
  // The slope of microfacets along an axis at which the highlight has fallen to half of its height.
  const auto half_width = [&](const Vec2& axis) {
    const auto height = [&](double slope) {
      const Vec3 h = glm::normalize(Vec3(slope * axis, 1));
      return viewed.at(2 * h.z * h - Vec3(0, 0, 1), true).value.x;
    };
    double low = 0, high = 0.5;
    for (int i = 0; i < 50; ++i) {
      const double middle = (low + high) / 2;
      (height(middle) > height(0) / 2 ? low : high) = middle;
    }
    return low;
  };
  // KHR_materials_anisotropy: 0.2² across, and a quarter of the way from there to 1 along x.
  const double across = 0.04, along = across + 0.25 * (1 - across);
  CHECK(half_width({1, 0}) / half_width({0, 1}) == doctest::Approx(along / across).epsilon(0.06));
}
