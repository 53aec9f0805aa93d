// eyeray render --denoise.
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

std::vector<std::string> box(const std::string& samples, std::vector<std::string> more) {
  std::vector<std::string> arguments{"render", "scenes/path/cornell_box.toml", "-s", "64x64", "--spp",
                                     samples};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

double difference(const Image& picture, const Image& truth) {
  double sum = 0;
  for (size_t i = 0; i < picture.sample_count(); ++i) {
    const double light = double(truth.samples()[i]);
    sum += std::pow(double(picture.samples()[i]) - light, 2) / (light * light + 1e-3);
  }
  return sum;
}

}  // namespace

TEST_CASE("--denoise removes noise, keeps brightness, and gives the same bits by gpu and twin") {
  const SceneFolder folder;
  REQUIRE(run_eyeray(box("1024", {"-o", folder / "truth.pfm", "-q"})).code == 0);
  REQUIRE(run_eyeray(box("16", {"-o", folder / "noisy.pfm", "-q"})).code == 0);
  const ProcessResult result =
      run_eyeray(box("16", {"--denoise", "--json", "-o", folder / "gpu.pfm", "-o", folder / "gpu.png"}));
  REQUIRE(result.code == 0);
  const auto report = nlohmann::json::parse(result.out);
  CHECK(report["noise_left"] > 0.001);
  CHECK(report["noise_left"] < 0.6);
  CHECK(report["stages"].contains("denoise"));
  REQUIRE(run_eyeray(box("16", {"-D", "render.denoise=true", "--backend", "twin", "-o", folder / "twin.pfm"}))
              .code == 0);
  CHECK(read_text(folder / "gpu.pfm") == read_text(folder / "twin.pfm"));

  const Image truth = read_image(folder / "truth.pfm"), noisy = read_image(folder / "noisy.pfm");
  const Image denoised = read_image(folder / "gpu.pfm");
  CHECK(difference(denoised, truth) < difference(noisy, truth) / 3);
  double before = 0, after = 0;
  for (size_t i = 0; i < noisy.sample_count(); ++i) {
    before += double(noisy.samples()[i]);
    after += double(denoised.samples()[i]);
  }
  CHECK(after == doctest::Approx(before).epsilon(0.001));
}

TEST_CASE("an .exr keeps the noisy picture and what it was denoised by") {
  const SceneFolder folder;
  const std::string exr = folder / "box.exr";
  REQUIRE(run_eyeray(box("4", {"--denoise", "--aov", "depth", "-o", exr, "-o", folder / "box.pfm",
                               "--backend", "twin"}))
              .code == 0);
  const std::string text = read_text(exr);
  for (const char* channel : {"noisy.R", "variance.G", "half.B", "albedo.R", "half_albedo.G",
                              "shading_normal.X", "half_normal.Z", "depth.Z", "samples.V"})
    CHECK(text.find(channel) != std::string::npos);
  REQUIRE(run_eyeray(box("4", {"--aov", "noisy", "-o", folder / "noisy.pfm", "--backend", "twin"})).code ==
          0);
  CHECK(read_text(folder / "noisy.pfm") == read_text(folder / "noisy.noisy.pfm"));
  CHECK(read_text(folder / "noisy.pfm") != read_text(folder / "box.pfm"));
}

TEST_CASE("--denoise needs random paths, two samples and the whole picture") {
  const SceneFolder folder;
  const auto refused = [&](std::vector<std::string> arguments) {
    const ProcessResult result = run_eyeray(arguments);
    CHECK(result.code == 2);
    return result.err;
  };
  CHECK(
      refused({"render", "scenes/whitted.toml", "--denoise", "-o", folder / "no.png"}) ==
      "eyeray: error: only pictures by random paths are denoised: set integrator = \"path\" in [render], or "
      "leave out denoise\n");
  CHECK(refused(box("1", {"--denoise", "-o", folder / "no.png"})) ==
        "eyeray: error: denoising compares the samples of a pixel, and this picture has one: set at least 2, "
        "such as --spp 16\n");
  CHECK(refused({"render", "scenes/path/cornell_box.toml", "-s", "10000x10000", "--denoise", "-o",
                 folder / "no.png"}) ==
        "eyeray: error: denoising has room for 16777216 pixels, and this picture has 100000000: render crops "
        "of "
        "it, or leave out denoise\n");
  CHECK(refused(box("4", {"--denoise", "--shard", "1/2", "-o", folder / "no.eyeray"})) ==
        "eyeray: error: a pixel is denoised from its neighbours, which are in other shards: leave out "
        "denoise\n");
}
