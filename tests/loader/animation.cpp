// [animation] and [[track]]: the state of a scene at a frame.
#include <fmt/format.h>

#include <cmath>

#include "host/loader/scene_file.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

namespace {

Scene at(const std::string& tracks, double frame) {
  const std::string text = R"(
[camera]
eye = [0, 0, 0]
target = [0, 0, -1]
[[material]]
name = "white"
type = "phong"
[[sphere]]
name = "ball"
center = [0, 0, -5]
radius = 1
material = "white"
)" + tracks;
  const Override define{fmt::format("animation.frame={}", frame)};
  return parse_scene(text, "scene.toml", std::span(&define, 1));
}

Vec3 eye(const std::string& keyframes, const std::string& curve, double frame) {
  return at(fmt::format("[[track]]\ntarget = \"camera.eye\"\ncurve = \"{}\"\nkeyframes = {}\n", curve,
                        keyframes),
            frame)
      .camera.eye;
}

Vec3 middle(const Scene& scene) {
  const Bounds bounds = scene.shapes.back()->bounds();
  return (bounds.min + bounds.max) / 2.0;
}

// The image of [1, 0, 0] under `transform` of the ball's group.
Vec3 moved(const std::string& keyframes, double frame) {
  return middle(at(R"(
[[group]]
name = "arm"
[[group.box]]
min = [0.75, -0.25, -0.25]
max = [1.25, 0.25, 0.25]
material = "white"
[[track]]
target = "group.arm.transform"
keyframes = )" + keyframes +
                       "\n",
                   frame));
}

}  // namespace

TEST_CASE("between keyframes a value is interpolated linearly, jumps, or follows a Catmull-Rom spline") {
  const std::string three = "[[0, [0, 0, 0]], [10, [10, 0, 2]], [30, [10, 40, 2]]]";
  CHECK(eye(three, "linear", 5) == Vec3(5, 0, 1));
  CHECK(eye(three, "linear", 10) == Vec3(10, 0, 2));
  CHECK(eye(three, "linear", 25) == Vec3(10, 30, 2));
  CHECK(eye(three, "step", 9.99) == Vec3(0, 0, 0));
  CHECK(eye(three, "step", 10) == Vec3(10, 0, 2));
  CHECK(eye(three, "step", 30) == Vec3(10, 40, 2));
  // Before the first keyframe and after the last, their values hold.
  for (const char* curve : {"linear", "step", "smooth"}) {
    CHECK(eye(three, curve, -7) == Vec3(0, 0, 0));
    CHECK(eye(three, curve, 99) == Vec3(10, 40, 2));
  }
  // Half way between the first two keyframes. The slope at the first is that of the straight line between
  // them; at the second, that of the line between its neighbours.
  const Vec3 half = eye(three, "smooth", 5);
  const double slope_x = 10.0 / 30, slope_y = 40.0 / 30;
  CHECK(half.x == doctest::Approx(5 + (10 - 10 * slope_x) / 8));
  CHECK(half.y == doctest::Approx(0 + (0 - 10 * slope_y) / 8));
  CHECK(eye(three, "smooth", 10) == Vec3(10, 0, 2));
  // With keyframes evenly apart it is the classic spline: half way, (−p₀ + 9 p₁ + 9 p₂ − p₃) / 16.
  const std::string even = "[[0, [1, 0, 0]], [1, [2, 0, 0]], [2, [5, 0, 0]], [3, [4, 0, 0]]]";
  CHECK(eye(even, "smooth", 1.5).x == doctest::Approx((-1 + 9 * 2 + 9 * 5 - 4) / 16.0));
}

TEST_CASE("a smooth curve has no corner at a keyframe, however unevenly the keyframes are spaced") {
  const std::string uneven = "[[0, [0, 0, 0]], [1, [3, 0, 0]], [11, [4, 0, 0]], [12, [0, 0, 0]]]";
  for (const double frame : {1.0, 11.0}) {
    constexpr double h = 1e-4;
    const double before = (eye(uneven, "smooth", frame).x - eye(uneven, "smooth", frame - h).x) / h;
    const double after = (eye(uneven, "smooth", frame + h).x - eye(uneven, "smooth", frame).x) / h;
    CHECK(before == doctest::Approx(after).epsilon(2e-3));
  }
}

