// materials/bent_normal.glsl: it bends normals as the reference does, and the viewer's mirror direction
// stays above the surface.
#include <algorithm>
#include <cmath>

#include "host/materials/make.hpp"
#include "host/reference/bent_normal.hpp"
#include "host/textures/make.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::records;
using test::Random;

namespace {

// A point on some surface, for the reference and for the shaders.
struct Hit {
  SurfacePoint point;
  shader::Surface surface;
  Vec3 d;  // direction of the ray that hits the point
};

Hit some_hit(Random& random, bool own_tangent) {
  const Vec3 n = random.direction(), bent = glm::normalize(n + random.uniform(0, 0.8) * random.direction());
  const auto tangential = [&](const Vec3& v) { return v - n * glm::dot(n, v); };
  SurfacePoint point{.position = random.point(1),
                     .position_error = 0,
                     .normal_geometric = n,
                     .normal = bent,
                     .uv = {random.uniform(), random.uniform()}};
  const Vec3 u = tangential(random.direction()), v = tangential(random.direction());
  point.along_u = random.uniform(0.2, 2) * glm::normalize(u);
  point.along_v = random.uniform(0.2, 2) * glm::normalize(v);
  if (own_tangent) point.tangent = Vec4(random.direction(), random.below(2) == 0 ? 1 : -1);

  shader::Surface surface = shader::no_surface();
  surface.p = glm::vec3(point.position);
  surface.normal_geometric = glm::vec3(n);
  surface.normal = glm::vec3(bent);
  surface.uv = glm::vec2(point.uv);
  shader::set_tangents(surface, glm::vec3(point.along_u), glm::vec3(point.along_v));
  surface.tangent = glm::vec4(point.tangent);
  Vec3 d;
  do d = random.direction();
  while (std::abs(glm::dot(d, n)) < 0.01);
  return {point, surface, d};
}

// The surface's normal and a coat's, and the direction along which it is rougher.
struct Normals {
  Vec3 normal;
  Vec3 coat;
  Vec3 rough_axis;
};

// The normals by the reference, with that material.
Normals expected(const Material& material, const Hit& hit) {
  SurfacePoint point = hit.point;
  reference::bend_normals(material, point, hit.d);
  return {point.normal, point.coat_normal, point.rough_axis};
}

// The normals by the shader.
Normals shaded(const Material& material, const Hit& hit) {
  Packer packer(Vec3(0));
  shader::Material record{};
  record.normal_map = material.normal_map ? material.normal_map->texture->pack(packer) : NONE;
  record.normal_scale = material.normal_map ? float(material.normal_map->scale) : 0;
  record.coat_normal = material.coat_normal_map ? material.coat_normal_map->texture->pack(packer) : NONE;
  record.coat_normal_scale = material.coat_normal_map ? float(material.coat_normal_map->scale) : 0;
  record.bump = material.bump_map ? material.bump_map->texture->pack(packer) : NONE;
  if (material.bump_map) {
    record.bump_height = float(material.bump_map->height);
    record.bump_width = float(material.bump_map->width);
  }
  if (const auto& axis = material.rough_axis) {
    record.flags = MATERIAL_ANISOTROPIC;
    record.anisotropy_direction = axis->texture ? axis->texture->pack(packer) : NONE;
    record.anisotropy_turn = glm::vec2(Vec2(std::cos(axis->turn), std::sin(axis->turn)));
  }
  packer.write_texels();
  const shader::Binding binding(twin::view_of(packer.scene));
  const shader::Surface bent = shader::bent_by(record, hit.surface, glm::vec3(hit.d));
  return {Vec3(bent.normal), Vec3(bent.coat_normal), Vec3(bent.rough_axis)};
}

void check_alike(const Material& material, const Hit& hit) {
  const Normals there = expected(material, hit), here = shaded(material, hit);
  CHECK(glm::length(here.normal - there.normal) < 2e-4);
  CHECK(glm::length(here.coat - there.coat) < 2e-4);
  CHECK(glm::length(here.rough_axis - there.rough_axis) < 2e-4);
}

double cross(const Hit& hit) {
  return glm::length(glm::cross(glm::normalize(hit.point.along_u), glm::normalize(hit.point.along_v)));
}

}  // namespace

TEST_CASE("a normal map bends normals as in the reference, by uv and by a mesh's tangents") {
  Random random{3};
  for (int i = 0; i < 20'000; ++i) {
    const Hit hit = some_hit(random, i % 2 == 0);
    if (cross(hit) < 0.1) continue;
    const auto material = materials::make_phong({});
    material->normal_map =
        NormalMap{textures::make_constant({random.uniform(), random.uniform(), random.uniform(0.4, 1)}),
                  random.uniform(-1.5, 1.5)};
    check_alike(*material, hit);
  }
}

