// eyeray render, check, shaders and devices where all is well.
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "host/image/image_file.hpp"
#include "scene.hpp"
#include "tests/support/faults.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

TEST_CASE("render writes the requested files, and lists them on standard error") {
  const SceneFolder folder;
  const ProcessResult result =
      run_eyeray({"render", folder.scene(), "-o", folder / "a.png", "-o", folder / "a.pfm"});
  CAPTURE(result.err);
  CHECK(result.code == 0);
  CHECK(result.out == "");
  CHECK(result.err.starts_with(folder / "a.png" + ", " + folder / "a.pfm" + ": 64×48, 1 sample a pixel, "));
  CHECK(result.err.find(" on gpu: ") != std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"scene.toml", "a.png", "a.pfm"});

  // The corner sees the background, the middle the sphere.
  const Image image = read_image(folder / "a.pfm");
  REQUIRE(image.width() == 64);
  REQUIRE(image.height() == 48);
  CHECK(image.pixel(0, 0)[0] == 0.25f);
  CHECK(image.pixel(0, 0)[2] == 0.75f);
  CHECK(image.pixel(32, 24)[0] > image.pixel(32, 24)[2]);
}

TEST_CASE("the summary's rays divided by its seconds give its rate") {
  const SceneFolder folder;
  const ProcessResult result =
      run_eyeray({"render", folder.scene(), "-s", "320x240", "--spp", "4", "-o", folder / "a.png"});
  CAPTURE(result.err);
  const std::map<std::string, double> units{{"µs", 1e-6}, {"ms", 1e-3}, {"s", 1},
                                            {"k", 1e3},   {"M", 1e6},   {"G", 1e9}};
  std::smatch found;
  REQUIRE(std::regex_search(
      result.err, found,
      std::regex(
          "([0-9]+) rays in ([0-9.e+]+) (µs|ms|s) \\(([0-9.e+]+) ([kMG])rays/s\\), .* in all, on gpu: ")));
  const double rays = std::stod(found[1]), seconds = std::stod(found[2]) * units.at(found[3]);
  CHECK(rays / seconds == doctest::Approx(std::stod(found[4]) * units.at(found[5])).epsilon(0.02));
}

TEST_CASE("the default output is the scene's name, in the current folder") {
  const SceneFolder folder;
  const ProcessResult result = run_process(
      {"sh", "-c", "cd " + folder.path().string() + " && " + eyeray_binary() + " render scene.toml --quiet"});
  CHECK(result.code == 0);
  CHECK(result.out + result.err == "");
  CHECK(folder.names() == std::set<std::string>{"scene.toml", "scene.png"});
}

