// Compares each kind of camera with POV-Ray's, where POV-Ray is installed: both render the same scene of flat
// colours.
#include <cmath>

#include "benchmarks/bench/programs.hpp"
#include "benchmarks/contenders/povray_scene.hpp"
#include "host/cameras/make.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/scratch_folder.hpp"
#include "host/image/image_file.hpp"
#include "host/loader/scene_file.hpp"
#include "host/reference/renderer.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::bench;

namespace {

// Balls of all colours around the eye, no two alike, and none that hides all of another.
constexpr std::string_view balls = R"(
[render]
background = [0.1, 0.2, 0.3]
ambient = 1
[[material]]
name = "red"
type = "phong"
diffuse = 0
ambient = [0.9, 0.1, 0.1]
[[material]]
name = "green"
type = "phong"
diffuse = 0
ambient = [0.1, 0.8, 0.1]
[[material]]
name = "white"
type = "phong"
diffuse = 0
ambient = [0.9, 0.9, 0.9]
[[sphere]]
batch = { center = [[0, 0, -4], [4, 1.5, 0], [0, 1, 5]], radius = [1, 1.2, 2] }
material = "red"
[[sphere]]
batch = { center = [[1.4, 0.8, -3], [-3, 2, 2], [1, -3, 0.5]], radius = [0.5, 0.9, 0.7] }
material = "green"
[[sphere]]
batch = { center = [[-2, -0.6, -2.5], [0.5, 4, -1], [-3, -1, 3]], radius = [0.6, 1, 0.8] }
material = "white"
)";

// The percentage of pixels that differ by more than 0.02 in some channel, and the mean difference of all.
struct Apart {
  double share, mean;
};

Apart apart_from_povray(const std::string& camera, int width, int height, int samples = 1,
                        double wider_aperture = 1) {
  Scene scene =
      loader::parse_scene(fmt::format("[image]\nwidth = {}\nheight = {}\nsamples = {}\n[camera]\n{}\n{}",
                                      width, height, samples, camera, balls),
                          "a");
  const ScratchFolder folder;
  const auto text = folder.path() / "scene.pov", picture = folder.path() / "povray.png";
  write_file_atomically(text, contenders::povray_scene(scene, width, height));
  run_povray(text, width, height, picture);
  const image::Image theirs = image::read_image(picture);

  if (wider_aperture != 1) {
    PerspectiveCamera lens = std::get<PerspectiveCamera>(scene.camera.projection->form());
    lens.aperture.radius *= wider_aperture;
    scene.camera.projection = cameras::make_projection(lens);
  }
  const reference::Renderer renderer(scene);
  Apart apart{};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Vec3 ours(0.0);
      for (int i = 0; i < samples; ++i) ours += renderer.sample(x, y, uint32_t(i)).color / double(samples);
      double most = 0;
      for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(ours[c] - double(theirs.pixel(x, y)[c])));
      apart.share += most > 0.02 ? 100.0 / (width * height) : 0;
      apart.mean += most / (width * height);
    }
  }
  MESSAGE(camera, ": ", apart.share, " % of pixels, ", apart.mean, " in the mean");
  return apart;
}

}  // namespace

TEST_CASE("cameras see what POV-Ray's see") {
  if (!have_povray()) {
    MESSAGE("POV-Ray is not installed");
    return;
  }
  // All pixels agree except those on an edge.
  CHECK(apart_from_povray("eye = [0.2, 0.1, 0.3]\ntarget = [0.5, 0.3, -2]\nfov = 80", 160, 120).share < 0.5);
  CHECK(apart_from_povray("type = \"orthographic\"\neye = [0, 0.1, 9]\nsize = 4", 160, 120).share < 0.5);
  CHECK(apart_from_povray("type = \"fisheye\"\neye = [0.2, 0.1, 0.3]\ntarget = [0.5, 0.3, -2]\nfov = 230",
                          160, 160)
            .share < 0.5);
  CHECK(apart_from_povray("type = \"panorama\"\neye = [0.2, 0.1, 0.3]\ntarget = [0.5, 0.3, -2]", 240, 120)
            .share < 0.5);
  CHECK(apart_from_povray("type = \"panorama\"\neye = [0.2, 0.1, 0.3]\ntarget = [0.5, 0.3, -2]\nfov = 150",
                          160, 120)
            .share < 0.5);
  CHECK(apart_from_povray("type = \"cylindrical\"\neye = [0.2, 0.1, 0.3]\ntarget = [0.5, 0.3, -2]\nfov = 250",
                          200, 90)
            .share < 0.5);
}

TEST_CASE("a lens blurs as POV-Ray's does, within the noise") {
  if (!have_povray()) return;
  for (const char* fov : {"fov = 50", "fov = 25"}) {
    const std::string lens =
        "eye = [0.2, 0.1, 3]\ntarget = [0.5, 0.3, -4]\naperture = 0.2\nfocus = 3.5\n" + std::string(fov);
    const double same = apart_from_povray(lens, 120, 90, 400).mean;
    CHECK(same < 0.01);
    CHECK(apart_from_povray(lens, 120, 90, 400, 0.8).mean > 1.3 * same);
    CHECK(apart_from_povray(lens, 120, 90, 400, 1.25).mean > 1.3 * same);
  }
}