TEST_CASE("a coat is bent by its own normal map alone") {
  Random random{6};
  for (int i = 0; i < 2'000; ++i) {
    const Hit hit = some_hit(random, i % 2 == 0);
    if (cross(hit) < 0.1) continue;
    const auto material = materials::make_principled({.coat = textures::make_constant(Vec3(1))});
    material->normal_map =
        NormalMap{textures::make_constant({random.uniform(), random.uniform(), random.uniform(0.4, 1)}), 1};
    CHECK(expected(*material, hit).coat == hit.point.normal);
    check_alike(*material, hit);
    const Vec3 body = expected(*material, hit).normal;
    material->coat_normal_map = material->normal_map;
    check_alike(*material, hit);
    CHECK(expected(*material, hit).coat == body);
  }
}

TEST_CASE("a surface is rougher along u, or along a map's direction, turned from u to v") {
  Random random{8};
  for (int i = 0; i < 5'000; ++i) {
    const Hit hit = some_hit(random, i % 2 == 0);
    if (cross(hit) < 0.1) continue;
    const auto material = materials::make_principled({.anisotropy = textures::make_constant(Vec3(1))});
    REQUIRE(material->rough_axis);
    const double turn = random.uniform(0, 6);
    material->rough_axis->turn = turn;
    check_alike(*material, hit);
    const Vec3 n = hit.point.normal, axis = expected(*material, hit).rough_axis;
    CHECK(glm::length(axis) == doctest::Approx(1));
    CHECK(std::abs(glm::dot(axis, n)) < 1e-9);
    // A map that points along v is a quarter turn.
    material->rough_axis->texture = textures::make_constant({0.5, 1, 0});
    material->rough_axis->turn = turn - M_PI / 2;
    check_alike(*material, hit);
    CHECK(glm::length(expected(*material, hit).rough_axis - axis) < 1e-9);
    // Without a turn, the axis is u's direction, made perpendicular to the normal.
    *material->rough_axis = RoughAxis{};
    const Vec3 along = i % 2 == 0 ? Vec3(hit.point.tangent) : hit.point.along_u;
    CHECK(glm::length(expected(*material, hit).rough_axis - glm::normalize(along - n * glm::dot(n, along))) <
          1e-9);
  }
}

TEST_CASE("bumps bend normals as in the reference, and by Blinn's formula") {
  Random random{4};
  const auto image = std::make_shared<ImageTexture>();
  image->width = image->height = 8;
  image->srgb = false;
  for (int i = 0; i < 64; ++i) {
    const auto code = uint8_t(random.below(256));
    image->texels.push_back({code, code, code, 255});
  }
  const TexturePtr texture = textures::make_image(image);
  for (int i = 0; i < 20'000; ++i) {
    const Hit hit = some_hit(random, false);
    if (cross(hit) < 0.1) continue;
    const auto material = materials::make_phong({});
    material->bump_map = BumpMap{texture, random.uniform(-0.2, 0.2), 0.125};
    check_alike(*material, hit);
  }
}

TEST_CASE("bent normals reflect the viewer's ray above the surface; high enough normals are unchanged") {
  Random random{5};
  int low = 0, high = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Hit hit = some_hit(random, false);
    if (cross(hit) < 0.1) continue;
    const auto material = materials::make_phong({});
    const Vec3 code(random.uniform(), random.uniform(), random.uniform());
    material->normal_map = NormalMap{textures::make_constant(code), 1};
    const Vec3 up =
        hit.point.normal_geometric * (glm::dot(hit.d, hit.point.normal_geometric) < 0 ? 1.0 : -1.0);
    const double side = glm::dot(up, hit.point.normal_geometric);
    for (const Vec3 n : {side * expected(*material, hit).normal, side * shaded(*material, hit).normal}) {
      CHECK(std::abs(glm::length(n) - 1) < 1e-5);
      CHECK(glm::dot(n, up) > 0);
      CHECK(glm::dot(n, hit.d) < 1e-5);
      const double mirrored = glm::dot(glm::reflect(hit.d, n), up);
      CHECK(mirrored > 0);
      ++(mirrored < 2e-3 ? low : high);
    }
  }
  // Both cases are common.
  CHECK(low > 1000);
  CHECK(high > 1000);
}
