// A driver that ends loops early must not go unnoticed: a pixel is right, or it is flagged.
#include <fmt/format.h>

#include "loader/scene_file.hpp"
#include "render/executor.hpp"

#include "support/doctest.hpp"

using namespace eyeray;

namespace {

// Two mirrors face to face with `count` little spheres between them: each bounce costs a look at every
// sphere.
Scene hall_of_mirrors(int count, int depth) {
  std::string text = fmt::format(
      "image = {{ width = 24, height = 16 }}\n"
      "camera = {{ eye = [0.1, 0.2, 0], target = [1, 0.25, 0.1], fov = 60 }}\n"
      "render = {{ max_depth = {}, background = [0.1, 0.2, 0.3], ambient = [1, 1, 1] }}\n",
      depth);
  text += "[[light]]\ntype = \"directional\"\ndirection = [0, -1, 0]\nintensity = 0.5\n";
  text += "[[material]]\nname = \"mirror\"\ntype = \"phong\"\ndiffuse = 0.02\nreflectance = 0.98\n";
  for (const double x : {-2.0, 2.0})
    text += fmt::format("[[plane]]\npoint = [{}, 0, 0]\nnormal = [1, 0, 0]\nmaterial = \"mirror\"\n", x);
  for (int i = 0; i < count; ++i)
    text += fmt::format("[[sphere]]\ncenter = [{}, -3, {}]\nradius = 0.01\nmaterial = \"mirror\"\n",
                        0.1 * (i % 17), 0.1 * (i / 17));
  return parse_scene(text, "hall_of_mirrors.toml");
}

}  // namespace

TEST_CASE("more iterations than a capped driver grants: every pixel is the twin's, or flagged") {
  const Scene scene = hall_of_mirrors(1200, 60);
  const auto gpu = make_executor(Backend::gpu, scene, {});
  const auto twin = make_executor(Backend::twin, scene, {});
  const Rect all{0, 0, scene.image.width, scene.image.height};
  std::vector<PixelSample> ours(size_t(all.pixels())), theirs(size_t(all.pixels()));
  REQUIRE(gpu->sample(all, 0, ours));
  REQUIRE(twin->sample(all, 0, theirs));
  int flagged = 0;
  for (size_t i = 0; i < ours.size(); ++i) {
    if (ours[i].flags & loop_budget)
      ++flagged;
    else
      CHECK(ours[i].color == theirs[i].color);
  }
  MESSAGE(fmt::format("{} of {} pixels flagged on {}", flagged, ours.size(), gpu->description()));
}

TEST_CASE("a scene too large for one ray on a capped driver is refused with the numbers, or rendered right") {
  const Scene scene = hall_of_mirrors(31000, 1);
  try {
    const auto gpu = make_executor(Backend::gpu, scene, {});
    const auto twin = make_executor(Backend::twin, scene, {});
    const Rect row{0, 0, scene.image.width, 1};
    std::vector<PixelSample> ours(size_t(row.pixels())), theirs(size_t(row.pixels()));
    REQUIRE(gpu->sample(row, 0, ours));
    REQUIRE(twin->sample(row, 0, theirs));
    for (size_t i = 0; i < ours.size(); ++i) CHECK(ours[i].color == theirs[i].color);
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::no_device);
    CHECK(std::string(error.what()).find("31002 primitives") != std::string::npos);
  }
}
