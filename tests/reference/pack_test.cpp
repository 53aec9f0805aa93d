// The records that shapes and materials write for the shaders.
#include "host/records/packer.hpp"
#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::records;
using namespace eyeray::engine::test;

namespace {

const Vec3 far_eye(100000, 2, 3);

PackedScene packed(const Shape& shape) {
  Packer packer(far_eye);
  shape.pack(packer);
  return packer.scene;
}

PackedScene packed(const Material& material) {
  Packer packer(far_eye);
  material.pack(packer);
  return packer.scene;
}

}  // namespace

TEST_CASE("sphere record") {
  const auto shape = make_sphere(far_eye + Vec3(1, 0.001, 2), 0.5, Mat4(1.0));
  shape->material = 7;
  const PackedScene scene = packed(*shape);
  const auto& record = scene.primitives.at(0);
  CHECK(shader::head_of(record) == shader::uvec4(0u, 7u | shader::KIND_sphere << 24, 0u, NONE));
  CHECK(record.a == shader::vec4(1, 0.001f, 2, 0.5f));
  CHECK(record.b == shader::vec4(0, 1, 0, 0));
  CHECK(record.c == shader::vec4(1, 0, 0, 1));

  // Turned a quarter about z, then mirrored in y.
  const Mat4 turn = glm::rotate(Mat4(1.0), glm::radians(90.0), Vec3(0, 0, 1));
  const auto mirrored =
      packed(*make_sphere({0, 0, 0}, 1, glm::scale(Mat4(1.0), Vec3(1, -1, 1)) * turn)).primitives.at(0);
  CHECK(glm::length(mirrored.b - shader::vec4(-1, 0, 0, 0)) < 1e-7f);
  CHECK(glm::length(mirrored.c - shader::vec4(0, -1, 0, -1)) < 1e-7f);
}

TEST_CASE("plane record: u and v are linear in the eye-relative position") {
  const auto shape = make_plane(far_eye + Vec3(0, -2, 5), {0, 1, 0});
  const auto record = packed(*shape).primitives.at(0);
  CHECK(kind_of(record) == shader::KIND_plane);
  CHECK(record.a == shader::vec4(0, 1, 0, -2));
  CHECK(record.b == shader::vec4(1, 0, 0, 0));
  CHECK(record.c == shader::vec4(0, 0, -1, 5));
}

TEST_CASE("triangle record") {
  TriangleValues values{
      .vertices = {far_eye + Vec3(1, 2, 3), far_eye + Vec3(2, 2, 3), far_eye + Vec3(1, 3, 3)}};
  PackedScene scene = packed(*make_triangle(values));
  CHECK(shader::head_of(scene.primitives.at(0)) == shader::uvec4(0u, shader::KIND_triangle << 24, 0u, NONE));
  CHECK(scene.primitives.at(0).a == shader::vec4(1, 2, 3, 0));
  CHECK(scene.primitives.at(0).b == shader::vec4(2, 2, 3, 0));
  CHECK(scene.primitives.at(0).c == shader::vec4(1, 3, 3, 1));
  CHECK(scene.vertices.empty());

  values.uv = {{Vec2(1, 4), Vec2(2, 5), Vec2(3, 6)}};
  scene = packed(*make_triangle(values));
  CHECK(scene.primitives.at(0).extra == 3);
  CHECK(scene.vertices == RawVector<shader::uvec4>{to_bits({0, 0, 1, 1}), to_bits({0, 0, 1, 2}),
                                                   to_bits({0, 0, 1, 3}), shader::uvec4(0, 1, 2, CORNERS_UV),
                                                   to_bits({4, 5, 6, 0})});

  values.uv.reset();
  values.normals = {{Vec3(0, 0, 2), Vec3(0, 3, 4), Vec3(0, 0, 1)}};
  scene = packed(*make_triangle(values));
  REQUIRE(scene.vertices.size() == 5);
  CHECK(glm::length(std::bit_cast<shader::vec4>(scene.vertices[1]) - shader::vec4(0, 0.6f, 0.8f, 0)) < 1e-7f);
  CHECK(scene.vertices[2] == to_bits({0, 0, 1, 0}));
  CHECK(scene.vertices[3] == shader::uvec4(0, 1, 2, CORNERS_NORMALS));
}

TEST_CASE("material records") {
  const auto color = [](const PackedScene& scene, uint32_t shader::Material::* texture) {
    return scene.textures.at(scene.materials.at(0).*texture).color;
  };
  const Highlight blinn{textures::make_constant(Vec3(0.25)), 50, true};
  const PackedScene phong = packed(*make_phong({.diffuse = textures::make_constant(Vec3(0.5)),
                                                .reflectance = textures::make_constant(Vec3(0.125)),
                                                .highlight = blinn}));
  CHECK(phong.materials.at(0).kind == shader::MATERIAL_phong);
  CHECK(phong.materials.at(0).flags == MATERIAL_BLINN);
  CHECK(phong.materials.at(0).medium == 0);
  CHECK(phong.materials.at(0).optical_depth == OPTICAL_DEPTH_OPAQUE);
  CHECK(phong.materials.at(0).shininess == 50);
  CHECK(color(phong, &shader::Material::base) == glm::vec3(0.5f));
  CHECK(color(phong, &shader::Material::specular) == glm::vec3(0.25f));
  CHECK(color(phong, &shader::Material::reflected) == glm::vec3(0.125f));
  CHECK(color(phong, &shader::Material::ambient) == glm::vec3(0.5f));

  const PackedScene mirror = packed(*make_mirror({.reflectance = textures::make_constant(Vec3(0.75))}));
  CHECK(mirror.materials.at(0).kind == shader::MATERIAL_mirror);
  CHECK(mirror.materials.at(0).optical_depth == OPTICAL_DEPTH_OPAQUE);
  CHECK(color(mirror, &shader::Material::color) == glm::vec3(0.75f));
  CHECK(color(mirror, &shader::Material::reflected) == glm::vec3(0.75f));
  CHECK(color(mirror, &shader::Material::ambient) == glm::vec3(0));

  const PackedScene glass = packed(*make_dielectric({.ior = 1.5, .absorption = {1, 2, 3}, .shadow = 0.25}));
  CHECK(glass.materials.at(0).kind == shader::MATERIAL_dielectric);
  CHECK(glass.materials.at(0).medium == 1);
  CHECK(glass.materials.at(0).optical_depth == 2u << 20);
  CHECK(glass.media.at(1).absorption == shader::vec3(1, 2, 3));
  CHECK(glass.media.at(1).ior == 1.5f);
  CHECK(color(glass, &shader::Material::color) == glm::vec3(1));
  CHECK(color(glass, &shader::Material::reflected) == glm::vec3(1));
  CHECK(packed(*make_dielectric({.ior = 1})).materials.at(0).optical_depth == 0);
  CHECK(packed(*make_dielectric({.shadow = 0.0})).materials.at(0).optical_depth == OPTICAL_DEPTH_OPAQUE);
}
