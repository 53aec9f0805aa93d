// Points chosen by the solid angle of an area light: by the shaders and by the reference.
#include <cmath>
#include <functional>
#include <vector>

#include "host/pack/emitter_records.hpp"
#include "host/reference/emitter_sample.hpp"
#include "host/twin/shader_functions.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using test::Random;

namespace {

shader::Emitter record_of(const EmitterForm& form) {
  records::Packer packer(Vec3(0));
  pack::pack_light_choice({.emitters = {{0, Vec3(1), form, area_of(form)}}, .ends = {1u << 24}}, packer);
  return packer.scene.emitters[0];
}

// The solid angle of a triangle by van Oosterom, Strackee: The Solid Angle of a Plane Triangle, 1983. Corners
// are relative to the point.
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  return 2 * std::atan2(std::abs(glm::dot(a, glm::cross(b - a, c - a))),
                        la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

// The solid angle of a rectangle in the plane at z, seen from the origin: a sum over its corners.
double solid_angle_of_rectangle(const Vec2& low, const Vec2& high, double z) {
  const auto corner = [&](double x, double y) {
    return std::atan(x * y / (z * std::sqrt(x * x + y * y + z * z)));
  };
  return corner(high.x, high.y) - corner(low.x, high.y) - corner(high.x, low.y) + corner(low.x, low.y);
}

// An area light whose surface is cut into cells, and each cell's solid angle from a point.
struct CutEmitter {
  EmitterForm form;
  std::function<size_t(const Vec2& uv)> cell;
  std::vector<double> solid_angles;
};

constexpr int cuts = 6;

size_t slice(double share) {
  return size_t(std::min(std::max(int(share * cuts), 0), cuts - 1));
}

CutEmitter cut(const ParallelogramForm& it, const Vec3& from) {
  CutEmitter emitter{it, [](const Vec2& uv) { return slice(uv.x) * cuts + slice(uv.y); }, {}};
  for (int i = 0; i < cuts; ++i)
    for (int k = 0; k < cuts; ++k) {
      const auto corner = [&](int x, int y) {
        return it.corner + double(x) / cuts * it.edge_u + double(y) / cuts * it.edge_v - from;
      };
      const Vec3 a = corner(i, k), b = corner(i + 1, k), c = corner(i + 1, k + 1), d = corner(i, k + 1);
      emitter.solid_angles.push_back(solid_angle(a, b, c) + solid_angle(a, c, d));
    }
  return emitter;
}

// Cuts a triangle by lines through the first corner and lines along the opposite edge.
CutEmitter cut(const TriangleForm& it, const Vec3& from) {
  CutEmitter emitter{it,
                     [](const Vec2& weights) {
                       const double out = weights.x + weights.y;
                       return slice(out) * cuts + slice(out > 0 ? weights.y / out : 0);
                     },
                     {}};
  const Vec3 &a = it.vertices[0], &b = it.vertices[1], &c = it.vertices[2];
  for (int i = 0; i < cuts; ++i)
    for (int k = 0; k < cuts; ++k) {
      const auto point = [&](int out, int along) {
        return a + double(out) / cuts * (b - a + double(along) / cuts * (c - b)) - from;
      };
      const Vec3 near0 = point(i, k), near1 = point(i, k + 1), far0 = point(i + 1, k),
                 far1 = point(i + 1, k + 1);
      const double whole = solid_angle(near0, far0, far1);
      emitter.solid_angles.push_back(i == 0 ? whole : whole + solid_angle(near0, far1, near1));
    }
  return emitter;
}

// The excess of χ² over its expectation, in standard deviations, for points that should be uniform by solid
// angle.
double excess(const CutEmitter& emitter, const std::function<Vec2(const shader::vec2&)>& uv_of) {
  constexpr int count = 1 << 16;
  Random random(7);
  std::vector<int> found(emitter.solid_angles.size());
  for (int i = 0; i < count; ++i)
    ++found[emitter.cell(
        uv_of({float(random.below(1 << 24)) * 0x1p-24f, float(random.below(1 << 24)) * 0x1p-24f}))];
  double all = 0, chi_squared = 0, degrees = -1;
  for (const double one : emitter.solid_angles) all += one;
  // Cells with few expected points count as one.
  double few_expected = 0, few_found = 0;
  const auto add = [&](double expected, double observed) {
    chi_squared += (observed - expected) * (observed - expected) / expected;
    degrees += 1;
  };
  for (size_t i = 0; i < found.size(); ++i) {
    const double expected = emitter.solid_angles[i] / all * count;
    if (expected >= 10) {
      add(expected, found[i]);
    } else {
      few_expected += expected;
      few_found += found[i];
    }
  }
  if (few_expected >= 10) add(few_expected, few_found);
  return (chi_squared - degrees) / std::sqrt(2 * degrees);
}

double both_excess(const CutEmitter& emitter, const Vec3& from) {
  double all = 0;
  for (const double one : emitter.solid_angles) all += one;
  CHECK(all > 0.011);
  CHECK(all < 6.2);
  const shader::Emitter record = record_of(emitter.form);
  const double ours = excess(emitter, [&](const shader::vec2& u) {
    return Vec2(shader::sample_emitter(record, shader::vec3(from), u).uv);
  });
  const double theirs = excess(emitter, [&](const shader::vec2& u) {
    return reference::sample_emitter(emitter.form, from, Vec2(u)).uv;
  });
  return std::max(ours, theirs);
}

const Vec3 corner(-0.5, 0.25, -0.25), along(1.5, 0.25, 0.125), across(0.25, 0.5, -0.5);
const Vec3 upright = 0.8 * glm::normalize(glm::cross(glm::cross(along, across), along));

// Points from which area lights near the origin are seen.
const Vec3 points[] = {
    {0.6, 0.9, 1},                            // as far as they are large
    {-0.45, 0.27, -0.2},                      // next to a corner
    {0.3, 0.6, -0.45},                        // next to the surface
    {0.1, -0.6, 0.4},    {-1.5, 0.5, -0.35},  // nearly edge-on
};

}  // namespace

TEST_CASE("points on rectangles, triangles and parallelograms are uniform by solid angle") {
  CHECK(is_rectangle({corner, along, upright}));
  CHECK(!is_rectangle({corner, along, across}));
  for (const Vec3& from : points) {
    CAPTURE(from.x);
    CHECK(both_excess(cut(ParallelogramForm{corner, along, upright}, from), from) < 4.5);
    CHECK(both_excess(cut(ParallelogramForm{corner, along, across}, from), from) < 4.5);
    CHECK(both_excess(cut(TriangleForm{{corner, corner + along, corner + across}}, from), from) < 4.5);
  }
}

TEST_CASE("the density on flat emitters is 1 / solid angle, by closed forms") {
  Random random(9);
  const auto anywhere = [&](double reach) {
    return Vec3(random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach));
  };
  double apart = 0;
  int by_angle = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 from(shader::vec3(anywhere(2)));
    // A rectangle in a plane perpendicular to z, where its solid angle has a closed form.
    const Vec2 low(random.uniform(-2, 2), random.uniform(-2, 2)),
        size(random.uniform(0.1, 3), random.uniform(0.1, 3));
    const double z = random.uniform(-2, 2);
    const ParallelogramForm rectangle{{low, z}, {size.x, 0, 0}, {0, size.y, 0}};
    const Vec2 seen = low - Vec2(from);
    const double expected = solid_angle_of_rectangle(seen, seen + size, std::abs(z - from.z));
    const Vec3 a = anywhere(1), b = anywhere(1), c = anywhere(1);
    const std::pair<EmitterForm, double> forms[] = {
        {rectangle, expected},
        {TriangleForm{{a, b, c}}, solid_angle(a - from, b - from, c - from)},
        {ParallelogramForm{a, b, c}, solid_angle(a - from, a + b - from, a + b + c - from) +
                                         solid_angle(a - from, a + b + c - from, a + c - from)}};
    for (const auto& [form, omega] : forms) {
      // Seen edge-on, the density depends on rounding.
      if (!(omega > 0.011 && omega < 6)) continue;
      ++by_angle;
      const Vec3 nowhere(1e3, 1e3, 1e3);
      const double ours = double(shader::emitter_density(record_of(form), shader::vec3(from),
                                                         {shader::vec3(nowhere), {0, 1, 0}, {0, 0}}));
      const double theirs = reference::emitter_density(form, from, {nowhere, {0, 1, 0}});
      CHECK(theirs * omega == doctest::Approx(1).epsilon(1e-9));
      const double edge_on = std::abs(glm::dot(glm::normalize(point_of(form) - from), normal_of(form)));
      apart = std::max(apart, std::abs(ours * omega - 1) * edge_on);
    }
  }
  CHECK(by_angle > 20'000);
  MESSAGE("densities are up to " << apart << " of themselves off");
  CHECK(apart < 4e-6);
}

