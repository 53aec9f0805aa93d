// eyeray render --transparent.
#include <cmath>
#include <filesystem>

#include "host/image/image_file.hpp"
#include "parts.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

namespace {

// A ball in the middle that shines with one colour, before a background of another.
constexpr const char* shining_ball = R"([image]
width = 40
height = 30
samples = 64

[camera]
eye = [0, 0, 4]
target = [0, 0, 0]
fov = 60

[render]
background = [0.5, 0.75, 1]

[[light]]
type = "point"
position = [0, 0, 9]
intensity = 1e-9

[[material]]
name = "shining"
type = "phong"
diffuse = 1e-3
emission = [0.5, 0.25, 0.125]

[[sphere]]
center = [0, 0, 0]
radius = 1
material = "shining"
)";
constexpr float shine[] = {0.5f, 0.25f, 0.125f};

class BallFolder : public SceneFolder {
 public:
  BallFolder() { write_text(scene(), shining_ball); }
};

void render(const Words& words) {
  const ProcessResult result = run_eyeray(Words{"render", "--quiet"} + words);
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
}

std::string refusal(const Words& words) {
  const ProcessResult result = run_eyeray(Words{"render", "--quiet"} + words);
  CHECK(result.code == 2);
  return result.err;
}

Image alpha_of(const std::string& file) {
  const auto alpha = read_alpha(file);
  REQUIRE(alpha.has_value());
  return *alpha;
}

// The share of pixel (x, y) that the ball covers: its outline is a circle in the picture's middle.
double coverage_of_ball(int x, int y) {
  const double radius = std::tan(std::asin(0.25)) / std::tan(M_PI / 6) * 20;
  constexpr int across = 64;
  int inside = 0;
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < across; ++i)
      inside += std::hypot(x + (i + 0.5) / across - 20, y + (j + 0.5) / across - 15) < radius;
  return double(inside) / (across * across);
}

}  // namespace

TEST_CASE("the alpha of a ball is the share of each pixel that it covers, under every integrator") {
  const BallFolder folder;
  for (const char* integrator : {"raycast", "whitted", "path", "sppm"}) {
    CAPTURE(integrator);
    render({folder.scene(), "--transparent", "--integrator", integrator, "-D", "image.pattern=regular", "-o",
            folder / "ball.exr"});
    const Image alpha = alpha_of(folder / "ball.exr");
    double sum = 0, expected = 0;
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x) {
        const double there = double(*alpha.pixel(x, y)), truth = coverage_of_ball(x, y);
        CHECK(std::abs(there - truth) < 0.06);
        if (truth == 0 || truth == 1) CHECK(there == truth);
        sum += there;
        expected += truth;
      }
    CHECK(sum == doctest::Approx(expected).epsilon(0.003));
  }
}

TEST_CASE("colours are multiplied by alpha in an .exr, and not in a .png") {
  const BallFolder folder;
  render({folder.scene(), "--transparent", "-o", folder / "ball.exr", "-o", folder / "ball.png"});
  const Image exr = read_image(folder / "ball.exr"), png = read_image(folder / "ball.png");
  const Image alpha = alpha_of(folder / "ball.exr"), codes = alpha_of(folder / "ball.png");
  int edges = 0;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) {
      const float a = *alpha.pixel(x, y);
      CHECK(*codes.pixel(x, y) == doctest::Approx(double(a)).epsilon(0.5 / 255));
      edges += a > 0 && a < 1;
      for (int c = 0; c < 3; ++c) {
        CHECK(exr.pixel(x, y)[c] == doctest::Approx(double(a * shine[c])).epsilon(1e-6));
        CHECK(srgb8(png.pixel(x, y)[c]) == (a > 0 ? srgb8(shine[c]) : 0));
      }
    }
  CHECK(edges > 20);
}

TEST_CASE("over the scene's own background, the transparent picture is the opaque one") {
  const SceneFolder folder;
  struct Case {
    std::string scene;
    Words more;
    float background[3];
  };
  const Case cases[] = {{folder.scene(), {"--spp", "4"}, {0.25f, 0.5f, 0.75f}},
                        {folder.scene(), {"--integrator", "path", "--spp", "16"}, {0.25f, 0.5f, 0.75f}},
                        {"scenes/blend.toml", {"-s", "90x60"}, {0.05f, 0.06f, 0.12f}}};
  for (const Case& each : cases) {
    CAPTURE(each.scene);
    render(Words{each.scene, "-o", folder / "opaque.exr"} + each.more);
    render(Words{each.scene, "--transparent", "-o", folder / "alpha.exr"} + each.more);
    const Image opaque = read_image(folder / "opaque.exr"), picture = read_image(folder / "alpha.exr");
    const Image alpha = alpha_of(folder / "alpha.exr");
    REQUIRE(picture.sample_count() == opaque.sample_count());
    size_t open = 0;
    for (size_t i = 0; i < opaque.sample_count(); ++i) {
      const float a = alpha.samples()[i / 3];
      open += a < 1;
      const double over = double(picture.samples()[i] + (1 - a) * each.background[i % 3]);
      CHECK(over == doctest::Approx(double(opaque.samples()[i])).epsilon(1e-5));
    }
    CHECK(open > 100);
  }
}

