// The lobes of BSDFs: compares their values for a direction with the light that their samples bring there, in
// shaders and in the reference. No lobe makes or loses light.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "bsdf_examples.hpp"
#include "host/reference/bsdf.hpp"
#include "host/reference/local_frame.hpp"
#include "host/tables/albedos.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using reference::BsdfValue;
using reference::ViewedBsdf;
using namespace eyeray::engine::test;

namespace {

// The value for light from i, if the side of the surface is that of its shading normal.
BsdfValue above(const ViewedBsdf& viewed, const Vec3& i) {
  return viewed.at(i, i.z > 0);
}

// The albedo for light from everywhere, by the BSDF's own samples: 64 × 64 strata for each of 16 choices of
// the lobe.
Vec3 albedo(const Bsdf& bsdf, double cosine) {
  const ViewedBsdf viewed(bsdf, towards(cosine));
  constexpr int lobes = 16, side = 64;
  Random random(11);
  Vec3 sum(0);
  for (int l = 0; l < lobes; ++l)
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y) {
        const double u = (x + random.uniform()) / side;
        const double v = (y + random.uniform()) / side;
        const double uc = (l + random.uniform()) / lobes;
        const BsdfValue found = above(viewed, viewed.sample(uc, {u, v}).i);
        if (found.density > 0) sum += found.value / found.density;
      }
  return sum / double(lobes * side * side);
}

const double grazing = std::cos(89 * M_PI / 180);

// ∫ of f by Gauss's three points along each axis. Halves the area, at most `halvings` times, until that
// changes the integral by less than `error`.
template <typename F>
double integral(const F& f, const Vec2& low, const Vec2& high, double error, int halvings) {
  if (low.x == high.x) return 0;
  const auto once = [&f](const Vec2& from, const Vec2& to) {
    static const double points[] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
    constexpr double weights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        sum += weights[i] * weights[j] * f(from + (to - from) * Vec2(points[i], points[j]));
    return sum * (to.x - from.x) * (to.y - from.y);
  };
  const Vec2 half = (high - low) / 2.0;
  double quarters[4], sum = 0;
  const auto corner = [&](int q) { return low + half * Vec2(q % 2, q / 2); };
  for (int q = 0; q < 4; ++q) sum += quarters[q] = once(corner(q), corner(q) + half);
  if (halvings == 0 || std::abs(sum - once(low, high)) < error) return sum;
  sum = 0;
  for (int q = 0; q < 4; ++q) sum += integral(f, corner(q), corner(q) + half, error / 2, halvings - 1);
  return sum;
}

// The number of points of the lattice that measures lost light, and the lattice's error.
int lattice_points() {
  return test::amount(1 << 18, 1 << 20, 1 << 24);
}
double lattice_error() {
  return 1e-4 * test::amount(10, 3, 1);
}

// The share of a surface's own samples that the surface itself blocks, by a lattice in three dimensions.
double share_lost(const ViewedBsdf& viewed) {
  const int count = lattice_points();
  // The lattice's steps are inverse powers of the root of x⁴ = x + 1.
  constexpr double root = 1.2207440846057596;
  int lost = 0;
  for (int n = 0; n < count; ++n) {
    const auto coordinate = [n](double step) {
      const double x = (n + 0.5) * step;
      return x - std::floor(x);
    };
    const Vec3 i = viewed
                       .sample(coordinate(1 / root),
                               {coordinate(1 / (root * root)), coordinate(1 / (root * root * root))})
                       .i;
    lost += i == Vec3(0);
  }
  return double(lost) / count;
}

// The z that some test of `tests` exceeds by chance in one of a thousand runs.
double critical_z(int tests) {
  const double p = 1 - std::pow(1 - 1e-3, 1.0 / tests);
  double low = 0, high = 10;
  for (int i = 0; i < 60; ++i) {
    const double z = (low + high) / 2;
    (std::erfc(z / std::sqrt(2)) / 2 > p ? low : high) = z;
  }
  return high;
}

