// Tests of the tangents that meshes of a normal-mapped material get.
#include "host/scene/tangents.hpp"
#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// Two squares beside each other, seen from +z, whose pictures are the same, or mirrored in the middle.
Scene squares(bool mirrored) {
  Scene scene = empty_scene();
  Mesh mesh;
  for (const double x : {0, 1, 2})
    for (const double y : {0, 1}) {
      mesh.positions.push_back({x, y, 0});
      mesh.normals.push_back({0, 0, 1});
      mesh.uv.push_back({mirrored && x == 2 ? 0 : x, y});
    }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}};
  scene.meshes.push_back(mesh);
  scene.instances.push_back({.mesh = 0, .material = add(scene, materials::make_phong({})), .position = {}});
  return scene;
}

}  // namespace

TEST_CASE("without a normal map a mesh gets no tangents") {
  Scene scene = squares(false);
  make_tangents(scene);
  CHECK(scene.meshes[0].tangents.empty());
}

TEST_CASE("tangents run along u; vertices are split where the picture is mirrored") {
  for (const bool mirrored : {false, true}) {
    Scene scene = squares(mirrored);
    scene.materials[0]->normal_map = NormalMap{textures::make_constant(Vec3(0.5, 0.5, 1)), 1};
    make_tangents(scene);
    const Mesh& mesh = scene.meshes[0];
    CHECK(mesh.positions.size() == (mirrored ? 8 : 6));
    REQUIRE(mesh.tangents.size() == mesh.positions.size());
    REQUIRE(mesh.normals.size() == mesh.positions.size());
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
      for (const uint32_t vertex : mesh.triangles[i]) {
        const bool turned = mirrored && i >= 2;
        CHECK(near(Vec3(mesh.tangents[vertex]), Vec3(turned ? -1 : 1, 0, 0), 1e-12));
        CHECK(mesh.tangents[vertex].w == (turned ? -1 : 1));
      }
  }
}

TEST_CASE("a tangent is perpendicular to the normal, and exists even without usable uv") {
  Scene scene = squares(false);
  scene.materials[0]->normal_map = NormalMap{textures::make_constant(Vec3(0.5, 0.5, 1)), 1};
  for (Vec3& normal : scene.meshes[0].normals) normal = glm::normalize(Vec3(0.3, 0.2, 1));
  for (Vec2& uv : scene.meshes[0].uv) uv.y = 0;
  make_tangents(scene);
  for (const Vec4& tangent : scene.meshes[0].tangents) {
    CHECK(near(glm::length(Vec3(tangent)), 1, 1e-12));
    CHECK(near(glm::dot(Vec3(tangent), scene.meshes[0].normals[0]), 0, 1e-12));
  }
}