TEST_CASE("shards and a resumed render make the same transparent bits") {
  const SceneFolder folder;
  const Words whole{"render", "scenes/transparent.toml", "--spp", "4", "--quiet"};
  const Words picture = whole + Words{"-s", "70x45"};
  const Words outputs{"-o", folder / "whole.exr", "-o", folder / "whole.png"};
  REQUIRE(run_eyeray(picture + outputs).code == 0);
  for (int i = 1; i <= 3; ++i) render_part(folder, picture, i, 3);
  const ProcessResult merged = run_eyeray(Words{"merge"} + all_parts(folder, 3) +
                                          Words{"-o", folder / "merged.exr", "-o", folder / "merged.png"});
  CAPTURE(merged.err);
  REQUIRE(merged.code == 0);
  CHECK(read_text(folder / "whole.exr") == read_text(folder / "merged.exr"));
  CHECK(read_text(folder / "whole.png") == read_text(folder / "merged.png"));
  CHECK(run_eyeray(Words{"merge"} + all_parts(folder, 3) + Words{"-o", folder / "merged.hdr"}).code == 2);

  // In bands, whose finished rows a checkpoint keeps.
  const Words bands = whole + Words{"-s", "600x400", "--band-memory", "1"};
  REQUIRE(run_eyeray(bands + Words{"-o", folder / "bands.exr"}).code == 0);
  const Words resumed = bands + Words{"-o", folder / "resumed.exr"};
  const std::string checkpoint = folder / "work";
  ProcessResult result;
  int runs = 0;
  do {
    const bool first = !std::filesystem::exists(checkpoint);
    result = run_eyeray(resumed + Words{first ? "--checkpoint" : "--resume", checkpoint}, {}, 120,
                        runs < 8 ? 300 + 100 * runs : -1);
    CAPTURE(result.err);
    REQUIRE((result.code == 0 || result.code == 130));
    ++runs;
  } while (result.code == 130);
  CHECK(runs > 1);
  CHECK(read_text(folder / "bands.exr") == read_text(folder / "resumed.exr"));
}

TEST_CASE("a denoised picture keeps its outlines") {
  const SceneFolder folder;
  const Words picture{"scenes/transparent.toml", "-s", "120x66"};
  render(picture + Words{"--spp", "512", "-o", folder / "truth.exr"});
  render(picture + Words{"--spp", "16", "-o", folder / "noisy.exr"});
  render(picture + Words{"--spp", "16", "--denoise", "-o", folder / "denoised.exr"});
  const Image truth = alpha_of(folder / "truth.exr"), noisy = alpha_of(folder / "noisy.exr"),
              denoised = alpha_of(folder / "denoised.exr"), colors = read_image(folder / "denoised.exr");
  double before = 0, after = 0;
  for (size_t i = 0; i < truth.sample_count(); ++i) {
    const float a = denoised.samples()[i];
    before += std::pow(double(noisy.samples()[i] - truth.samples()[i]), 2);
    after += std::pow(double(a - truth.samples()[i]), 2);
    if (a == 0)
      for (int c = 0; c < 3; ++c) CHECK(colors.samples()[3 * i + size_t(c)] < 0.02f);
  }
  CHECK(after < before);
  const std::string text = read_text(folder / "denoised.exr");
  for (const char* channel : {"coverage.V", "half_coverage.V", "noisy.R"})
    CHECK(text.find(channel) != std::string::npos);
}

TEST_CASE("a mesh alone stands on no floor, and its exposure is measured where it is") {
  const SceneFolder folder;
  const Words mesh{"scenes/meshes/sprig.obj", "-s", "64x64", "--spp", "4"};
  for (const char* look : {"studio", "sky", "clay", "plain"}) {
    CAPTURE(look);
    render(mesh + Words{"--look", look, "--transparent", "-o", folder / "mesh.png"});
    const Image alpha = alpha_of(folder / "mesh.png");
    double sum = 0;
    for (const float each : alpha.samples()) sum += double(each);
    CHECK(sum > 40);
    CHECK(sum < 64 * 64 / 2);
    for (int x = 0; x < 64; ++x) CHECK(*alpha.pixel(x, 63) == 0);
  }
}

TEST_CASE("what has no alpha is refused in one sentence") {
  const BallFolder folder;
  const auto says = [](const std::string& text, const std::string& sentence) {
    return text.find(sentence) != std::string::npos;
  };
  CHECK(says(
      refusal({folder.scene(), "--transparent", "-o", folder / "ball.pfm"}),
      "ball.pfm: only .png and .exr files have an alpha: write the transparent picture to one of these\n"));
  CHECK(says(refusal({folder.scene(), "-D", "image.transparent=true", "-o", folder / "a.png", "-o",
                      folder / "ball.hdr"}),
             "ball.hdr: only .png and .exr files have an alpha"));
  CHECK(folder.names().size() == 1);
  CHECK(says(refusal({folder.scene(), "--aov", "coverage", "-o", folder / "ball.png"}),
             "error: only transparent pictures have the AOV coverage: set transparent = true in [image]\n"));
}
