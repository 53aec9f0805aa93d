// Pictures from within closed rooms, under a bright sky: all white surfaces stay black, since no path gets
// out. docs/experiments/rooms.md has the figures; EYERAY_FULL_TESTS=1 makes them, and takes half an hour.
#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "host/executors/executor.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/rooms.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;

namespace {

// Rooms that lose rays, of sheets whose edges are not each other's or with edges that point into the room,
// and how many of 10⁸ may.
const std::map<std::string, double> leaking = {
    {"bilinear", 10}, {"open cylinder and disks", 10}, {"polygons with holes", 300}};

// A camera whose rays start at `origin`, and a white material. `direction`: the statements of a function in
// GLSL.
std::string camera_from(int size, const Vec3& origin, const std::string& direction) {
  return fmt::format(R"(
[image]
width = {0}
height = {0}
[camera]
type = "formula"
eye = [0, 0, 0]
target = [0, 0, -1]
code = """
vec3 origin(vec2 place, vec2 lens) {{ return vec3({1:.9f}, {2:.9f}, {3:.9f}); }}
vec3 direction(vec2 place, vec2 lens) {{ {4} }}
"""
[render]
integrator = "path"
max_depth = 8
background = 1
[[material]]
name = 'm'
type = 'diffuse'
color = 1
)",
                     size, origin.x, origin.y, -origin.z, direction);
}

// A camera that looks from `position` in all directions.
std::string bright(const Vec3& position) {
  return camera_from(96, position, R"(
  float z = fract(0.5 + 0.5 * place.x) * 2.0 - 1.0;
  float turn = 3.1415927 * place.y;
  return vec3(sqrt(max(0.0, 1.0 - z * z)) * vec2(cos(turn), sin(turn)), z);
)");
}

}  // namespace

// --subcase=NAME makes only the pictures of one room.
TEST_CASE("no light of the sky enters a closed room" * doctest::test_suite("long")) {
  const int samples = test::amount(4, 100, 1100);
  for (const auto& [name, text] : test::rooms_with_cuts()) {
    SUBCASE(name.c_str()) {
      for (const Vec3& position : test::room_positions) {
        const Scene scene = test::scene_of_room(bright(position), text, position);
        const auto executor = make_executor(Backend::gpu, scene, {});
        const Rect picture{0, 0, scene.image.width, scene.image.height};
        std::vector<PixelSample> pixels(size_t(picture.pixels()));
        int64_t rays = 0, leaks = 0;
        for (int i = 0; i < samples; ++i) {
          REQUIRE(executor->sample(picture, uint32_t(i), pixels));
          for (const PixelSample& pixel : pixels) {
            rays += pixel.rays;
            leaks += pixel.color != Vec3(0.0);
          }
        }
        MESSAGE(fmt::format("{}, {:.0f} away: {} rays, {} leak", name, glm::length(position), rays, leaks));
        const auto allowed = leaking.find(name);
        CHECK(double(leaks) <= (allowed == leaking.end() ? 0 : 2 + allowed->second * 1e-8 * double(rays)));
        CHECK(rays > int64_t(samples) * picture.pixels() * 9);
      }
    }
  }
}

// The ball was left but never entered: its roots were 0/0 and −10⁻⁷/0 where the discriminant was 0.
TEST_CASE("a ray exactly tangent to a ball passes it") {
  const std::string head = camera_from(2, {-0.921128511, -0.269476622, -1.82404709},
                                       "return vec3(0.170930102, 0.721277475, -0.671223998);");
  const Scene scene = test::scene_of_room(head, test::rooms_with_cuts().at("torus less a ball"), {0, 0, 0});
  for (const Backend backend : {Backend::gpu, Backend::twin, Backend::reference}) {
    const auto executor = make_executor(backend, scene, {});
    std::vector<PixelSample> pixels(4);
    REQUIRE(executor->sample(Rect{0, 0, 2, 2}, 0, pixels));
    for (const PixelSample& pixel : pixels) CHECK(pixel.color == Vec3(0.0));
  }
}