TEST_CASE("an emitter of tiny solid angle, or seen from its own plane, is sampled by area") {
  const EmitterForm forms[] = {ParallelogramForm{corner, along, upright},
                               ParallelogramForm{corner, along, across},
                               TriangleForm{{corner, corner + along, corner + across}}};
  const Vec3 here[] = {Vec3(900, 400, -700), corner - 2.0 * along, corner + 0.25 * along + 0.25 * across,
                       corner};
  for (const EmitterForm& form : forms) {
    const shader::Emitter record = record_of(form);
    for (const Vec3& from : here)
      for (const float x : {0.0f, 0.25f, 1 - 0x1p-24f})
        for (const float y : {0.0f, 0.25f, 1 - 0x1p-24f}) {
          const bool triangle = std::holds_alternative<TriangleForm>(form);
          const Vec2 expected = triangle ? std::sqrt(double(x)) * Vec2(1 - double(y), y) : Vec2(x, y);
          const Vec2 ours(shader::sample_emitter(record, shader::vec3(from), {x, y}).uv);
          const Vec2 theirs = reference::sample_emitter(form, from, Vec2(x, y)).uv;
          CHECK(glm::length(ours - expected) < 1e-6);
          CHECK(glm::length(theirs - expected) < 1e-6);
        }
  }
}