TEST_CASE("rotations about one axis interpolate the degrees; about two axes they take the shortest way") {
  const auto turn = [](const char* axis, double degrees) {
    return fmt::format("[{{ rotate = {{ axis = {}, degrees = {} }} }}]", axis, degrees);
  };
  const auto keyframes = [&](const std::string& a, const std::string& b) {
    return fmt::format("[[0, {}], [8, {}]]", a, b);
  };
  const auto near = [](const Vec3& a, const Vec3& b) { return glm::length(a - b) < 1e-6; };
  CHECK(near(moved(keyframes(turn("[0, 0, 1]", 0), turn("[0, 0, 1]", 720)), 1), Vec3(0, 1, 0)));
  CHECK(near(moved(keyframes(turn("[0, 0, 1]", 0), turn("[0, 0, 2]", 720)), 3), Vec3(0, -1, 0)));
  // Half way from 90° about z to 90° about y: a rotation about (0, 1, 1), by cos θ/2 = (1/2 + 1/2) / √(2 + 2
  // · 1/2) …
  const double w = 1 / std::sqrt(2.0), k = 0.5 / std::sqrt(2.0), unit = std::sqrt(w * w + 2 * k * k);
  const double c = w / unit, s = k / unit;
  const Vec3 half = moved(keyframes(turn("[0, 0, 1]", 90), turn("[0, 1, 0]", 90)), 4);
  CHECK(half.x == doctest::Approx(1 - 2 * (s * s + s * s)));
  CHECK(half.y == doctest::Approx(2 * c * s));
  CHECK(half.z == doctest::Approx(-2 * c * s));
}

TEST_CASE("tracks keep whole numbers whole, and animate values that an override has set") {
  const std::string depth =
      "[[track]]\ntarget = \"render.max_depth\"\ncurve = \"step\"\nkeyframes = [[0, 2], [5, 7]]\n";
  CHECK(at(depth, 4).render.max_depth == 2);
  CHECK(at(depth, 5).render.max_depth == 7);
  CHECK(at("[[track]]\ntarget = \"image.width\"\nkeyframes = [[0, 100], [4, 200]]\n", 1).image.width == 125);
  const Scene scene =
      at("[animation]\nframes_per_second = 25\n[[track]]\ntarget = \"sphere.ball.radius\"\nkeyframes = [[-4, "
         "1], [6, 2]]\n",
         1);
  CHECK(scene.shapes[0]->bounds().max.x == doctest::Approx(1.5));
  CHECK(scene.animation.frame == 1);
  CHECK(scene.animation.frames_per_second == 25);
  CHECK(scene.animation.tracks == 1);
  CHECK(scene.animation.first == -4);
  CHECK(scene.animation.last == 6);
}

TEST_CASE("two tracks on one target are one error, at the second one's line, however many there are") {
  const auto track = [](const std::string& target, const char* value) {
    return fmt::format("[[track]]\ntarget = \"{}\"\nkeyframes = [[0, {}]]\n", target, value);
  };
  const auto error_of = [&](const std::string& tracks) -> std::string {
    try {
      at(tracks, 0);
    } catch (const InputError& error) {
      REQUIRE(error.diagnostics().size() == 1);
      const Diagnostic& diagnostic = error.diagnostics()[0];
      return fmt::format("{}: {}", diagnostic.position.line, diagnostic.message);
    }
    return "";
  };
  const std::string message =
      "the [[track]] at scene.toml:14 moves this already: put all its keyframes into one track";
  // `tracks` begins in line 13 of the scene, and a track has three lines.
  const std::string eye = track("camera.eye", "[0, 0, 1]"), radius = track("sphere.ball.radius", "2");
  CHECK(error_of(eye + radius).empty());
  CHECK(error_of(eye + radius + eye) == "20: " + message);
  CHECK(error_of(eye + track("camera . eye", "[0, 0, 2]")) == "17: " + message);
  CHECK(error_of(radius + track("sphere.0.radius", "3")) == "17: " + message);
  std::string many = eye;
  for (int i = 0; i < 10'000; ++i) many += eye;
  CHECK(error_of(many) == "17: " + message);

  // A later track may move a part of a value differently. In the reverse order, that part's track would have
  // no effect.
  const std::string x = track("camera.eye.0", "7");
  CHECK(at(eye + x, 0).camera.eye == Vec3(7, 0, 1));
  CHECK(error_of(x + eye) == "17: " + message);
}
