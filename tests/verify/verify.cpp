#include "host/verify/verify.hpp"

#include "host/loader/scene_file.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::render;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::compare;
using eyeray::engine::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

Scene two_balls() {
  return parse_scene(R"(
[image]
width = 24
height = 18
[camera]
eye = [0, 0, 4]
[[light]]
type = "directional"
direction = [-1, -1, -1]
[[material]]
name = "red"
type = "phong"
diffuse = [1, 0, 0]
[[sphere]]
name = "left"
center = [-0.6, 0, 0]
radius = 0.8
material = "red"
[[sphere]]
center = [0.8, 0, 0]
radius = 0.6
material = "red"
)",
                     "balls.toml");
}

}  // namespace

TEST_CASE("a scene is rendered by each backend and by the reference, and the report has every gate") {
  const TemporaryFolder folder;
  const Scene scene = two_balls();
  verify::Options options;
  options.backends = {Backend::twin};
  options.crop = {2, 3, 20, 13};
  int calls = 0;
  options.progress = [&] { return ++calls, std::function<void(const Progress&)>(); };
  const Report report = verify::verify_scene({scene, "balls.toml", " --spp 1", folder / "kept"}, options);
  CHECK(report.failures() == std::vector<std::string>());
  CHECK(report.scene == "balls.toml");
  CHECK(report.options == " --spp 1");
  CHECK(report.area == options.crop);
  REQUIRE(report.participants.size() == 2);
  CHECK(report.participants[0].name == "twin");
  CHECK(report.participants[1].name == "reference");
  CHECK(calls == 2);
  CHECK(report.exact.empty());
  REQUIRE(report.against_reference.size() == 1);
  CHECK(report.against_reference[0].comparison.colors.pixels == 20 * 13);
  CHECK(report.kept == "");
  CHECK_FALSE(fs::exists(folder / "kept"));
}

TEST_CASE("random paths are compared sample by sample, in the text and in JSON") {
  const TemporaryFolder folder;
  Scene scene = loader::load_scene("scenes/path/cornell_box.toml");
  scene.image.width = scene.image.height = 12;
  scene.image.samples = 3;
  verify::Options options;
  options.backends = {Backend::twin};
  options.crop = {1, 2, 10, 9};
  const Report report = verify::verify_scene({scene, "box.toml", "", folder / "kept"}, options);
  CHECK(report.failures() == std::vector<std::string>());
  const ReferenceComparison& comparison = report.against_reference.at(0).comparison;
  REQUIRE(comparison.by_samples());
  CHECK(comparison.paths.pixels == 3 * 90);
  CHECK(to_text(report).find("gate D passed twin = reference, paths: ") != std::string::npos);
  CHECK(to_text(report).find("gate D passed twin = reference, sums: ") != std::string::npos);
  CHECK(to_json(std::span(&report, 1)).find("\"paired_sum\":{\"passed\":true") != std::string::npos);
}
