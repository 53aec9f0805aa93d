// Light and shadow of smoothed coarse meshes, against the curved bodies that they approximate.
#include <algorithm>
#include <cmath>
#include <vector>

#include "host/executors/executor.hpp"
#include "host/scene/integrator.hpp"
#include "tests/support/meshes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;
using namespace eyeray::engine::materials;
using executors::Backend;

namespace {

constexpr int width = 48;

// The picture of [−1, 1]² by an orthographic camera at that height, row by row from the top.
std::vector<double> picture_of(Scene& scene, Backend backend, double height = 5) {
  scene.image = {.width = width, .height = width};
  scene.camera.eye = {0, 0, height};
  scene.camera.projection = cameras::make_projection(OrthographicCamera{.size = 1});
  scene.render.background = scene.render.ambient = Vec3(0);
  const Rect all{0, 0, width, width};
  std::vector<PixelSample> samples(size_t(all.pixels()));
  executors::make_executor(backend, scene, {})->sample(all, 0, samples);
  std::vector<double> colors;
  for (const PixelSample& sample : samples) colors.push_back(sample.color.x);
  return colors;
}

}  // namespace

TEST_CASE("a coarse smooth ball is lit like a round one: by Lambert's cosine, up to the terminator") {
  const Vec3 to_sun = glm::normalize(Vec3(1, 0.4, 0.2));
  const Mat4 small = glm::scale(Mat4(1.0), Vec3(0.5));
  for (const auto integrator : {IntegratorType::whitted, IntegratorType::path, IntegratorType::sppm})
    for (const bool instances : {false, true})
      for (const Backend backend : {Backend::twin, Backend::reference}) {
        CAPTURE(int(integrator));
        CAPTURE(instances);
        CAPTURE(int(backend));
        Scene scene = empty_scene();
        scene.render.integrator = integrator;
        scene.render.max_depth = 0;
        const int white = add(scene, make_phong({.diffuse = gray(1)}));
        Mesh ball = globe(16, 8);
        for (Vec3& p : ball.positions) p *= 2.0;
        const int mesh = add(scene, std::move(ball));
        add_instance(scene, mesh, white, small);
        if (instances) add_instance(scene, mesh, white, translation({0, 0, -50}) * small);
        add_sun(scene, to_sun, Vec3(1));
        const std::vector<double> colors = picture_of(scene, backend);
        double apart = 0;
        int seen = 0, black = 0;
        for (int i = 0; i < width * width; ++i) {
          const double x = (i % width + 0.5) / width * 2 - 1, y = 1 - (i / width + 0.5) / width * 2;
          if (x * x + y * y > 0.72) continue;
          const double expected = std::max(0.0, glm::dot(to_sun, Vec3(x, y, std::sqrt(1 - x * x - y * y))));
          apart += std::abs(colors[size_t(i)] - expected);
          black += expected > 0.06 && colors[size_t(i)] < 0.01;
          ++seen;
        }
        CHECK(black == 0);
        CHECK(apart / seen < 0.02);
      }
}

TEST_CASE("a coarse smooth ball that glows does not light itself, as a round one does not") {
  for (const Backend backend : {Backend::twin, Backend::reference}) {
    CAPTURE(int(backend));
    Scene scene = empty_scene();
    scene.render.integrator = IntegratorType::path;
    scene.render.max_depth = 4;
    const int glowing = add(scene, make_phong({.diffuse = gray(0.5), .emission = gray(3)}));
    Mesh ball = globe(16, 8);
    for (Vec3& p : ball.positions) p *= 2.0;
    add_instance(scene, add(scene, std::move(ball)), glowing, glm::scale(Mat4(1.0), Vec3(0.5)));
    const std::vector<double> colors = picture_of(scene, backend);
    for (const double color : colors) CHECK((color == 0 || std::abs(color - 3) < 1e-5));
    CHECK(std::ranges::count(colors, 0.0) < width * width / 2);
  }
}

TEST_CASE("all executors share out the light of a glowing smooth ring alike") {
  // Lights are chosen by a BVH. It does not ask for those behind a facet's plane, which a lifted start may
  // see.
  Mesh ring;
  const int around = 12, across = 8;
  for (int i = 0; i < around * across; ++i) {
    const double u = 2 * M_PI * (i / across) / around, v = 2 * M_PI * (i % across) / across;
    const Vec3 out(std::cos(u), std::sin(u), 0), normal = std::cos(v) * out + Vec3(0, 0, std::sin(v));
    ring.positions.push_back(0.6 * out + 0.3 * normal);
    ring.normals.push_back(normal);
    const auto corner = [&](int along_u, int along_v) {
      return uint32_t((i / across + along_u) % around * across + (i % across + along_v) % across);
    };
    ring.triangles.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
    ring.triangles.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
  }
  Scene scene = empty_scene();
  scene.render.integrator = IntegratorType::path;
  scene.render.max_depth = 1;
  add_instance(scene, add(scene, std::move(ring)),
               add(scene, make_phong({.diffuse = gray(0.9), .emission = gray(1)})));
  const std::vector<double> twin = picture_of(scene, Backend::twin),
                            reference = picture_of(scene, Backend::reference);
  int differ = 0, lit = 0;
  for (size_t i = 0; i < twin.size(); ++i) {
    differ += std::abs(twin[i] - reference[i]) > 1e-4 * reference[i];
    lit += reference[i] > 1.01;
  }
  CHECK(lit > 100);
  CHECK(differ <= 3);
}

TEST_CASE("wild normals do not let light through a wall a quarter of an edge away") {
  for (const auto integrator : {IntegratorType::whitted, IntegratorType::path})
    for (const Backend backend : {Backend::twin, Backend::reference}) {
      CAPTURE(int(integrator));
      CAPTURE(int(backend));
      Scene scene = empty_scene();
      scene.render.integrator = integrator;
      scene.render.max_depth = 0;
      const int white = add(scene, make_phong({.diffuse = gray(1)}));
      // The face z = 0 of a cube of edge 1, with the normals of a ball. Its longest edge is the diagonal.
      Mesh face =
          make_mesh({{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}}, {{0, 1, 2}, {0, 2, 3}});
      for (const Vec3& p : face.positions) face.normals.push_back(glm::normalize(p + Vec3(0, 0, 0.5)));
      add_instance(scene, add(scene, std::move(face)), white);
      // The camera is between the face and a wall in front of the sun.
      const double off = 0.26 * std::sqrt(2.0);
      add(scene, shapes::make_box({-9, -9, off}, {9, 9, off + 0.01}), white);
      add_sun(scene, {0, 0.6, 1}, Vec3(1));
      for (const double color : picture_of(scene, backend, 0.9 * off)) CHECK(color == 0);
    }
}
