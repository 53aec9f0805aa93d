// No submission keeps a watched device busy for longer than 100 ms. The device is a shim (tests/gpu/shim)
// whose clock does not depend on the machine.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <csignal>
#include <sstream>

#include "dev.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// Each workgroup takes 2 ms; from row 24 on, three times as long. Each triangle that is drawn takes 0.2 ms.
Environment slow_device(const TemporaryFolder& folder) {
  return {{"EYERAY_VULKAN_LOADER", SLOW_VULKAN}, {"EYERAY_SLOW_WORKGROUP", "2000"},
          {"EYERAY_SLOW_FACTOR", "3"},           {"EYERAY_SLOW_ROW", "24"},
          {"EYERAY_SLOW_TRIANGLE", "200"},       {"EYERAY_SLOW_LOG", folder / "submissions"}};
}

struct Submissions {
  int count = 0;
  double longest = 0;  // microseconds
  double sum = 0;
};

Submissions submissions(const TemporaryFolder& folder) {
  Submissions result;
  std::istringstream lines(read_text(folder / "submissions"));
  for (double microseconds = 0; lines >> microseconds; ++result.count) {
    result.longest = std::max(result.longest, microseconds);
    result.sum += microseconds;
  }
  return result;
}

// Runs eyeray on the slow device, for at least `least` seconds of its time, and expects short submissions.
void expect_short(const std::vector<std::string>& arguments, double least) {
  CAPTURE(fmt::format("{}", fmt::join(arguments, " ")));
  const TemporaryFolder folder;
  const ProcessResult result = run_eyeray(arguments, slow_device(folder));
  CAPTURE(result.err);
  CHECK(result.code == 0);
  const Submissions all = submissions(folder);
  CHECK(all.count > 0);
  CHECK(all.longest <= 100'000);
  CHECK(all.sum >= least * 1e6);
}

std::vector<std::string> render(std::vector<std::string> words, const TemporaryFolder& folder) {
  words.insert(words.begin(), "render");
  words.insert(words.end(), {"-s", "96x80", "-o", folder / "a.pfm"});
  return words;
}

}  // namespace

TEST_CASE("no submission of a picture takes longer than 100 ms on a watched device") {
  const TemporaryFolder folder;
  expect_short(render({"scenes/whitted.toml", "--spp", "4"}, folder), 1);
  expect_short(render({"scenes/path/cornell_box.toml", "--spp", "4"}, folder), 1);
  expect_short(render({"scenes/path/cornell_box.toml", "--spp", "1", "--aov", "albedo,depth"}, folder), 1);
  expect_short(render({"scenes/sppm/box.toml", "--spp", "1", "-D", "render.photons=65536"}, folder), 2);
  expect_short(render({"scenes/sphereflake.toml", "--spp", "4", "--tune", "profile=cpu", "--tune",
                       "rays=packets", "--tune", "acceleration=bvh"},
                      folder),
               1);
}

TEST_CASE("a device that lets a kernel have few storage buffers is refused, with the numbers") {
  const TemporaryFolder folder;
  Environment environment = slow_device(folder);
  environment.push_back({"EYERAY_SLOW_BUFFERS", "2"});
  const ProcessResult result =
      run_eyeray(render({"scenes/whitted.toml", "--tune", "constants=off"}, folder), environment);
  CHECK(result.code == 3);
  CAPTURE(result.err);
  CHECK(result.err.find(" storage buffers, but ") != std::string::npos);
  CHECK(result.err.find(" lets a kernel have at most 2: ") != std::string::npos);
}

TEST_CASE("no draw of --raster takes longer than 100 ms on a watched device") {
  expect_short({"verify", "scenes/meshes.toml", "-s", "64x48", "--backends", "gpu", "--raster", "--quiet"},
               0.3);
}

TEST_CASE("no submission of --denoise takes longer than 100 ms on a watched device") {
  const TemporaryFolder folder;
  expect_short({"render", "scenes/path/cornell_box.toml", "-s", "48x40", "--spp", "2", "--denoise", "-o",
                folder / "a.pfm"},
               10);
}

TEST_CASE("no submission of `eyeray dev` takes longer than 100 ms on a watched device") {
  const SceneFolder folder;
  const TemporaryFolder log;
  REQUIRE(run_eyeray({"shaders", "--export", folder / "shaders"}).code == 0);
  Dev dev(folder, "60", {}, slow_device(log));
  REQUIRE(dev.says("rendered "));
  dev.process().send_signal(SIGINT);
  CHECK(dev.process().wait(60));
  const Submissions all = submissions(log);
  CHECK(all.count > 1);
  CHECK(all.longest <= 100'000);
}

TEST_CASE("a picture has the same bits on a watched device, in tiles narrower than the picture") {
  const TemporaryFolder folder;
  const std::vector<std::string> options{
      "render", "scenes/whitted.toml", "--spp",  "4",          "-s", "93x77",
      "--aov",  "depth,hits",          "--tune", "profile=gpu"};
  const auto bits = [&](const std::string& name, const Environment& environment) {
    std::vector<std::string> words = options;
    words.insert(words.end(), {"-o", folder / name + ".pfm"});
    CHECK(run_eyeray(words, environment).code == 0);
    return read_text(folder / name + ".pfm") + read_text(folder / name + ".depth.pfm") +
           read_text(folder / name + ".hits.pfm");
  };
  CHECK(bits("slow", slow_device(folder)) == bits("plain", {}));
}