TEST_CASE("options override values of the scene") {
  const SceneFolder folder;
  const ProcessResult result =
      run_eyeray({"render", folder.scene(), "-s", "20x10", "--spp", "4", "--crop", "2,1,6,5", "-D",
                  "render.background=[1,2,3]", "-o", folder / "a.pfm", "--json", "--quiet"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  const auto report = nlohmann::json::parse(result.out);
  CHECK(report.at("width") == 6);
  CHECK(report.at("height") == 5);
  CHECK(report.at("samples_done") == 4);
  CHECK(report.at("rays") >= 6 * 5 * 4);
  CHECK(report.at("stages").contains("encode"));
  CHECK(report.at("flags").empty());
  CHECK(read_image(folder / "a.pfm").pixel(0, 0)[2] == 3.0f);
}

TEST_CASE("the three backends write the same picture") {
  const SceneFolder folder;
  for (const std::string backend : {"gpu", "twin", "reference"}) {
    const ProcessResult result =
        run_eyeray({"render", folder.scene(), "--backend", backend, "-o", folder / (backend + ".pfm")});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    CHECK(result.err.find(" on " + backend) != std::string::npos);
  }
  CHECK(read_text(folder / "gpu.pfm") == read_text(folder / "twin.pfm"));
  CHECK(run_eyeray({"compare", folder / "gpu.pfm", folder / "reference.pfm", "--max-different", "10"}).code ==
        0);
}

TEST_CASE("AOVs hold the hits of the camera rays") {
  const SceneFolder folder;
  const ProcessResult result = run_eyeray({"render", folder.scene(), "--aov", "all", "-o", folder / "a.png"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  std::set<std::string> expected{"scene.toml", "a.png"};
  for (const std::string name :
       {"depth",     "position",  "normal", "normal_geometric", "front", "uv",        "shape",
        "primitive", "material",  "hits",   "bounces",          "rays",  "ray_kinds", "samples",
        "noise",     "brightest", "noisy",  "variance",         "half",  "nodes",     "tests",
        "flags"})
    expected.insert({"a." + name + ".pfm", "a." + name + ".png"});
  expected.insert({"a.shape.json", "a.primitive.json", "a.material.json"});
  CHECK(folder.names() == expected);

  // A unit sphere at distance 4, seen through the pixel just beside its middle.
  CHECK(*read_image(folder / "a.depth.pfm").pixel(32, 24) == doctest::Approx(3).epsilon(1e-3));
  CHECK(std::isinf(*read_image(folder / "a.depth.pfm").pixel(0, 0)));
  CHECK(read_image(folder / "a.normal.pfm").pixel(32, 24)[2] == doctest::Approx(1).epsilon(1e-2));
  CHECK(*read_image(folder / "a.primitive.pfm").pixel(32, 24) == 0);
  CHECK(*read_image(folder / "a.primitive.pfm").pixel(0, 0) == -1);
  CHECK(*read_image(folder / "a.hits.pfm").pixel(32, 24) == 1);
  CHECK(*read_image(folder / "a.hits.pfm").pixel(0, 0) == 0);
  CHECK(*read_image(folder / "a.front.pfm").pixel(32, 24) == 1);
  CHECK(std::isnan(*read_image(folder / "a.front.pfm").pixel(0, 0)));
  CHECK(*read_image(folder / "a.shape.pfm").pixel(32, 24) == 0);
  CHECK(*read_image(folder / "a.shape.pfm").pixel(0, 0) == -1);
  CHECK(*read_image(folder / "a.tests.pfm").pixel(0, 0) == 1);
  CHECK(*read_image(folder / "a.nodes.pfm").pixel(0, 0) == 0);
}

TEST_CASE(
    "at iteration limits a warning counts the pixels, and an AOV shows every wrong one, also in shadow" *
    doctest::test_suite("long")) {
  const SceneFolder folder;
  const auto render = [&](const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(), {"render", "scenes/shapes/superellipsoid.toml", "-s", "120x80", "--json",
                                     "--aov", "flags", "-o", folder / (name + ".pfm")});
    return run_eyeray(options);
  };
  REQUIRE(render("right", {"--backend", "twin"}).code == 0);
  const Image right = read_image(folder / "right.pfm");
  const Image no_flags = read_image(folder / "right.flags.pfm");
  const std::string steps = lay_fault(folder, "steps");
  // One ray after the other, and in packets, which trace shadow rays in a separate kernel.
  for (const std::string rays : {"lanes", "packets"}) {
    CAPTURE(rays);
    const ProcessResult result =
        render(rays, {"--shaders", steps, "--tune", "acceleration=bvh", "--tune", "rays=" + rays});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const Image picture = read_image(folder / (rays + ".pfm"));
    const Image flags = read_image(folder / (rays + ".flags.pfm"));
    int flagged = 0, wrong = 0, silent = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const bool same = std::equal(picture.pixel(x, y), picture.pixel(x, y) + 3, right.pixel(x, y));
        const float flag = *flags.pixel(x, y);
        CHECK((flag == 0 || flag == 8));
        CHECK(*no_flags.pixel(x, y) == 0);
        flagged += flag != 0;
        wrong += !same;
        silent += !same && flag == 0;
      }
    }
    CHECK(wrong > 100);
    CHECK(silent == 0);
    CHECK(flagged < 2 * wrong);
    const std::string warning =
        std::to_string(flagged) + " pixels may be wrong: the search for a shape ran out of";
    CHECK(result.err.find(warning) != std::string::npos);
    const auto report = nlohmann::json::parse(result.out);
    CHECK(report.at("flagged_pixels") == flagged);
    CHECK(report.at("flags") == nlohmann::json({"iteration_limit"}));
  }
}

TEST_CASE("--stats names the stages") {
  const SceneFolder folder;
  const ProcessResult result = run_eyeray({"render", folder.scene(), "--stats", "-o", folder / "a.png"});
  for (const std::string stage :
       {"load", "device", "pack", "shader compile", "pipeline", "dispatch", "read-back", "encode"}) {
    CAPTURE(stage);
    CHECK(result.err.find("\n  " + stage + " ") != std::string::npos);
  }
}

TEST_CASE("check prints the numbers that follow from a scene") {
  const SceneFolder folder;
  const ProcessResult text = run_eyeray({"check", folder.scene()});
  CHECK(text.code == 0);
  CHECK(text.err == "");
  CHECK(text.out.find("u right    (1, 0, 0)") != std::string::npos);
  CHECK(text.out.find("60° horizontal, 46.8264° vertical") != std::string::npos);
  CHECK(text.out.find("shapes       1 sphere\n") != std::string::npos);

  const auto json = nlohmann::json::parse(run_eyeray({"check", folder.scene(), "--json"}).out);
  CHECK(json.at("camera").at("w") == nlohmann::json{0.0, 0.0, -1.0});
  CHECK(json.at("camera").at("distance").get<double>() == doctest::Approx(std::sqrt(3)));
  CHECK(json.at("materials").at("phong") == 1);
  CHECK(json.at("lights").at("point") == 1);
}

TEST_CASE("check prints the bounding box of the shapes, and the number of unbounded shapes") {
  const SceneFolder folder;
  const auto bounds = [&](const std::string& shapes) {
    const std::string scene = folder / "shapes.toml";
    write_text(scene, "[[material]]\nname = \"a\"\ntype = \"phong\"\n" + shapes);
    const std::string text = run_eyeray({"check", scene}).out;
    const size_t begin = text.find("\nbounds ");
    REQUIRE(begin != std::string::npos);
    return std::pair(text.substr(begin + 1, text.find('\n', begin + 1) - begin - 1),
                     nlohmann::json::parse(run_eyeray({"check", scene, "--json"}).out).at("bounds"));
  };
  const std::string sphere = "[[sphere]]\ncenter = [1, 2, 3]\nradius = 0.5\nmaterial = \"a\"\n";
  const std::string plane = "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = \"a\"\n";
  using nlohmann::json;
  CHECK(bounds(sphere) ==
        std::pair(std::string("bounds       (0.5, 1.5, 2.5) to (1.5, 2.5, 3.5)"),
                  json{{"min", {0.5, 1.5, 2.5}}, {"max", {1.5, 2.5, 3.5}}, {"unbounded_shapes", 0}}));
  CHECK(bounds(sphere + plane).first ==
        "bounds       (0.5, 1.5, 2.5) to (1.5, 2.5, 3.5), and 1 unbounded shape");
  CHECK(bounds(plane + plane) ==
        std::pair(std::string("bounds       none: 2 unbounded shapes"),
                  json{{"min", nullptr}, {"max", nullptr}, {"unbounded_shapes", 2}}));
  CHECK(bounds("") == std::pair(std::string("bounds       none"),
                                json{{"min", nullptr}, {"max", nullptr}, {"unbounded_shapes", 0}}));
}

TEST_CASE("check prints the focus of each kind of camera") {
  const std::string everything = "  focus      everything is sharp: the camera has no aperture\n";
  for (const char* scene : {"scenes/whitted.toml", "scenes/orthographic.toml", "scenes/cameras/fisheye.toml",
                            "scenes/cameras/panorama.toml", "scenes/cameras/cylindrical.toml"}) {
    CAPTURE(scene);
    CHECK(run_eyeray({"check", scene}).out.find(everything) != std::string::npos);
  }
  CHECK(run_eyeray({"check", "scenes/cameras/formula.toml"})
            .out.find("  focus      set by the camera's function\n") != std::string::npos);

  // A camera at (1, 2, 3) that looks along (0, 3, -4) / 5.
  const SceneFolder folder;
  write_text(folder.scene(), "[camera]\neye = [1, 2, 3]\ntarget = [1, 5, -1]\naperture = 0.1\nfocus = 10\n");
  CHECK(run_eyeray({"check", folder.scene()})
            .out.find("  focus      (1, 8, -5), 10 in front of the eye: the plane of focus passes through "
                      "this point, perpendicular to w\n") != std::string::npos);
  const auto camera = nlohmann::json::parse(run_eyeray({"check", folder.scene(), "--json"}).out).at("camera");
  CHECK(camera.at("focus") == 10);
  CHECK(camera.at("focus_point")[1].get<double>() == doctest::Approx(8));
  CHECK(camera.at("focus_point")[2].get<double>() == doctest::Approx(-5));
}

TEST_CASE("check --schema is JSON, --manual is Markdown") {
  CHECK(nlohmann::json::parse(run_eyeray({"check", "--schema"}).out).contains("properties"));
  CHECK(run_eyeray({"check", "--manual"}).out.starts_with("#"));
}

TEST_CASE("devices lists the values that --device takes") {
  const ProcessResult text = run_eyeray({"devices"});
  CHECK(text.code == 0);
  CHECK(text.out.starts_with("0  "));
  const auto json = nlohmann::json::parse(run_eyeray({"devices", "--json"}).out);
  REQUIRE(json.at("devices").size() >= 1);
  CHECK(json.at("devices")[0].at("limits").at("storage_range") > 0);
}

TEST_CASE("shaders: exported files render the same picture, and changed ones are not overwritten") {
  const SceneFolder folder;
  const std::string shaders = folder / "shaders";
  REQUIRE(run_eyeray({"shaders", "--export", shaders}).code == 0);
  CHECK(run_eyeray({"shaders", "--print", "kernels/render.comp.glsl"}).out ==
        read_text(shaders + "/kernels/render.comp.glsl"));
  CHECK(run_eyeray({"shaders", "--list"}).out.find("shapes/sphere.glsl\n") != std::string::npos);

  REQUIRE(run_eyeray({"render", folder.scene(), "-o", folder / "a.pfm"}).code == 0);
  REQUIRE(run_eyeray({"render", folder.scene(), "-o", folder / "b.pfm", "--shaders", shaders}).code == 0);
  CHECK(read_text(folder / "a.pfm") == read_text(folder / "b.pfm"));

  // A changed shader changes the picture, and survives another export.
  write_text(shaders + "/kernels/pixel.glsl",
             with_pixel_code(read_text(shaders + "/kernels/pixel.glsl"), "  color += 1.0f;\n"));
  REQUIRE(run_eyeray({"render", folder.scene(), "-o", folder / "b.pfm", "--shaders", shaders}).code == 0);
  CHECK(read_image(folder / "b.pfm").pixel(0, 0)[0] == 1.25f);
  const ProcessResult again = run_eyeray({"shaders", "--export", shaders});
  CHECK(again.code == 4);
  CHECK(
      again.err ==
      "eyeray: error: " + shaders +
          "/kernels/pixel.glsl differs from the embedded shader; nothing was written (--force overwrites)\n");
  CHECK(run_eyeray({"shaders", "--export", shaders, "--force"}).code == 0);
  CHECK(read_text(shaders + "/kernels/pixel.glsl").find("color += 1.0f") == std::string::npos);
}
