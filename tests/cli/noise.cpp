// eyeray render --noise, and the AOVs samples and noise.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/image/image_file.hpp"
#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

TEST_CASE("--noise gives each pixel the samples that it needs, equal in all executors with equal bits") {
  const SceneFolder folder;
  std::string pictures[2];
  for (const std::string backend : {"gpu", "twin"}) {
    const ProcessResult result =
        run_eyeray({"render", "scenes/path/cornell_box.toml", "-s", "32x32", "--noise", "0.3", "--backend",
                    backend, "--json", "--aov", "samples,noise", "-o", folder / (backend + ".pfm")});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    CHECK(result.err.find(" samples a pixel (mean ") != std::string::npos);
    pictures[backend == "twin"] = read_text(folder / (backend + ".pfm"));

    const auto noise = nlohmann::json::parse(result.out).at("noise");
    CHECK(noise.at("wanted") == 0.3);
    CHECK(noise.at("share") == 1);
    const Image samples = read_image(folder / (backend + ".samples.pfm"));
    const Image shown = read_image(folder / (backend + ".noise.pfm"));
    const auto [least, most] = std::ranges::minmax(samples.samples());
    CHECK(least < most);
    CHECK(int(most) == noise.at("most_samples"));
    CHECK(std::ranges::max(shown.samples()) == float(noise.at("greatest").get<double>()));
    CHECK(std::ranges::max(shown.samples()) <= 0.3f);
  }
  CHECK(pictures[0] == pictures[1]);
}

TEST_CASE("--noise that cannot be reached is reported, and options without noise are refused") {
  const SceneFolder folder;
  const ProcessResult few = run_eyeray({"render", "scenes/path/cornell_box.toml", "-s", "16x16", "--noise",
                                        "0.001", "--spp", "70", "-o", folder / "a.png", "--quiet"});
  CHECK(few.code == 0);
  CHECK(few.err.starts_with("eyeray: warning: 100 % of the pixels have more noise than 0.001, up to "));
  CHECK(few.err.ends_with(": 70 samples a pixel are too few; allow more\n"));

  const auto refusal = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments{"render", folder.scene(), "-o", folder / "b.png"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProcessResult result = run_eyeray(arguments);
    CHECK(result.code == 2);
    return result.err;
  };
  CHECK(refusal({"--noise", "0.1"}) ==
        "eyeray: error: noise stops after any number of samples, but the pattern 'regular' needs all of "
        "them: set image.pattern to \"sobol\" or \"random\"\n");
  for (const std::string wrong : {"nan", "0", "-1", "2", "x"})
    CHECK(refusal({"--noise", wrong}).find("must be a number from 0.0001 to 1, not") != std::string::npos);
  refusal({"--noise", "0.1", "--classic"});
  CHECK(refusal({"--classic", "--aov", "noise"}) ==
        "eyeray: error: --classic samples pixel corners, so it lacks the AOVs noise; it has hits, bounces, "
        "rays, ray_kinds, samples, coverage, flags\n");
  CHECK(folder.names() == std::set<std::string>{"a.png", "scene.toml"});
}
