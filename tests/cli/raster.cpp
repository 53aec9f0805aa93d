// `verify --raster`: its output, also about surfaces that cannot be drawn.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/support/faults.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

ProcessResult verify(std::vector<std::string> arguments, const Environment& environment = {}) {
  const TemporaryFolder folder;
  arguments.insert(arguments.begin(), "verify");
  arguments.insert(arguments.end(), {"--raster", "--backends", "gpu", "--quiet", "--keep", folder / "kept"});
  return run_eyeray(arguments, environment);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("the report of --raster counts equal pixels, and lists the shapes that are not drawn") {
  const ProcessResult result = verify({"scenes/shapes/csg.toml", "-s", "96x72", "--validate", "sync"});
  CAPTURE(result.out);
  CAPTURE(result.err);
  CHECK(result.code == 0);
  CHECK(has(result.out, " triangles; not drawn: 7 csg\n"));
  CHECK(has(result.out, "  gate R passed gpu = the rasteriser: "));
  CHECK(has(result.out, "  gate R passed reference = the rasteriser: "));
  CHECK(has(result.out, " behind shapes that are not drawn\n"));
}

TEST_CASE("the command that examines a pixel failed by gate R has --raster, and JUnit's XML has the gate") {
  const TemporaryFolder folder;
  const std::string shaders = lay_fault(folder, "position");
  const ProcessResult result = run_eyeray(
      {"verify", "scenes/whitted.toml", "-s", "96x72", "--raster", "--quiet", "--keep", folder / "kept",
       "--junit", folder / "report.xml", "--report", folder / "page", "--shaders", shaders});
  CHECK(result.code == 1);
  CHECK(has(result.out, "gate R: gpu against the rasteriser: "));
  CHECK(has(result.out, " pixels away from its pixel, and at t "));
  CHECK(has(result.out, "look closer: eyeray verify scenes/whitted.toml -s 96x72 --shaders " + shaders +
                            " --raster --crop "));
  CHECK(has(read_text(folder / "report.xml"), "gate R FAILED gpu = the rasteriser"));
  CHECK(has(read_text(folder / "page/index.html"), "gate R FAILED gpu = the rasteriser"));
}

TEST_CASE("a camera that no projection matrix describes gives one sentence and exit code 2") {
  for (const char* camera : {"fisheye", "panorama", "cylindrical", "thin_lens", "formula"}) {
    CAPTURE(camera);
    const ProcessResult result = verify({fmt::format("scenes/cameras/{}.toml", camera), "-s", "8x6"});
    CHECK(result.code == 2);
    CHECK(has(result.err, "eyeray: error: --raster needs a camera that a projection matrix describes"));
    CHECK(result.out == "");
  }
}

TEST_CASE("a device that cannot draw, or lacks the memory, gives one sentence and exit code 3") {
  const std::vector<std::string> scene = {"scenes/whitted.toml", "-s", "8x6"};
  const ProcessResult no_queue =
      verify(scene, {{"EYERAY_VULKAN_LOADER", FAILING_VULKAN}, {"EYERAY_NO_GRAPHICS", "1"}});
  CHECK(no_queue.code == 3);
  CHECK(has(no_queue.err, " has no graphics queue, so it cannot draw triangles: leave out --raster"));

  const ProcessResult no_memory = verify(
      scene, {{"EYERAY_VULKAN_LOADER", FAILING_VULKAN}, {"EYERAY_FAILING_CALL", "vkAllocateMemory 1 -2"}});
  CHECK(no_memory.code == 3);
  CHECK(has(no_memory.err, " bytes left for the picture's ids in a heap of "));
  CHECK(has(no_memory.err, "VK_ERROR_OUT_OF_DEVICE_MEMORY"));

  // Wider than any device draws; only the crop is drawn.
  const ProcessResult too_wide = verify({"scenes/whitted.toml", "-s", "60000x1"});
  CHECK(too_wide.code == 3);
  CHECK(has(too_wide.err, " pixels a side, but this one has 60000×1: leave out --raster"));
}
