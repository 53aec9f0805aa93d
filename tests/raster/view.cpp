// The forward map inverts camera rays, and cuts leave the parts in front of the eye.
#include "host/raster/view.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "host/cameras/make.hpp"
#include "host/core/error.hpp"
#include "tests/support/doctest.hpp"
#include "tests/support/random.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::raster;
using namespace eyeray::engine::test;

namespace {

constexpr Vec2 picture_size(96, 72);
constexpr Rect part{10, 20, 40, 30};

Camera camera_of(std::shared_ptr<const Projection> projection) {
  return {.eye = {3, 2, 7}, .target = {-1, 0.5, 0}, .up = {0.1, 1, 0}, .projection = std::move(projection)};
}

std::vector<Camera> drawn_cameras() {
  std::vector<Camera> all;
  for (const FovAxis axis : {FovAxis::horizontal, FovAxis::vertical, FovAxis::shorter, FovAxis::diagonal})
    all.push_back(camera_of(cameras::make_projection(PerspectiveCamera{55, axis})));
  all.push_back(camera_of(cameras::make_projection(OrthographicCamera{2.5})));
  return all;
}

}  // namespace

TEST_CASE("a point on a pixel's ray projects to the pixel's centre, at the nearness of its t") {
  Random random(1);
  for (const Camera& camera : drawn_cameras()) {
    const View view(camera, picture_size, part);
    for (int i = 0; i < 200; ++i) {
      const int x = random.below(part.width), y = random.below(part.height);
      const Vec2 position(2 * (part.x + x + 0.5) / picture_size.x - 1,
                          1 - 2 * (part.y + y + 0.5) / picture_size.y);
      const Vec2 square(position.x, position.y * picture_size.y / picture_size.x);
      const Ray ray = camera.projection->ray(camera_axes(camera), square, {0, 0}, picture_size);
      const double t = random.log_uniform(0.01, 100);
      const Vec3 seen = view.project(Vec4(view.to_camera(ray.o + ray.d * t), 1.0));
      CHECK(seen.x == doctest::Approx(x + 0.5).epsilon(1e-9));
      CHECK(seen.y == doctest::Approx(y + 0.5).epsilon(1e-9));
      CHECK(seen.z == doctest::Approx(view.nearness(x, y, t)).epsilon(1e-9));
      CHECK(view.t(x, y, seen.z) == doctest::Approx(t).epsilon(1e-9));
    }
  }
}

TEST_CASE("a nearer point has more nearness, and is displaced by more pixels") {
  for (const Camera& camera : drawn_cameras()) {
    const View view(camera, picture_size, part);
    CHECK(view.nearness(3, 4, 1) > view.nearness(3, 4, 2));
    const Vec2 close = view.shift(3, 4, view.nearness(3, 4, 1), 0.01);
    const Vec2 far = view.shift(3, 4, view.nearness(3, 4, 2), 0.01);
    CHECK((view.perspective() ? close.x > 1.9 * far.x : close.x == far.x));
  }
}

TEST_CASE(
    "a triangle around the eye is clipped to the part in front; a cut edge is the same from both sides") {
  for (const Camera& camera : drawn_cameras()) {
    const View view(camera, picture_size, part);
    // Two triangles that share an edge, which passes from behind the eye far out of the picture.
    const Vec4 a(1, -0.5, -3, 1), b(-2, 0.7, 1000, 1), left(-50, -1, 3, 1), right(60, 1, 4, 1);
    std::vector<std::set<std::array<double, 3>>> corners(2);
    for (const int side : {0, 1}) {
      const std::array<Vec4, 3> triangle = side == 0 ? std::array{a, b, left} : std::array{b, a, right};
      view.cut(triangle, {.id = 5}, [&](const ScreenTriangle& piece) {
        CHECK(piece.id == 5);
        for (const Vec3& at : piece.at) {
          CHECK(std::isfinite(at.z));
          CHECK(std::fabs(at.x) < 10 * picture_size.x);
          CHECK(std::fabs(at.y) < 10 * picture_size.x);
          corners[size_t(side)].insert({at.x, at.y, at.z});
        }
      });
      CHECK(corners[size_t(side)].size() >= 3);
    }
    // Both triangles have the same ends of the shared edge, bit by bit.
    std::vector<std::array<double, 3>> both;
    std::ranges::set_intersection(corners[0], corners[1], std::back_inserter(both));
    CHECK(both.size() == 2);
  }
}

TEST_CASE("a plane is drawn up to its horizon, and not above it") {
  Camera camera = camera_of(cameras::make_projection(PerspectiveCamera{55}));
  camera.up = {0, 1, 0};
  const View view(camera, picture_size, {0, 0, 96, 72});
  double lowest = 1, highest = -1;
  view.cut(view.plane({0, 0, 0}, {0, 1, 0}), {}, [&](const ScreenTriangle& piece) {
    for (const Vec3& at : piece.at) {
      lowest = std::min(lowest, at.z);
      highest = std::max(highest, at.z);
      // At the end of the plane (z = 0), the direction is level: the point lies on the horizon.
      if (at.z > 1e-12) continue;
      const Vec3 level = camera_axes(camera).w - Vec3(0, camera_axes(camera).w.y, 0);
      const double horizon = view.project(Vec4(view.turned(level), 0.0)).y;
      CHECK(at.y == doctest::Approx(horizon));
    }
  });
  CHECK(lowest == doctest::Approx(0));
  CHECK(highest > 0.1);
}

TEST_CASE("a camera without a projection matrix is refused in one sentence") {
  const auto refused = [](std::shared_ptr<const Projection> projection) {
    try {
      const View view(camera_of(std::move(projection)), picture_size, part);
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::bad_input);
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refused(cameras::make_projection(FisheyeCamera{})).find("leave out --raster") != std::string::npos);
  CHECK(refused(cameras::make_projection(PanoramaCamera{})).find("leave out --raster") != std::string::npos);
  CHECK(refused(cameras::make_projection(CylindricalCamera{})).find("leave out --raster") !=
        std::string::npos);
  CHECK(refused(cameras::make_projection(PerspectiveCamera{45, FovAxis::horizontal, {.radius = 0.1}}))
            .find("this camera has a lens") != std::string::npos);
  CHECK(refused(cameras::make_projection(PerspectiveCamera{})) == "");
}
