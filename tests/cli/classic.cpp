// eyeray render --classic and --stats.
#include <nlohmann/json.hpp>

#include "host/image/image_file.hpp"
#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

TEST_CASE("--stats counts rays by kind, in words and in JSON") {
  const SceneFolder folder;
  const ProcessResult result =
      run_eyeray({"render", folder.scene(), "-o", folder / "a.png", "--stats", "--json"});
  REQUIRE(result.code == 0);
  CHECK(result.err.find("\n"
                        "  camera rays            3072, ") != std::string::npos);
  const auto report = nlohmann::json::parse(result.out);
  const auto& kinds = report.at("ray_kinds");
  CHECK(kinds.at("eye") == 64 * 48);
  CHECK(kinds.at("shadow") == report.at("rays").get<int>() - 64 * 48);
  CHECK(kinds.at("eye_hits") > 500);
  CHECK(kinds.at("reflected") == 0);

  const ProcessResult plain =
      run_eyeray({"render", folder.scene(), "-o", folder / "b.png", "--json", "--quiet"});
  CHECK_FALSE(nlohmann::json::parse(plain.out).contains("ray_kinds"));
  CHECK(read_text(folder / "a.png") == read_text(folder / "b.png"));
}

TEST_CASE("--classic shoots a ray through each pixel corner, also in a crop and in bands") {
  const SceneFolder folder;
  const auto render = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> arguments{"render",    folder.scene(), "-o",     folder / name,
                                       "--classic", "--stats",      "--json", "--quiet",
                                       "--backend", "twin",         "--aov",  "hits"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult result = run_eyeray(arguments);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    return nlohmann::json::parse(result.out);
  };
  const auto whole = render("whole.pfm", {});
  CHECK(whole.at("width") == 64);
  CHECK(whole.at("height") == 48);
  CHECK(whole.at("ray_kinds").at("eye") == 65 * 49);
  const Image picture = read_image(folder / "whole.pfm");
  REQUIRE(picture.width() == 64);
  REQUIRE(picture.height() == 48);

  CHECK(render("crop.pfm", {"--crop", "20,10,12,9"}).at("ray_kinds").at("eye") == 13 * 10);
  const Image crop = read_image(folder / "crop.pfm");
  int different = 0;
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 12 * 3; ++x) different += crop.pixel(0, y)[x] != picture.pixel(20, 10 + y)[x];
  }
  CHECK(different == 0);
}

TEST_CASE("options that --classic sets cannot be given beside it") {
  const SceneFolder folder;
  const auto refused = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"render", folder.scene(), "-o", folder / "a.png", "--classic"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult result = run_eyeray(arguments);
    CHECK(result.code == 2);
    CHECK(folder.names() == std::set<std::string>{"scene.toml"});
    return result.err;
  };
  CHECK(refused({"--spp", "4"}).find("--classic") != std::string::npos);
  CHECK(refused({"--max-depth", "2"}).find("--classic") != std::string::npos);
  CHECK(refused({"--aov", "depth"}).find("lacks the AOVs depth; it has hits, bounces,") != std::string::npos);
}
