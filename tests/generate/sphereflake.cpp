#include "host/generate/sphereflake.hpp"

#include <cmath>
#include <map>

#include "host/generate/octasphere.hpp"
#include "host/loader/scene_file.hpp"
#include "tests/support/pixel.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::generate;
using eyeray::engine::test::pixel;

namespace {

std::vector<Ball> balls(int size_factor) {
  std::vector<Ball> all;
  for_each_ball(size_factor, [&](const Ball& ball) { all.push_back(ball); });
  return all;
}

}  // namespace

TEST_CASE("a sphereflake has (9^(n+1) - 1) / 8 spheres") {
  const std::map<int, uint64_t> counts = {{1, 10}, {2, 91}, {3, 820}, {4, 7381}, {5, 66430}};
  for (const auto& [size_factor, count] : counts) {
    CHECK(sphereflake_count(size_factor) == count);
    CHECK(balls(size_factor).size() == count);
  }
}

TEST_CASE("spheres are arranged as in Haines' database: parents first, each child touching its parent") {
  const std::vector<Ball> all = balls(3);
  CHECK(all[0].center == Vec3(0.0));
  CHECK(all[0].radius == 0.5);
  CHECK(glm::distance(all[1].center, Vec3(0.2721655270, 0.2721655270, 0.5443310540)) < 1e-10);
  CHECK(all[1].radius == doctest::Approx(1.0 / 6));
  CHECK(all[2].radius == doctest::Approx(1.0 / 18));  // depth first
  CHECK(all[1 + 91].radius == doctest::Approx(1.0 / 6));
  CHECK(glm::distance(all[1 + 91].center, 2.0 / 3 * Vec3(0.965925826, 0.258819045, 0)) < 1e-9);

  // A child's centre is four thirds of the parent's radius from the parent's centre; the child's own radius
  // is the last third.
  std::vector<Ball> path;
  int touching = 0;
  for (const Ball& ball : all) {
    while (!path.empty() && path.back().radius < 2 * ball.radius) path.pop_back();
    if (!path.empty()) {
      CHECK(glm::distance(ball.center, path.back().center) ==
            doctest::Approx(ball.radius + path.back().radius).epsilon(1e-14));
      ++touching;
    }
    path.push_back(ball);
  }
  CHECK(touching == 819);
}

TEST_CASE("a child that points to -z is turned over about the y axis") {
  const std::vector<Ball> all = balls(3);
  const Ball &child = all[1 + 91], &down = all[1 + 91 + 1 + 10];  // the second of the second
  CHECK(glm::distance(glm::normalize(down.center - child.center), Vec3(0, 0, -1)) < 1e-15);
  const Ball &first = all[1 + 91 + 1 + 10 + 1], &second = all[1 + 91 + 1 + 10 + 2];
  CHECK(glm::distance(glm::normalize(first.center - down.center), Vec3(-1, 1, -2) / std::sqrt(6.0)) < 1e-14);
  CHECK(glm::distance(glm::normalize(second.center - down.center),
                      Vec3(-0.9659258262890683, 0.2588190451025208, 0)) < 1e-14);
}

TEST_CASE("the whole scene loads, and points fall on the pixels of Haines' tables") {
  const Scene scene = parse_scene(sphereflake_stage() + sphereflake_spheres(3), "balls.toml");
  CHECK(scene.warnings.empty());
  CHECK(scene.shapes.size() == 820 + 2);
  CHECK(scene.lights.size() == 3);
  const Vec2 first = pixel(scene, {0.643951, 0.172546, 0});
  CHECK(first.x == doctest::Approx(208.04).epsilon(2e-5));
  CHECK(first.y == doctest::Approx(346.29).epsilon(2e-5));
  const Vec2 fourth = pixel(scene, {-0.471405, 0.471405, 0});
  CHECK(fourth.x == doctest::Approx(384.13).epsilon(2e-5));
  CHECK(fourth.y == doctest::Approx(238.91).epsilon(2e-5));

  // Numbers survive the way through the file in all bits.
  const std::vector<Ball> all = balls(3);
  for (size_t i = 0; i < all.size(); ++i) {
    const Bounds box = scene.shapes[i]->bounds();
    CHECK(glm::distance((box.min + box.max) / 2.0, all[i].center) < 1e-15);
  }
}

TEST_CASE("an octasphere is closed, outward and round") {
  for (const int divisions : {1, 2, 3, 4, 7}) {
    CAPTURE(divisions);
    const Mesh mesh = octasphere(divisions);
    CHECK(mesh.positions.size() == size_t(4 * divisions * divisions + 2));
    CHECK(mesh.triangles.size() == size_t(8 * divisions * divisions));
    // Every edge occurs once in each direction.
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    double volume = 0;
    for (const auto& corners : mesh.triangles) {
      for (size_t i = 0; i < 3; ++i) ++edges[{corners[i], corners[(i + 1) % 3]}];
      const Vec3 &a = mesh.positions[corners[0]], &b = mesh.positions[corners[1]],
                 &c = mesh.positions[corners[2]];
      volume += glm::dot(a, glm::cross(b, c)) / 6;
      for (const Vec3& normal : {a, b, c}) CHECK(glm::dot(normal, glm::cross(b - a, c - a)) > 0);
    }
    for (const auto& [edge, count] : edges) {
      CHECK(count == 1);
      CHECK(edges.contains({edge.second, edge.first}));
    }
    CHECK(volume > (divisions == 1 ? 1.33 : 2.6));  // 4/3 π in the limit
    CHECK(volume < 4.19);
  }
}

TEST_CASE(
    "a triangulated sphereflake has about the requested number of triangles, every sphere at its position") {
  CHECK(sphereflake_divisions(4, 1'000'000) == 4);
  CHECK(sphereflake_triangles(4, 4) == 944'768);
  CHECK(sphereflake_divisions(4, 1) == 1);

  MeshInMemory sink;
  sphereflake_mesh(2, 3, sink);
  const size_t per_ball = 4 * 9 + 2;
  REQUIRE(sink.mesh.positions.size() == 91 * per_ball);
  REQUIRE(sink.mesh.triangles.size() == sphereflake_triangles(2, 3));
  const std::vector<Ball> all = balls(2);
  for (size_t i = 0; i < sink.mesh.positions.size(); ++i) {
    const Ball& ball = all[i / per_ball];
    CHECK(glm::distance(sink.mesh.positions[i], ball.center) == doctest::Approx(ball.radius).epsilon(1e-5));
  }
  for (size_t i = 0; i < sink.mesh.triangles.size(); ++i) {
    for (const uint32_t corner : sink.mesh.triangles[i]) CHECK(corner / per_ball == i / 72);
  }
}
