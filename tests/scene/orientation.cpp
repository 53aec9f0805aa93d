// Right is right, up is up and near is near: scenes/orientation.toml, by every executor.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "frames.hpp"
#include "host/loader/scene_file.hpp"
#include "tests/support/camera.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::compare;
using namespace eyeray::engine::test;

namespace {

struct PixelPosition {
  int x, y;
};

// The pixel that shows the world's point p, by docs/conventions.md.
PixelPosition project(const Scene& scene, const Vec3& p) {
  const Camera& camera = scene.camera;
  const Vec3 w = glm::normalize(camera.target - camera.eye);
  const Vec3 u = glm::normalize(glm::cross(w, camera.up));
  const Vec3 v = glm::cross(u, w);
  const Vec3 way = p - camera.eye;
  const double width = scene.image.width, height = scene.image.height;
  const double distance =
      1 / std::tan(camera_as<PerspectiveCamera>(scene).fov_degrees / 2 * std::numbers::pi / 180);
  const double x = distance * glm::dot(way, u) / glm::dot(way, w);
  const double y = distance * glm::dot(way, v) / glm::dot(way, w) * width / height;
  return {int((x + 1) / 2 * width), int((1 - y) / 2 * height)};
}

struct Object {
  const char* material;
  Vec3 center;
  int primitive;
};
const Object objects[] = {{"white", {0, 0, 0}, 0},
                          {"red", {1.8, 0, 0}, 1},
                          {"green", {0, 1.5, 0}, 2},
                          {"blue", {0, 0, 1.6}, 3},
                          {"red", {-1.7, 0.75, 0}, 5}};

}  // namespace

TEST_CASE("orientation: red is right, green is up, blue is near, with every executor") {
  const Scene scene = load_scene("scenes/orientation.toml");
  for (const Backend backend : backends) {
    CAPTURE(backend_names[int(backend)]);
    const Frame frame = render_frame(scene, backend);

    // Each object is seen where its centre projects to.
    for (const Object& object : objects) {
      CAPTURE(object.material);
      const PixelPosition position = project(scene, object.center);
      const FirstHit& hit = frame.first_hit(position.x, position.y);
      CHECK(hit.primitive == object.primitive);
      REQUIRE(hit.material >= 0);
      CHECK(scene.materials[size_t(hit.material)]->name == object.material);
      CHECK(glm::length(hit.position - object.center) < 0.6);
    }

    // A test without any formula: the red ball is in the picture's right half, the arrow in its left half,
    // the green object in its top half.
    const auto seen = [&](int primitive, Rect area) {
      int count = 0;
      for (int y = area.y; y < area.y + area.height; ++y)
        for (int x = area.x; x < area.x + area.width; ++x)
          count += frame.first_hit(x, y).primitive == primitive;
      return count;
    };
    const int width = scene.image.width, height = scene.image.height;
    const Rect left{0, 0, width / 2, height}, right{width / 2, 0, width / 2, height};
    const Rect top{0, 0, width, height / 2}, bottom{0, height / 2, width, height / 2};
    CHECK(seen(1, right) > 500);
    CHECK(seen(1, left) == 0);
    CHECK(seen(5, left) > 500);
    CHECK(seen(5, right) == 0);
    CHECK(seen(2, top) > 500);
    CHECK(seen(2, bottom) == 0);
    CHECK(seen(4, bottom) > seen(4, top));

    // The channels of colours are in order.
    const auto color = [&](const Object& object) {
      const PixelPosition position = project(scene, object.center);
      return color_at(frame.color, position.x, position.y);
    };
    const Vec3 red = color(objects[1]), green = color(objects[2]), blue = color(objects[3]);
    CHECK(red.r > 2 * std::max(red.g, red.b));
    CHECK(green.g > 2 * std::max(green.r, green.b));
    CHECK(blue.b > 2 * std::max(blue.r, blue.g));

    // The blue object is in front of the white one.
    const PixelPosition near = project(scene, objects[3].center), far = project(scene, objects[0].center);
    CHECK(frame.first_hit(near.x, near.y).t < frame.first_hit(far.x, far.y).t - 0.5);
  }
}