// Tests samples by their counts in cells of (angle, turn), and in one cell for light that goes to the wrong
// side and is lost.
// `all`: also the examples that take long because their densities are narrow, or that sample as another one
// does.
void check_samples(const std::vector<double>& roughnesses, const std::vector<double>& cosines, int samples,
                   bool all) {
  const auto tested = [&](double roughness) {
    std::vector<Named> chosen = examples(roughness);
    if (!all)
      std::erase_if(chosen, [](const Named& each) {
        return each.name == "brushed glass" || each.name == "brushed pane" || each.bsdf.film.share > 0;
      });
    return chosen;
  };
  const records::PackedScene scene = scene_with_albedos();
  const shader::Binding binding(twin::view_of(scene));
  Random random(3);
  constexpr int rows = 24, columns = 32;
  const Vec2 size(M_PI / rows, 2 * M_PI / columns);
  const int tests = int(roughnesses.size() * cosines.size() * tested(1).size());
  const double critical = critical_z(tests);
  double worst_sum = 0, worst_z = -10;
  for (const double roughness : roughnesses) {
    for (const Named& example : tested(roughness)) {
      const std::string& name = example.name;
      const Bsdf& bsdf = example.bsdf;
      for (const double cosine : cosines) {
        CAPTURE(name);
        CAPTURE(roughness);
        CAPTURE(cosine);
        const glm::vec3 o(towards(cosine));
        const ViewedBsdf viewed(bsdf, Vec3(o));
        const shader::Bsdf record = packed(bsdf, o);
        const shader::LobeShares shares = shader::lobe_shares(record);
        std::vector<double> counts(rows * columns), expected(rows * columns);
        const auto number = [&] { return float(random.below(1 << 24)) * 0x1p-24f; };
        for (int n = 0; n < samples; ++n) {
          const float uc = number(), x = number(), y = number();
          const glm::vec3 i = shader::sample_bsdf(record, shares, o, uc, {x, y}).i;
          if (!(shader::bsdf_value(record, shares, o, i, i.z > 0).density > 0)) continue;
          const int row =
              std::clamp(int(std::acos(std::clamp(double(i.z), -1.0, 1.0)) / M_PI * rows), 0, rows - 1);
          const double turn = std::atan2(double(i.y), double(i.x)) / (2 * M_PI);
          const int column = std::clamp(int((turn - std::floor(turn)) * columns), 0, columns - 1);
          ++counts[size_t(row * columns + column)];
        }
        // The density of light through glass jumps at the angle where microfacets would have to stand
        // upright.
        const double upright = std::acos(std::max(-1.0, -bsdf.ior_from * cosine / bsdf.ior_to));
        double sum = 0;
        for (size_t cell = 0; cell < counts.size(); ++cell) {
          const Vec2 low = size * Vec2(cell / columns, cell % columns), high = low + size;
          const auto density = [&](const Vec2& at) {
            return above(viewed, towards(std::cos(at.x), at.y)).density * std::sin(at.x);
          };
          const double middle = std::clamp(upright, low.x, high.x);
          const double share = integral(density, low, {middle, high.y}, 1e-6, 7) +
                               integral(density, {middle, low.y}, high, 1e-6, 7);
          expected[cell] = samples * share;
          sum += share;
        }
        // The integral of the density and the loss add up to 1.
        const double off = std::abs(sum + share_lost(viewed) - 1);
        CHECK(off < lattice_error());
        worst_sum = std::max(worst_sum, off);

        // Cells with few expected samples are counted as one, as Pearson's test requires.
        double statistic = 0, few = 0, few_expected = 0;
        int freedom = -1;
        for (size_t cell = 0; cell < counts.size(); ++cell) {
          if (expected[cell] < 10) {
            few += counts[cell];
            few_expected += expected[cell];
          } else {
            statistic += (counts[cell] - expected[cell]) * (counts[cell] - expected[cell]) / expected[cell];
            ++freedom;
          }
        }
        CHECK(std::abs(few - few_expected) < 6 * std::sqrt(few_expected) + 10);
        // By Wilson and Hilferty, the cube root is nearly normally distributed.
        const double z =
            (std::cbrt(statistic / freedom) - (1 - 2.0 / (9 * freedom))) / std::sqrt(2.0 / (9 * freedom));
        CHECK(z < critical);
        worst_z = std::max(worst_z, z);
      }
    }
  }
  MESSAGE(tests << " tests: z up to " << worst_z << " of " << critical << ", densities 1 but for "
                << worst_sum);
}

constexpr double cosines[] = {1, 0.8, 0.4, 0.1, 0.02};

// The roughnesses of white furnaces.
std::span<const double> furnace_roughnesses() {
  static constexpr double all[] = {0.3, 0.0, 1.0, 0.1, 0.6};
  return std::span(all).first(size_t(amount(3, 5, 5)));
}

}  // namespace

