// eyeray probe: the rays of one pixel side by side.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/image/image_file.hpp"
#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

namespace {

using Json = nlohmann::json;

struct Probed {
  int code;
  Json json;
};

Probed probe(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "probe");
  arguments.push_back("--json");
  const ProcessResult result = run_eyeray(arguments);
  CAPTURE(result.err);
  REQUIRE(result.code <= 1);
  return {result.code, Json::parse(result.out)};
}

// The ray's value of that name, as an executor has it.
Json value(const Json& ray, const std::string& name, const std::string& executor) {
  for (const Json& line : ray.at("values"))
    if (line.at("name") == name) return line.at(executor);
  return {};
}

// Probes pixels of a sound scene: none differs, and the colours are those that render writes.
void expect_agreement(const std::string& scene, int pixels) {
  CAPTURE(scene);
  const TemporaryFolder folder;
  const std::string picture = folder / "a.pfm";
  REQUIRE(run_eyeray({"render", scene, "-s", "96x72", "-o", picture, "--quiet"}).code == 0);
  const Image image = read_image(picture);
  for (int i = 0; i < pixels; ++i) {
    const int x = (48 + 29 * i) % 96, y = (40 + 17 * i) % 72;
    const Probed probed = probe({scene, fmt::format("{},{}", x, y), "-s", "96x72"});
    CAPTURE(probed.json.dump());
    CHECK(probed.code == 0);
    CHECK(probed.json.at("first_difference").is_null());
    CHECK(probed.json.at("notes").empty());
    const Json& rays = probed.json.at("rays");
    REQUIRE(rays.size() >= 2);
    CHECK(rays[0].at("ray") == "pixel");
    CHECK(rays[1].at("ray") == "eye");
    const Json color = value(rays[0], "color", "gpu");
    for (int c = 0; c < 3; ++c) CHECK(color[size_t(c)] == double(image.pixel(x, y)[c]));
    for (const Json& ray : rays)
      if (ray.at("ray") != "pixel")
        CHECK(value(ray, "origin", "gpu").size() + value(ray, "origin", "reference").size() == 6);
  }
}

}  // namespace

TEST_CASE("probe shows every ray of a pixel by three executors, and no difference in a correct render") {
  expect_agreement("scenes/whitted.toml", 2);
}

TEST_CASE("a ray straight through a pane or an interface is a refracted ray in every executor") {
  for (const char* scene : {"scenes/path/panes.toml", "scenes/path/haze.toml"}) {
    CAPTURE(scene);
    const Probed probed = probe({scene, "40,30", "-s", "96x72", "--spp", "1"});
    CAPTURE(probed.json.dump());
    CHECK(probed.json.at("first_difference").is_null());
    const Json& rays = probed.json.at("rays");
    REQUIRE(rays.size() >= 3);
    CHECK(rays[1].at("ray") == "eye");
    CHECK(rays[2].at("ray") == "refracted");
    CHECK(rays[2].at("parent") == 0);
  }
}

TEST_CASE("probe shows every ray and no difference in every kind of scene" * doctest::test_suite("long")) {
  for (const char* scene :
       {"scenes/cornell.toml", "scenes/inside_glass.toml", "scenes/meshes.toml", "scenes/textures.toml",
        "scenes/alpha.toml", "scenes/group_instances.toml", "scenes/orthographic.toml",
        "scenes/sphereflake.toml", "scenes/shapes/csg.toml", "scenes/shapes/implicit.toml",
        "scenes/shapes/torus.toml", "scenes/shapes/bezier.toml", "scenes/edges/nested.toml"})
    expect_agreement(scene, 4);
}

