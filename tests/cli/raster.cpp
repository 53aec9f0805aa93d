// `verify --raster` and `render --primary raster`: what they say, and of what cannot be drawn.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/support/faults.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::test;

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

TEST_CASE("the report says how many pixels are equal, and what was not drawn") {
  const ProcessResult result = verify({"scenes/shapes/csg.toml", "-s", "96x72", "--validate", "sync"});
  CAPTURE(result.out);
  CAPTURE(result.err);
  CHECK(result.code == 0);
  CHECK(has(result.out, " triangles; not drawn: 7 csg\n"));
  CHECK(has(result.out, "  gate R passed gpu = the rasteriser: "));
  CHECK(has(result.out, "  gate R passed reference = the rasteriser: "));
  CHECK(has(result.out, " behind what is not drawn\n"));
}

TEST_CASE("a pixel that gate R fails is looked at with --raster, and JUnit's XML has the gate") {
  const TemporaryFolder folder;
  const std::string shaders = lay_fault(folder, "position");
  const ProcessResult result = run_eyeray(
      {"verify", "scenes/whitted.toml", "-s", "96x72", "--raster", "--quiet", "--keep", folder / "kept",
       "--junit", folder / "report.xml", "--report", folder / "page", "--shaders", shaders});
  CHECK(result.code == 1);
  CHECK(has(result.out, "gate R: gpu against the rasteriser: "));
  CHECK(has(result.out, " pixels aside of its pixel, and at t "));
  CHECK(has(result.out, "look closer: eyeray verify scenes/whitted.toml -s 96x72 --shaders '" + shaders +
                            "' --raster --crop "));
  CHECK(has(read_text(folder / "report.xml"), "gate R FAILED gpu = the rasteriser"));
  CHECK(has(read_text(folder / "page/index.html"), "gate R FAILED gpu = the rasteriser"));
}

TEST_CASE("a camera that no projection matrix describes is one sentence and exit code 2") {
  for (const char* camera : {"fisheye", "panorama", "cylindrical", "thin_lens", "formula"}) {
    CAPTURE(camera);
    const ProcessResult result = verify({fmt::format("scenes/cameras/{}.toml", camera), "-s", "8x6"});
    CHECK(result.code == 2);
    CHECK(has(result.err, "eyeray: error: --raster draws what a projection matrix describes"));
    CHECK(result.out == "");
  }
}

TEST_CASE("a device that does not draw, or has no memory for it, is one sentence and exit code 3") {
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

  // Wider than any device draws; the crop is what is drawn.
  const ProcessResult too_wide = verify({"scenes/whitted.toml", "-s", "60000x1"});
  CHECK(too_wide.code == 3);
  CHECK(has(too_wide.err, " pixels a side at most, and this one has 60000×1: leave out --raster"));
}

TEST_CASE("--primary raster says what it cannot draw, and why") {
  const TemporaryFolder folder;
  const auto error_of = [&](std::vector<std::string> arguments, const Environment& environment = {}) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"-s", "8x6", "--primary", "raster", "-o", folder / "picture.png"});
    const ProcessResult result = run_eyeray(arguments, environment);
    CHECK(result.code == (environment.empty() ? 2 : 3));
    CHECK(!std::filesystem::exists(folder / "picture.png"));
    return result.err;
  };
  CHECK(has(error_of({"scenes/path/cornell_box.toml"}), "or set image.pattern=\"regular\""));
  CHECK(has(error_of({"scenes/cornell.toml", "-D", "image.filter=\"gaussian\""}), "a filter has its own"));
  CHECK(has(error_of({"scenes/cameras/fisheye.toml"}), "leave out --raster or --primary"));
  CHECK(has(error_of({"scenes/veil.toml"}), "primitives (with cutouts): leave out --primary"));
  std::string veils =
      "[image]\npattern = 'regular'\n[camera]\neye = [0, 0, 3]\n[[material]]\nname = 'veil'\ntype = 'phong'\n"
      "alpha = 0.5\nalpha_mode = 'blend'\n";
  for (int i = 0; i < 100; ++i)
    veils +=
        fmt::format("[[disk]]\ncenter = [{}, 0, 0]\nnormal = [0, 0, 1]\nradius = 1\nmaterial = 'veil'\n", i);
  write_text(folder / "veil.toml", veils);
  CHECK(has(error_of({folder / "veil.toml"}),
            "100 of this scene's primitives (that blend): leave out --primary"));
  CHECK(has(error_of({"scenes/forest.toml"}), "it has instances; leave out --primary"));
  CHECK(has(error_of({"scenes/cornell.toml", "--rays", "lanes"}), "each ray is to be traced alone"));
  CHECK(has(error_of({"scenes/cornell.toml", "--acceleration", "brute-force"}), "there is no BVH"));
  CHECK(has(error_of({"scenes/cornell.toml", "--integrator", "sppm"}), "its integrator gathers photons"));
  CHECK(has(error_of({"scenes/cornell.toml", "--backend", "twin"}), "leave out --backend twin"));
  CHECK(has(error_of({"scenes/cornell.toml", "--classic"}), "--classic has rays at their corners"));
  CHECK(has(error_of({"scenes/cornell.toml"},
                     {{"EYERAY_VULKAN_LOADER", FAILING_VULKAN}, {"EYERAY_NO_GRAPHICS", "1"}}),
            " has no graphics queue, so it cannot draw triangles"));
}
