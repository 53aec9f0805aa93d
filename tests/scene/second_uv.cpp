// Meshes with second texture coordinates, which some of their pictures read.
#include <algorithm>
#include <bit>

#include "frames.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/tangents.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::compare;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::test;

namespace {

// A picture with random codes from `least` to 255.
std::shared_ptr<const ImageTexture> picture(Random& random, int least) {
  const auto image = std::make_shared<ImageTexture>();
  image->width = 5;
  image->height = 4;
  image->srgb = false;
  const auto code = [&] { return uint8_t(least + random.below(256 - least)); };
  for (int i = 0; i < 20; ++i) image->texels.push_back({code(), code(), code(), 255});
  return image;
}

// A ball with colours at its vertices, shown twice, and a cube without normals. Colours, roughness and the
// coat's normals are pictures on one set of uv, light and the surface's normals on another. Which of the two
// is a mesh's second depends on `swapped`.
Scene ball_and_cube(bool swapped) {
  Scene scene = empty_scene();
  scene.image = {.width = 40, .height = 30, .samples = 4};
  scene.camera.eye = {0, 1, 8};
  scene.camera.target = {0, 0, 0};
  scene.render.ambient = Vec3(0.2);
  scene.render.max_depth = 3;
  add_point_light(scene, {2, 5, 6}, Vec3(40));

  Random random(5);
  const auto image = [&](int least, double tint, bool other) {
    return textures::make_image(picture(random, least), Vec3(tint), {.second_uv = other != swapped});
  };
  PrincipledValues values;
  values.color = image(60, 1, false);
  values.roughness = image(60, 0.8, false);
  values.emission = image(0, 0.7, true);
  values.coat = textures::make_constant(Vec3(0.5));
  const int coated = add(scene, make_principled(values));
  scene.materials[size_t(coated)]->normal_map = NormalMap{image(128, 1, true), 0.5};
  scene.materials[size_t(coated)]->coat_normal_map = NormalMap{image(128, 1, false), 0.5};
  const int plain = add(scene, make_phong({.diffuse = image(60, 1, false), .emission = image(0, 0.7, true)}));
  scene.materials[size_t(plain)]->normal_map = NormalMap{image(128, 1, false), 0.5};

  Mesh ball = globe(16, 8), box = cube();
  ball.colors.assign(ball.positions.size(), Vec3(0.9, 0.7, 0.8));
  for (const Vec2& uv : ball.uv) ball.second_uv.emplace_back(3 * uv.y + 0.2, 0.1 - 2 * uv.x - uv.y);
  for (const Vec3& p : box.positions) {
    box.uv.emplace_back(0.4 * p.x + 0.1 * p.z, 0.4 * p.y);
    box.second_uv.emplace_back(p.z - 0.3 * p.y, 0.7 * p.x);
  }
  for (Mesh* mesh : {&ball, &box})
    if (swapped) std::swap(mesh->uv, mesh->second_uv);
  const int of_ball = add(scene, std::move(ball)), of_box = add(scene, std::move(box));
  Mat4 mirror(1.0);
  mirror[0].x = -0.8;
  add_instance(scene, of_ball, coated, glm::translate(Mat4(1.0), Vec3(-1.3, 0.4, 0)));
  add_instance(scene, of_ball, plain, glm::translate(Mat4(1.0), Vec3(1.4, 0.6, 0.3)) * mirror);
  add_instance(scene, of_box, plain, glm::translate(Mat4(1.0), Vec3(0.1, -1.7, 0.2)));
  make_tangents(scene);
  return scene;
}

bool same_colors(const Frame& a, const Frame& b) {
  return std::ranges::equal(a.color.samples(), b.color.samples(), [](float x, float y) {
    return std::bit_cast<uint32_t>(x) == std::bit_cast<uint32_t>(y);
  });
}

}  // namespace

TEST_CASE("swapping a mesh's two uv sets, and their uses, does not change the picture") {
  for (const IntegratorType integrator :
       {IntegratorType::whitted, IntegratorType::path, IntegratorType::raycast}) {
    CAPTURE(int(integrator));
    Scene one = ball_and_cube(false), other = ball_and_cube(true);
    one.render.integrator = other.render.integrator = integrator;
    CHECK(one.meshes[0].second_tangents);
    CHECK_FALSE(other.meshes[0].second_tangents);
    for (const Backend backend : {Backend::twin, Backend::reference})
      CHECK(same_colors(render_frame(one, backend), render_frame(other, backend)));

    const Frame twin = render_frame(one, Backend::twin);
    CHECK(compare_exactly(render_frame(one, Backend::gpu), twin).passes(0));
    // Paths agree with the reference only on average.
    if (integrator != IntegratorType::path) {
      const ReferenceComparison reference = test::compare_with_reference(one, twin);
      CHECK(reference.first_hits.passes());
      CHECK(reference.colors.unexplained == 0);
    }

    // Without the second set, pictures that read it read the first.
    for (Mesh& mesh : one.meshes) {
      mesh.second_uv.clear();
      mesh.second_tangents = false;
    }
    for (const Backend backend : {Backend::twin, Backend::reference})
      CHECK_FALSE(same_colors(render_frame(one, backend), render_frame(other, backend)));
  }
}