TEST_CASE("probe's text starts with the verdict, then has a line a value and a column an executor") {
  const SceneFolder folder;
  const ProcessResult result = run_eyeray({"probe", folder.scene(), "32,24"});
  CAPTURE(result.out);
  CHECK(result.code == 0);
  CHECK(result.out.starts_with("pixel 32,24 of " + folder.scene() +
                               " (64×48), sample 0 of 1: nothing differs\n"));
  CHECK(result.out.find("  camera ray → sphere, " + folder.scene() + ":24\n") != std::string::npos);
  CHECK(result.out.find("\n    shadow ray to light 0\n") != std::string::npos);
  CHECK(result.out.find("\n    origin ") != std::string::npos);
  CHECK(result.out.find("≠") == std::string::npos);
  CHECK(result.out.find("\033") == std::string::npos);

  // A pixel beside the ball. With the reference alone, no values can differ.
  const ProcessResult sky = run_eyeray({"probe", folder.scene(), "0,0", "--backends", "reference"});
  CHECK(sky.code == 0);
  CHECK(sky.out.find("  camera ray → nothing\n") != std::string::npos);
  CHECK(sky.out.find("0.25 0.5 0.75\n") != std::string::npos);
}

TEST_CASE("the sample that differs, or the requested one, is shown among several") {
  const SceneFolder folder;
  const Probed other = probe({folder.scene(), "32,24", "--spp", "4", "--sample", "3"});
  CHECK(other.code == 0);
  CHECK(other.json.at("sample") == 3);
  CHECK(other.json.at("samples") == 4);
  CHECK(value(other.json.at("rays")[1], "direction", "gpu") !=
        value(probe({folder.scene(), "32,24", "--spp", "4"}).json.at("rays")[1], "direction", "gpu"));
}

TEST_CASE("a PROBE in a user's shader prints a line, and probe finds the shader's first difference") {
  const TemporaryFolder folder;
  const std::string shader = folder / "bsdf/fresnel.glsl";
  const std::string whole = "return 0.5f * (parallel * parallel + crossed * crossed);";
  lay_changed_shader(
      folder.path(), "bsdf/fresnel.glsl", whole,
      "PROBE(parallel, parallel);\n  return 0.4f * (parallel * parallel + crossed * crossed);");
  const Probed probed = probe({"scenes/whitted.toml", "48,45", "-s", "96x72", "--shaders", folder.path()});
  CHECK(probed.code == 1);
  const Json& first = probed.json.at("first_difference");
  CAPTURE(first.dump());
  CHECK(first.at("way") == "camera ray");
  CHECK(first.at("name") == "reflected");
  CHECK(first.at("difference").get<std::string>().find(" ULP; gpu and reference: ") != std::string::npos);
  REQUIRE(probed.json.at("notes").size() == 1);
  CHECK(probed.json.at("notes")[0] == "the gpu has " + shader + "; the twin has the built-in shaders");
  bool seen = false;
  for (const Json& line : probed.json.at("rays")[1].at("values")) {
    if (line.at("name") != "parallel") continue;
    seen = true;
    CHECK(line.at("file") == "bsdf/fresnel.glsl");
    CHECK(line.at("gpu").is_number());
    CHECK_FALSE(line.contains("twin"));
  }
  CHECK(seen);
}

TEST_CASE("pixels that cannot be probed are refused in one line") {
  const SceneFolder folder;
  const auto error = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"probe", folder.scene()});
    const ProcessResult result = run_eyeray(arguments);
    CHECK(result.code == 2);
    CHECK(result.out == "");
    return result.err;
  };
  for (const char* outside : {"64,0", "0,48"})
    CHECK(error({outside}) ==
          fmt::format("eyeray: error: there is no pixel {}: the picture is 64×48, its first "
                      "pixel 0,0\n",
                      outside));
  for (const char* wrong : {"3", "3,4,5", "a,b", "1.5,2", "99999999999,1"})
    CHECK(error({wrong}) ==
          fmt::format("eyeray: error: a pixel must be X,Y, such as 320,240, not '{}'\n", wrong));
  CHECK(error({"1,1", "--sample", "1"}) ==
        "eyeray: error: --sample 1: a pixel has 1 sample, the first is 0\n");
  CHECK(error({"1,1", "--backends", "gpu,cpu"}) ==
        "eyeray: error: no backend is named 'cpu': choose gpu, twin, reference or emulator\n");
  CHECK(error({}).find("PIXEL is required") != std::string::npos);
}