TEST_CASE("a shader's BSDF agrees with the reference, in value and in density") {
  const records::PackedScene scene = scene_with_albedos();
  const shader::Binding binding(twin::view_of(scene));
  Random random(1);
  for (const double roughness : {0.05, 0.2, 0.5, 1.0}) {
    for (const Named& example : examples(roughness)) {
      const std::string& name = example.name;
      const Bsdf& bsdf = example.bsdf;
      CAPTURE(name);
      CAPTURE(roughness);
      double worst = 0, least = 0;
      for (int n = 0; n < amount(2'000, 20'000, 20'000); ++n) {
        const glm::vec3 o(glm::normalize(towards(random.uniform(0.01, 1), random.uniform(0, 6))));
        shader::Bsdf record = packed(bsdf, o);
        record.adjoint = n % 4 >= 2;
        const shader::LobeShares shares = shader::lobe_shares(record);
        // Half of the directions are where the lobes are.
        const shader::vec2 u(float(random.below(1 << 24)) * 0x1p-24f,
                             float(random.below(1 << 24)) * 0x1p-24f);
        const float uc = float(random.below(1 << 24)) * 0x1p-24f;
        const glm::vec3 i = n % 2 ? shader::sample_bsdf(record, shares, o, uc, u).i
                                  : glm::vec3(glm::normalize(random.direction()));
        if (i == glm::vec3(0) || std::abs(i.z) < 0.01f) continue;
        const shader::LobeValue ours = shader::bsdf_value(record, shares, o, i, i.z > 0);
        const ViewedBsdf viewed(bsdf, Vec3(o));
        const BsdfValue theirs = above(record.adjoint ? viewed.adjoint() : viewed, Vec3(i));
        const auto apart = [&](double a, double b) {
          if (std::max(std::abs(a), std::abs(b)) > 1e-6)
            worst = std::max(worst, std::abs(a - b) / std::max(std::abs(b), 0.1));
        };
        apart(double(ours.density), theirs.density);
        for (int c = 0; c < 3; ++c) {
          apart(double(ours.value[c]), theirs.value[c]);
          least = std::min({least, double(ours.value[c]), theirs.value[c]});
        }
      }
      // The half-way vector has an error of 6e-8, which a narrow lobe enlarges.
      CHECK(worst < 2e-4 + 1e-5 / (roughness * roughness));
      CHECK(least == 0);
      MESSAGE(name << ", roughness " << roughness << ": up to " << worst << " of themselves apart");
    }
  }
}

TEST_CASE("a viewer behind the normal is seen at the smallest cosine at which albedos are evaluated") {
  const Vec3 normal(0, 0, 1);
  const reference::LocalFrame frame(normal);
  const shader::LocalFrame local = shader::frame_around(glm::vec3(normal));
  for (const double z : {-1.0, -0.5, -1e-3, 0.0, 5e-5, 2e-4, 0.3, 1.0}) {
    CAPTURE(z);
    const Vec3 viewer = towards(z, 1);
    const Vec3 ours(shader::seen_from(shader::into_frame(local, glm::vec3(viewer))));
    const Vec3 theirs = frame.seen(viewer);
    const double cosine = std::max(z, double(LEAST_COSINE));
    CHECK(ours.z == doctest::Approx(cosine).epsilon(1e-5));
    CHECK(theirs.z == doctest::Approx(cosine).epsilon(1e-7));
    CHECK(glm::length(theirs) == doctest::Approx(1).epsilon(1e-12));
    CHECK(glm::length(ours - theirs) < 1e-6);
  }
}

TEST_CASE("a shader's samples follow the reference's density, which integrates to 1: chi-squared") {
  check_samples({0.35, 1.0}, {1.0, 0.6, grazing}, 60'000, false);
}

TEST_CASE("a shader's samples follow the reference's density at more roughnesses and angles" *
          doctest::test_suite("long")) {
  check_samples({0.2, 0.5, 1.0}, {1.0, 0.75, 0.35, 0.1, grazing}, 1'000'000, true);
}

TEST_CASE("no BSDF scatters more light than it gets") {
  for (const double roughness : furnace_roughnesses())
    for (const Named& example : examples(roughness))
      for (const double cosine : std::span(cosines).first(size_t(amount(2, 5, 5)))) {
        const std::string& name = example.name;
        CAPTURE(name);
        CAPTURE(roughness);
        CAPTURE(cosine);
        const Vec3 found = albedo(example.bsdf, cosine);
        // Albedos of brushed surfaces, and those under films, are estimates.
        const bool estimated = name.starts_with("brushed") || example.bsdf.film.share > 0;
        CHECK(std::max({found.x, found.y, found.z}) < (estimated ? 1.04 : 1.01));
      }
}

TEST_CASE("a white furnace stays white: rough and smooth, matte, metal and plastic") {
  for (const double roughness : furnace_roughnesses()) {
    for (const double cosine : cosines) {
      CAPTURE(roughness);
      CAPTURE(cosine);
      const Bsdf matte{.diffuse = Vec3(1), .diffuse_roughness = roughness};
      CHECK(albedo(matte, cosine).x == doctest::Approx(1).epsilon(cosine < 0.05 ? 0.01 : 0.003));
      CHECK(albedo(conductor(perfect(), roughness), cosine).x == doctest::Approx(1).epsilon(0.01));
      CHECK(albedo(plastic(1, roughness), cosine).x == doctest::Approx(1).epsilon(0.01));
      CHECK(albedo(cloth(1, roughness), cosine).x ==
            doctest::Approx(1).epsilon(roughness < 0.2 ? 0.05 : 0.01));
      CHECK(albedo(pane(1, roughness), cosine).x == doctest::Approx(1).epsilon(0.01));
      CHECK(albedo(leaf(1, 0.4, roughness), cosine).x == doctest::Approx(1).epsilon(0.01));
      CHECK(albedo(glass(roughness, 1, 1.5), cosine).x == doctest::Approx(1).epsilon(0.01));
      CHECK(albedo(glass(roughness, 1.5, 1), cosine).x == doctest::Approx(1).epsilon(0.01));
    }
  }
}

TEST_CASE("BSDFs are reciprocal: f(o, i) is a photon's f(i, o), for glass by the square of the index") {
  Random random(3);
  for (const double roughness : {0.1, 0.5, 1.0}) {
    for (const Named& example : examples(roughness)) {
      const std::string& name = example.name;
      const Bsdf& bsdf = example.bsdf;
      if (name == "coated aslant")
        continue;  // it has two normals, and each lobe takes its cosines from one of them
      CAPTURE(name);
      CAPTURE(roughness);
      double worst = 0;
      for (int n = 0; n < 5'000; ++n) {
        const Vec3 o = towards(random.uniform(0.05, 1), random.uniform(0, 6));
        const Vec3 i = random.direction();
        if (std::abs(i.z) < 0.05) continue;
        Bsdf back = bsdf;
        const bool through = i.z < 0;
        if (through) std::swap(back.ior_from, back.ior_to);
        // For light that goes through, the other side is above.
        const Vec3 flip(1, 1, through ? -1 : 1);
        const Vec3 there = above(ViewedBsdf(bsdf, o), i).value / std::abs(i.z);
        const Vec3 again = above(ViewedBsdf(back, flip * i).adjoint(), flip * o).value / o.z;
        const double ratio = through ? bsdf.ior_from / bsdf.ior_to : 1;
        const double once = there.x * ratio * ratio, larger = std::max(once, again.x);
        if (larger > 1e-9) worst = std::max(worst, std::abs(once - again.x) / larger);
      }
      CHECK(worst < 1e-7);
    }
  }
}

TEST_CASE(
    "a coat has its own horizon: it reflects below the body's, and hides the body from light behind it") {
  Bsdf bsdf = plastic(0.5, 0.3, 1);
  bsdf.coat_roughness = 0.1;
  bsdf.coat_normal = glm::normalize(Vec3(0.8, 0, 1));
  const Vec3 o = glm::normalize(Vec3(0.4, 0, 1));
  const ViewedBsdf viewed(bsdf, o);
  const Vec3 mirrored = glm::reflect(-o, bsdf.coat_normal);
  REQUIRE(mirrored.z > 0);
  CHECK(viewed.at(mirrored, true).value.x > 1);
  const Vec3 low = glm::normalize(Vec3(1, 0, -0.1));  // above the coat, but below the body
  CHECK(viewed.at(low, true).value.x > 0);
  CHECK(viewed.at(low, false).value.x == 0);
  CHECK(viewed.faces(low, true));
  CHECK(viewed.faces(low, false));
  const Vec3 behind = glm::normalize(Vec3(-1, 0, 0.1));  // behind the coat, but in front of the body
  CHECK(viewed.at(behind, true).value.x > 0);
  CHECK(viewed.at(behind, false).value.x == 0);
  CHECK_FALSE(viewed.faces(behind, false));
  // The adjoint, which photons use, takes the cosines of the other direction.
  const double here = viewed.adjoint().at(mirrored, true).value.x - viewed.at(mirrored, true).value.x;
  CHECK(here != 0);
}
