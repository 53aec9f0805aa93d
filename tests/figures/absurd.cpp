// Shapes of absurd sizes and proportions: each is refused with an error, or both its halves can compute with
// it.
#include <fmt/format.h>

#include <cmath>

#include "host/loader/scene_file.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/registry.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::records;
using test::Random;

namespace {

// A number as text: a sensible size, or an absurd one.
std::string some_number(Random& random) {
  constexpr double absurd[] = {0, -1, 1, 1e-300, 1e-12, 1e-7, 1 - 1e-7, 1 + 1e-7, 1e6, 1e12, 1e300};
  if (random.below(2) == 0) return fmt::format("{}", random.uniform(-2, 2));
  return fmt::format("{}", absurd[random.below(int(std::size(absurd)))]);
}

std::string some_vector(Random& random) {
  return fmt::format("[{}, {}, {}]", some_number(random), some_number(random), some_number(random));
}

// A table of the shape; empty if a key has a type for which this test has no absurd values.
std::string some_table(Random& random, const shapes::ShapeType& type) {
  std::string text = fmt::format("[[{}]]\nmaterial = \"m\"\n", type.name);
  std::string vector;  // the last vector, which the next key may repeat
  for (const Key& key : type.keys) {
    if (key.type == KeyType::vec3) {
      if (vector.empty() || random.below(4) != 0) vector = some_vector(random);
      text += fmt::format("{} = {}\n", key.name, vector);
    } else if (key.type == KeyType::number) {
      text += fmt::format("{} = {}\n", key.name, some_number(random));
    } else if (key.type == KeyType::boolean) {
      text += fmt::format("{} = {}\n", key.name, random.below(2) == 0);
    } else {
      return "";
    }
  }
  return text;
}

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// True if the ray from `from` has a valid result in both halves: no hit, or a surface of finite values with a
// unit normal.
bool can_be_hit(const Shape& shape, const PackedScene& packed, const Vec3& from, const Vec3& target) {
  const shader::Ray ray = shader::make_ray(glm::vec3(from), glm::vec3(glm::normalize(target - from)));
  const shader::Primitive& primitive = packed.primitives[0];
  shader::Hit hit{};
  shader::Surface surface{};
#define SHOOT(name, number)                                   \
  if (kind_of(primitive) == number) {                         \
    hit.t = shader::name##_intersect(primitive, ray, hit.uv); \
    if (hit.t > 0 && hit.t < T_MISS)                          \
      surface = shader::name##_surface(primitive, ray, hit);  \
    else                                                      \
      surface.normal_geometric = glm::vec3(1, 0, 0);          \
  }
  SHAPES(SHOOT)
  if (!finite(Vec3(surface.p)) || !std::isfinite(surface.offset)) return false;
  if (!std::isfinite(surface.uv.x) || !std::isfinite(surface.uv.y)) return false;
  if (std::fabs(glm::length(Vec3(surface.normal_geometric)) - 1) > 1e-3) return false;

  const auto exact = shape.intersect({Vec3(ray.o), Vec3(ray.d)});
  if (!exact) return true;
  const SurfacePoint point = shape.surface({Vec3(ray.o), Vec3(ray.d)}, *exact);
  return exact->t > 0 && finite(point.position) && finite(Vec3(point.uv, 0)) &&
         std::fabs(glm::length(point.normal_geometric) - 1) < 1e-6;
}

// The same for a ray from a random point to a random target in the shape's bounds; false if these are
// infinite.
bool can_be_hit(const Shape& shape, const PackedScene& packed, Random& random) {
  const Bounds bounds = shape.bounds();
  if (!finite(bounds.min) || !finite(bounds.max)) return false;
  const Vec3 center = (bounds.min + bounds.max) * 0.5;
  const double radius = glm::length(bounds.max - bounds.min) * 0.5;
  const Vec3 target = center + random.direction() * radius * random.uniform(0, 1);
  return can_be_hit(shape, packed, target + random.direction() * radius * random.log_uniform(0.01, 100),
                    target);
}

}  // namespace

TEST_CASE("absurd shapes are refused or give finite results") {
  for (const shapes::ShapeType* type : shapes::types()) {
    Random random{7};
    int accepted = 0, refused = 0, wrong = 0;
    std::string first_wrong;
    for (int i = 0; i < test::amount(1000, 3000, 3000); ++i) {
      const std::string table = some_table(random, *type);
      if (table.empty() || type->name == "plane") break;
      Scene scene = test::empty_scene();
      try {
        scene = parse_scene("[[material]]\nname = \"m\"\ntype = \"phong\"\n" + table, "a");
      } catch (const InputError& error) {
        REQUIRE_FALSE(error.diagnostics().empty());
        ++refused;
        continue;
      }
      ++accepted;
      const Shape& shape = *scene.shapes[0];
      Packer packer(Vec3(0));
      shape.pack(packer);
      const shader::Binding binding(twin::view_of(packer.scene));
      for (int k = 0; k < 20; ++k) {
        if (can_be_hit(shape, packer.scene, random)) continue;
        if (wrong++ == 0) first_wrong = table;
      }
    }
    MESSAGE(fmt::format("{}: {} refused, {} accepted", type->name, refused, accepted));
    CHECK_MESSAGE(wrong == 0, first_wrong);
  }
}

TEST_CASE("a cone has uv at its tip, however flat, and on a tip cap that rounding shrinks to a point") {
  Random random{8};
  for (const double radius : {1.0, 1e5, 1e9, 1e12})
    for (const double tip : {0.0, 1e-9, 1.05}) {
      if (tip > 0 && tip > 1e-6 * radius) continue;
      const auto cone = make_cone({0, 0, 0}, {0, 10, 0}, radius, tip);
      Packer packer(Vec3(0));
      cone->pack(packer);
      const shader::Binding binding(twin::view_of(packer.scene));
      CAPTURE(radius);
      CAPTURE(tip);
      int wrong = 0;
      for (int i = 0; i < 1000; ++i) {
        const Vec3 sideways =
            i == 0 ? Vec3(0) : random.direction() * radius * random.log_uniform(1e-10, 1e-6);
        const Vec3 target(sideways.x, 10, sideways.z);
        const Vec3 from = i < 2 ? Vec3(target.x, 20, target.z) : target + random.direction() * 10.0;
        wrong += !can_be_hit(*cone, packer.scene, from, target);
      }
      CHECK(wrong == 0);
    }
}
