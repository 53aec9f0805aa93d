// eyeray render --aov albedo,shading_normal: the inputs of denoisers. It also tests the warning about samples
// that stand out.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/image/image_file.hpp"
#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

namespace {

// A floor and a small, far, bright area light, of a shape that paths hit only by chance.
constexpr const char* sparkling = R"(
[image]
width = 48
height = 48
samples = 16

[camera]
eye = [0, 3, 6]
target = [0, 0.5, 0]
fov = 40

[render]
integrator = "path"

[[material]]
name = "wall"
type = "diffuse"

[[material]]
name = "lamp"
type = "diffuse"
color = 0
emission = 5e5

[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "wall"

[[torus]]
center = [0, 40, 0]
axis = [0, 1, 0]
major_radius = 0.5
minor_radius = 0.15
material = "lamp"
)";

}  // namespace

TEST_CASE("albedo and normal for denoisers are equal by gpu and twin, and by the reference except at edges") {
  const SceneFolder folder;
  for (const std::string scene : {"materials", "wax"}) {
    CAPTURE(scene);
    for (const std::string backend : {"gpu", "twin", "reference"}) {
      const ProcessResult result =
          run_eyeray({"render", "scenes/path/" + scene + ".toml", "-s", "40x25", "--spp", "4", "--backend",
                      backend, "--aov", "albedo,shading_normal", "-o", folder / (backend + ".pfm")});
      CAPTURE(result.err);
      REQUIRE(result.code == 0);
    }
    for (const std::string aov : {".albedo.pfm", ".shading_normal.pfm"}) {
      CAPTURE(aov);
      CHECK(read_text(folder / ("gpu" + aov)) == read_text(folder / ("twin" + aov)));
      const Image gpu = read_image(folder / ("gpu" + aov));
      const Image reference = read_image(folder / ("reference" + aov));
      size_t apart = 0;
      for (size_t i = 0; i < gpu.sample_count(); ++i) {
        CHECK(std::abs(gpu.samples()[i]) <= 1.00001f);
        apart += std::abs(gpu.samples()[i] - reference.samples()[i]) > 1e-4f;
      }
      CHECK(apart < gpu.sample_count() / 50);
    }
  }
}

TEST_CASE("albedo and normal are .exr layers with the denoisers' names, and only paths have them") {
  const SceneFolder folder;
  const std::string file = folder / "box.exr";
  REQUIRE(run_eyeray({"render", "scenes/path/cornell_box.toml", "-s", "8x8", "--spp", "1", "--backend",
                      "twin", "--aov", "albedo,shading_normal", "-o", file})
              .code == 0);
  const std::string text = read_text(file);
  for (const char* channel : {"albedo.R", "albedo.G", "albedo.B", "shading_normal.X", "shading_normal.Z"})
    CHECK(text.find(channel) != std::string::npos);

  const ProcessResult refused =
      run_eyeray({"render", "scenes/whitted.toml", "--aov", "albedo", "-o", folder / "no.pfm"});
  CHECK(refused.code == 2);
  CHECK(refused.err ==
        "eyeray: error: only paths have the AOVs albedo and shading_normal: set integrator = \"path\" in "
        "[render], or request the AOV normal, which every integrator has\n");
}

TEST_CASE("fireflies are counted; --clamp clamps them, and warns that the picture is biased") {
  const SceneFolder folder;
  write_text(folder.scene(), sparkling);
  const auto render = [&](std::vector<std::string> more) {
    more.insert(more.begin(),
                {"render", folder.scene(), "--backend", "twin", "--json", "-o", folder / "a.pfm"});
    const ProcessResult result = run_eyeray(more);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    return std::pair(nlohmann::json::parse(result.out), result.err);
  };
  const auto counted = render({"--aov", "brightest"});
  const nlohmann::json& honest = counted.first;
  const std::string& warned = counted.second;
  CAPTURE(warned);
  CHECK(honest.at("fireflies") > 0);
  CHECK(warned.find(" more than 1000 times as bright as the mean of the picture") != std::string::npos);
  CHECK(!honest.contains("clamp"));
  const Image brightest = read_image(folder / "a.brightest.pfm");
  CHECK(std::ranges::max(brightest.samples()) > 10);

  const auto clamped = render({"--clamp", "0.5"});
  const nlohmann::json& cut = clamped.first;
  const std::string& output = clamped.second;
  CAPTURE(output);
  CHECK(cut.at("clamp").at("at") == 0.5);
  CHECK(cut.at("clamp").at("samples") > 0);
  CHECK(output.find("the picture is biased: clamp cut ") != std::string::npos);
  CHECK(std::ranges::max(read_image(folder / "a.pfm").samples()) <= 0.5f);

  CHECK(run_eyeray({"verify", folder.scene(), "--clamp", "1"}).code == 2);
}

TEST_CASE(
    "--reject-fireflies leaves bright dots out, states how much light they had, and needs random paths") {
  const SceneFolder folder;
  write_text(folder.scene(), sparkling);
  std::string pictures[2];
  for (const std::string backend : {"gpu", "twin"}) {
    const ProcessResult result = run_eyeray({"render", folder.scene(), "--backend", backend, "--json",
                                             "--reject-fireflies", "-o", folder / "a.pfm", "--aov", "noisy"});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const auto report = nlohmann::json::parse(result.out);
    CHECK(report.at("outliers").at("pixels") > 0);
    CHECK(report.at("outliers").at("share_of_light") > 0.5);
    CHECK(result.err.find("the picture is biased: ") != std::string::npos);
    CHECK(result.err.find("lost fireflies, ") != std::string::npos);
    CHECK(std::ranges::max(read_image(folder / "a.pfm").samples()) < 0.1f);
    pictures[backend == "twin"] = read_text(folder / "a.pfm");
  }
  CHECK(pictures[0] == pictures[1]);

  const ProcessResult refused =
      run_eyeray({"render", "scenes/whitted.toml", "--reject-fireflies", "-o", folder / "no.png"});
  CHECK(refused.code == 2);
  CHECK(
      refused.err ==
      "eyeray: error: only random paths make fireflies: set integrator = \"path\" in [render], or leave out "
      "reject-fireflies\n");
  CHECK(run_eyeray(
            {"render", folder.scene(), "--reject-fireflies", "--shard", "1/2", "-o", folder / "no.eyeray"})
            .err.ends_with("eyeray: error: fireflies are found from a pixel's neighbours, which are in other "
                           "shards: leave out reject-fireflies\n"));
}

TEST_CASE("--stats counts the paths that max_depth cut off, the same by each executor") {
  const SceneFolder folder;
  std::vector<uint64_t> counts;
  for (const std::string backend : {"gpu", "twin"}) {
    const ProcessResult result =
        run_eyeray({"render", "scenes/path/cornell_box.toml", "-s", "16x16", "--spp", "4", "--max-depth", "1",
                    "--stats", "--json", "--backend", backend, "-o", folder / "a.pfm"});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    CHECK(result.err.find("cut-off paths") != std::string::npos);
    counts.push_back(nlohmann::json::parse(result.out).at("ray_kinds").at("cut_off"));
  }
  CHECK(counts[0] > 0);
  CHECK(counts[0] == counts[1]);
}