TEST_CASE("a sampled point of an area light is never outside of it, whatever the shading point") {
  Random random(11);
  int beside = 0;
  for (int i = 0; i < 200'000; ++i) {
    const double near = std::pow(10, random.uniform(-7, 1));
    const Vec3 offset(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const Vec3 from = corner + random.uniform(0, 1) * along + random.uniform(0, 1) * across + near * offset;
    const auto number = [&] {
      const int kind = random.below(8);
      return kind == 0 ? 0.0f : kind == 1 ? 1 - 0x1p-24f : float(random.below(1 << 24)) * 0x1p-24f;
    };
    const shader::vec2 u{number(), number()};
    for (const EmitterForm& form : {EmitterForm(ParallelogramForm{corner, along, upright}),
                                    EmitterForm(ParallelogramForm{corner, along, across}),
                                    EmitterForm(TriangleForm{{corner, corner + along, corner + across}})}) {
      const shader::EmitterSample point = shader::sample_emitter(record_of(form), shader::vec3(from), u);
      const bool triangle = std::holds_alternative<TriangleForm>(form);
      const float most = triangle ? point.uv.x + point.uv.y : std::max(point.uv.x, point.uv.y);
      const bool on_it = point.uv.x >= 0 && point.uv.y >= 0 && most <= 1 + 2e-7f;
      beside += !on_it || !std::isfinite(point.p.x + point.p.y + point.p.z);
    }
  }
  CHECK(beside == 0);
}
