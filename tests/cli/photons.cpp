// eyeray render under `sppm`: checkpoints, --noise, AOVs, and devices with too little memory for photons.
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "host/image/image_file.hpp"
#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

namespace {

constexpr const char* box = "scenes/sppm/box.toml";

std::vector<std::string> extended(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

double luminance(const Image& image, size_t pixel) {
  const auto at = [&](size_t c) { return double(image.samples()[3 * pixel + c]); };
  return 0.2126 * at(0) + 0.7152 * at(1) + 0.0722 * at(2);
}

}  // namespace

TEST_CASE("a photon picture killed amid its samples and resumed equals the uninterrupted one") {
  const TemporaryFolder folder;
  for (const std::string backend : {"gpu", "twin"}) {
    CAPTURE(backend);
    const std::vector<std::string> command{
        "render",    box,     "-s",     "24x24",   "--spp", "48",           "-D", "render.photons=4096",
        "--backend", backend, "--json", "--quiet", "--aov", "noise,samples"};
    REQUIRE(run_eyeray(extended(command, {"-o", folder / "whole.pfm"})).code == 0);

    Process process(extended(
        extended({eyeray_binary()}, command),
        {"-o", folder / "parts.pfm", "--checkpoint", folder / "work", "--checkpoint-every", "0.01"}));
    const Stopwatch watch;
    while (!std::filesystem::exists(folder / "work") && watch.seconds() < 600 && !process.wait(0.001)) {
    }
    process.send_signal(SIGKILL);
    process.wait(600);
    REQUIRE(process.code() == 128 + SIGKILL);

    const ProcessResult rest =
        run_eyeray(extended(command, {"-o", folder / "parts.pfm", "--resume", folder / "work"}));
    CAPTURE(rest.err);
    REQUIRE(rest.code == 0);
    const auto resumed = nlohmann::json::parse(rest.out).at("resumed").at("samples");
    CHECK(resumed > 0);
    CHECK(resumed < 48 * 24 * 24);
    for (const std::string file : {".pfm", ".noise.pfm", ".samples.pfm"})
      CHECK(read_text(folder / ("parts" + file)) == read_text(folder / ("whole" + file)));
  }
}

TEST_CASE("--noise stops photons at pixels with the wanted error, measured against a long picture") {
  const TemporaryFolder folder;
  const std::vector<std::string> command{"render",    box,    "-s",      "16x16", "-D", "render.photons=1024",
                                         "--backend", "twin", "--quiet", "--json"};
  REQUIRE(run_eyeray(extended(command, {"--spp", "500", "--seed", "99", "-o", folder / "long.pfm"})).code ==
          0);
  const Image exact = read_image(folder / "long.pfm");
  size_t within = 0, all = 0;
  for (const std::string seed : {"1", "2"}) {
    const ProcessResult result = run_eyeray(
        extended(command, {"--noise", "0.5", "--seed", seed, "--aov", "noise", "-o", folder / "a.pfm"}));
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const auto output = nlohmann::json::parse(result.out).at("noise");
    CHECK(output.at("share") == 1);
    CHECK(output.at("most_samples") < 500);

    const Image picture = read_image(folder / "a.pfm"), noise = read_image(folder / "a.noise.pfm");
    for (size_t i = 0; i < noise.sample_count(); ++i, ++all) {
      CHECK(noise.samples()[i] <= 0.5f);
      const double off = std::abs(luminance(picture, i) - luminance(exact, i));
      within += off <= double(noise.samples()[i]) * (luminance(exact, i) + 0.01);
    }
  }
  // The intervals are of 95 %, and their pixels share photons.
  CHECK(double(within) / double(all) > 0.93);
}

TEST_CASE("AOVs of the first hit, and denoisers' AOVs, are as in paths") {
  const TemporaryFolder folder;
  for (const std::string integrator : {"sppm", "path"}) {
    const ProcessResult result =
        run_eyeray({"render", box, "-s", "32x32", "--spp", "2", "--integrator", integrator, "--quiet",
                    "--aov", "all", "-o", folder / (integrator + ".pfm")});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
  }
  for (const std::string aov :
       {"albedo", "shading_normal", "depth", "flags", "front", "material", "nodes", "normal",
        "normal_geometric", "position", "primitive", "samples", "shape", "tests", "uv"})
    CHECK_MESSAGE(
        read_text(folder / ("sppm." + aov + ".pfm")) == read_text(folder / ("path." + aov + ".pfm")), aov);
  CHECK(read_text(folder / "sppm.pfm") != read_text(folder / "path.pfm"));
  CHECK(read_text(folder / "sppm.rays.pfm") != read_text(folder / "path.rays.pfm"));
}

TEST_CASE("more photons than a device has room for give an error with the numbers, and no picture") {
  const SceneFolder folder;
  const auto refusal = [&](const std::string& photons, const std::vector<std::string>& more) {
    const ProcessResult result =
        run_eyeray(extended({"render", folder.scene(), "--integrator", "sppm", "-D",
                             "render.photons=" + photons, "-s", "8x8", "--spp", "1", "--quiet", "--device",
                             "cpu", "-D", "render.photon_radius=0.01", "-o", folder / "a.png"},
                            more));
    CHECK(result.code == 3);
    CHECK(folder.names() == std::set<std::string>{"scene.toml"});
    return result.err;
  };
  const std::string results = refusal("16777216", {});
  CAPTURE(results);
  CHECK(results.find("error: `photons` in [render] is 16777216, but ") != std::string::npos);
  CHECK(results.find(" has memory for the results of ") != std::string::npos);

  // In a ball of white, surfaces stop each photon some forty times.
  write_text(folder.scene(), R"(
[camera]
eye = [0, 0, 0.5]

[render]
max_depth = 64

[[light]]
type = "point"
position = [0, 0.2, 0]

[[material]]
name = "white"
type = "diffuse"
color = 0.999

[[sphere]]
center = [0, 0, 0]
radius = 1
material = "white"
)");
  const std::string stopped = refusal("65536", {});
  CAPTURE(stopped);
  CHECK(stopped.find("error: of 65536 photons, surfaces store ") != std::string::npos);
  CHECK(stopped.find(" (64 bytes each; a shader sees ") != std::string::npos);
  CHECK(stopped.find(" of one buffer): lower `photons` in [render] to ") != std::string::npos);
}
