// exposure = "auto", from the command line.
#include <nlohmann/json.hpp>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// Renders with --exposure auto and these options, and returns the exposure.
double metered(const std::string& scene, const std::string& output, std::vector<std::string> more = {}) {
  std::vector<std::string> command = {"render", scene,  "--exposure", "auto",
                                      "-o",     output, "--json",     "--quiet"};
  command.insert(command.end(), more.begin(), more.end());
  const ProcessResult result = run_eyeray(command);
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  const auto report = nlohmann::json::parse(result.out);
  return (report.contains("frames") ? report.at("frames").at(0) : report).at("exposure").get<double>();
}

}  // namespace

TEST_CASE(
    "a metered picture is that of its exposure, whole, cropped and of parts; other formats keep the light") {
  const SceneFolder folder;
  const double exposure = metered(folder.scene(), folder / "a.png", {"-o", folder / "a.pfm"});
  CHECK(run_eyeray({"render", folder.scene(), "--exposure", fmt::format("{}", exposure), "-o",
                    folder / "b.png", "--quiet"})
            .code == 0);
  CHECK(run_eyeray({"render", folder.scene(), "-o", folder / "c.png", "-o", folder / "c.pfm", "--quiet"})
            .code == 0);
  CHECK(read_text(folder / "a.png") == read_text(folder / "b.png"));
  CHECK(read_text(folder / "a.png") != read_text(folder / "c.png"));
  CHECK(read_text(folder / "a.pfm") == read_text(folder / "c.pfm"));
  CHECK(metered(folder.scene(), folder / "crop.png", {"--crop", "0,0,8,8"}) == exposure);

  std::vector<std::string> merge = {"merge"};
  for (const char* shard : {"1/2", "2/2"}) {
    merge.push_back(folder / "part" + shard[0] + ".eyeray");
    CHECK(run_eyeray({"render", folder.scene(), "--exposure", "auto", "--shard", shard, "-o", merge.back(),
                      "--quiet"})
              .code == 0);
  }
  merge.insert(merge.end(), {"-o", folder / "merged.png"});
  CHECK(run_eyeray(merge).code == 0);
  CHECK(read_text(folder / "merged.png") == read_text(folder / "a.png"));
}

TEST_CASE("twice the light is one stop less, and the size of a picture hardly counts") {
  const SceneFolder folder;
  const double exposure = metered(folder.scene(), folder / "a.png");
  CHECK(metered(folder.scene(), folder / "a.png",
                {"-D", "light.0.intensity=40", "-D", "render.ambient=0.4", "-D",
                 "render.background=[0.5,1,1.5]"}) == doctest::Approx(exposure - 1).epsilon(1e-4));
  for (const char* size : {"320x240", "1000x750"})
    CHECK(std::abs(metered(folder.scene(), folder / "a.png", {"-s", size}) - exposure) < 0.1);
}

TEST_CASE("all frames of a film have one exposure") {
  const SceneFolder folder;
  write_text(folder.scene(), std::string(small_scene) + R"(
[[track]]
target = "light.0.intensity"
keyframes = [[0, 20], [10, 2000]]
)");
  const double whole = metered(folder.scene(), folder / "a.png");
  CHECK(metered(folder.scene(), folder / "%d.png", {"--frames", "9:10"}) == whole);
}

TEST_CASE("another word than auto is an error that says what is allowed") {
  const SceneFolder folder;
  const ProcessResult result =
      run_eyeray({"render", folder.scene(), "--exposure", "bright", "-o", folder / "a.png"});
  CHECK(result.code == 2);
  CHECK(result.err.find("`exposure` must be a number from -32 to 32 or \"auto\", not \"bright\"") !=
        std::string::npos);
}
