// eyeray render --denoise.
#include <algorithm>
#include <cmath>
#include <filesystem>
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

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
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
  for (const char* way : {"denoise=kernels", "denoise=processor"}) {
    REQUIRE(run_eyeray(box("16", {"--denoise", "--tune", way, "-o", folder / "way.pfm", "-q"})).code == 0);
    CHECK(read_text(folder / "way.pfm") == read_text(folder / "twin.pfm"));
  }

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

TEST_CASE("--noise is the noise after --denoise") {
  const SceneFolder folder;
  const auto render = [&](std::vector<std::string> more) {
    std::vector<std::string> all = box("2048", {"--noise", "0.1", "--json", "--aov", "noise", "-q"});
    all.insert(all.end(), more.begin(), more.end());
    const ProcessResult result = run_eyeray(all);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    return nlohmann::json::parse(result.out);
  };
  const auto noisy = render({"-o", folder / "noisy.pfm"});
  const auto denoised = render({"--denoise", "-o", folder / "gpu.pfm"});
  const auto samples = [](const nlohmann::json& report) {
    return report.at("noise").at("mean_samples").get<double>();
  };
  CHECK(samples(denoised) < 0.6 * samples(noisy));
  CHECK(denoised.at("noise").at("share") == 1);
  const Image left = read_image(folder / "gpu.noise.pfm");
  CHECK(std::ranges::max(left.samples()) <= 0.1f);
  CHECK(std::ranges::max(left.samples()) == float(denoised.at("noise").at("greatest").get<double>()));
  render({"--denoise", "--backend", "twin", "-o", folder / "twin.pfm"});
  CHECK(read_text(folder / "gpu.pfm") == read_text(folder / "twin.pfm"));

  REQUIRE(run_eyeray(box("4096", {"-o", folder / "truth.pfm", "-q"})).code == 0);
  const Image truth = read_image(folder / "truth.pfm"), picture = read_image(folder / "gpu.pfm");
  double errors = 0, light = 0;
  for (size_t i = 1; i < truth.sample_count(); i += 3) {
    const double here = double(truth.samples()[i]);
    errors += std::abs(double(picture.samples()[i]) - here);
    light += here;
  }
  CHECK(errors < 0.1 * light);
}

TEST_CASE("--denoise oidn uses a library, which estimates no error") {
  const SceneFolder folder;
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"--denoise", "oidn"}, {"--denoiser", "oidn"}}) {
    std::vector<std::string> more = option;
    more.insert(more.end(), {"--json", "-o", folder / "a.pfm", "--aov", "noisy,albedo,shading_normal"});
    const ProcessResult result = run_eyeray(box("4", more), {{"EYERAY_OPEN_IMAGE_DENOISE", FAKE_OIDN}});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    CHECK(!nlohmann::json::parse(result.out).contains("noise_left"));
    const Image picture = read_image(folder / "a.pfm"), noisy = read_image(folder / "a.noisy.pfm"),
                albedo = read_image(folder / "a.albedo.pfm"),
                normal = read_image(folder / "a.shading_normal.pfm");
    for (size_t i = 0; i < picture.sample_count(); i += 997)
      CHECK(picture.samples()[i] ==
            0.5f * noisy.samples()[i] + 0.25f * albedo.samples()[i] + 0.125f * normal.samples()[i]);
  }
  const ProcessResult absent = run_eyeray(box("4", {"--denoise", "oidn", "-o", folder / "b.pfm"}),
                                          {{"EYERAY_OPEN_IMAGE_DENOISE", "/no/such/library.so"}});
  CHECK(absent.code == 2);
  CHECK(absent.err.find("the library Open Image Denoise is not on this machine: install it, or denoise with "
                        "eyeray's own denoiser by --denoise alone; ") != std::string::npos);
  CHECK(!std::filesystem::exists(folder / "b.pfm"));
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

TEST_CASE("verify --denoise compares the denoised pictures, and names scenes without any") {
  const std::vector<std::string> scene{"verify", "scenes/path/cornell_box.toml", "-s", "64x48", "--quiet"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), scene.begin(), scene.end());
    return run_eyeray(more);
  };
  const ProcessResult result = with({"--spp", "4", "--denoise"});
  CAPTURE(result.out);
  CHECK(result.code == 0);
  CHECK(has(result.out, "  gate A passed gpu = twin, denoised: 0 of 3072 pixels differ in their bits\n"));
  CHECK(has(result.out, "  gate B passed gpu = reference, denoised: 0 of 3072 pixels differ"));
  CHECK(has(result.out, "  gate B passed twin = reference, denoised: 0 of 3072 pixels differ"));

  const ProcessResult by_scene = with({"--spp", "4", "-D", "render.denoise=true", "--json"});
  CHECK(by_scene.code == 0);
  const auto denoised = nlohmann::json::parse(by_scene.out)["scenes"][0]["denoised"];
  REQUIRE(denoised.size() == 2);
  CHECK(denoised[1]["different_pixels"] == 0);
  CHECK(denoised[1]["wrong_pixels"] == 0);
  CHECK(denoised[1]["largest_in_tolerances"] < 0.5);
  CHECK(denoised[1]["largest_in_tolerances"] > 0);

  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"verify", "scenes/whitted.toml", "--denoise"},
        {"verify", "scenes/path/cornell_box.toml", "--spp", "1", "--denoise"}}) {
    const ProcessResult refused = run_eyeray(arguments);
    CHECK(refused.code == 2);
    CHECK(has(refused.err,
              "--denoise compares denoised pictures, which need integrator = \"path\" or \"sppm\""));
  }
}

TEST_CASE("a picture is not lost if the device fails to denoise it") {
  const SceneFolder folder;
  REQUIRE(run_eyeray(box("2", {"--denoise", "-o", folder / "whole.pfm", "-q"})).code == 0);
  // The device is lost at a later and later dispatch, until that is one of denoising.
  for (int call = 10; call < 100; call += 5) {
    const std::string lost = "vkWaitForFences " + std::to_string(call) + " -4";
    const ProcessResult result =
        run_eyeray(box("2", {"--denoise", "--tune", "denoise=kernels", "-o", folder / "lost.pfm"}),
                   {{"EYERAY_VULKAN_LOADER", FAILING_VULKAN}, {"EYERAY_FAILING_CALL", lost}});
    CAPTURE(result.err);
    if (result.code == 3) continue;
    CHECK(result.code == 0);
    CHECK(has(result.err,
              "eyeray: warning: the picture was denoised by the processor, because the device failed: "));
    CHECK(read_text(folder / "lost.pfm") == read_text(folder / "whole.pfm"));
    return;
  }
  FAIL("no dispatch of denoising failed");
}
