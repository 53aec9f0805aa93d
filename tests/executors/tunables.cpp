// Constants of shaders that move.
#include "host/executors/tunables.hpp"

#include "host/executors/executor.hpp"
#include "host/loader/scene_file.hpp"
#include "tests/support/shader_overlay.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;

TEST_CASE("a constant with a control is read from the buffer, in its own line") {
  Tunables tunables;
  const std::string text =
      "a\nconst float WIDTH = 0.5f;  // @slider 0 2\n  const int COUNT = 3; // @slider 1 16\n"
      "const vec3 TINT = vec3(1, 0.5f, 0.25f);  // @color\nconst bool ON = true;  // @checkbox\nz\n";
  CHECK(tunables.apply("shapes/sphere.glsl", text) ==
        "a\n#define WIDTH tunables[0].x\n#define COUNT int(tunables[1].x)\n#define TINT tunables[2].xyz\n"
        "#define ON (tunables[3].x != 0.0f)\nz\n");
  REQUIRE(tunables.found().size() == 4);
  const Tunable& width = tunables.found()[0];
  CHECK(width.id == "shapes/sphere.glsl:WIDTH");
  CHECK(width.line == 2);
  CHECK(width.low == 0);
  CHECK(width.high == 2);
  CHECK(tunables.value(width)[0] == 0.5);
  CHECK(tunables.records()[2] == std::array<float, 4>{1, 0.5f, 0.25f, 0});
  CHECK(tunables.records()[3][0] == 1);

  // Another value. The positions stay the same if the texts are read anew, in another order too.
  CHECK(tunables.choose({{"shapes/sphere.glsl:WIDTH", {1.5}}}));
  CHECK(tunables.choice() == 1);
  CHECK_FALSE(tunables.choose({{"shapes/sphere.glsl:WIDTH", {1.5}}}));
  CHECK(tunables.choice() == 1);
  tunables.begin();
  CHECK(tunables.found().empty());
  CHECK(tunables.apply("a.glsl", "const float NEW = 1; // @slider 0 1\n") == "#define NEW tunables[4].x\n");
  tunables.apply("shapes/sphere.glsl", text);
  CHECK(tunables.records()[0][0] == 1.5f);
}

TEST_CASE("constants have the chosen values") {
  Tunables tunables;
  tunables.as_constants = true;
  tunables.choose({{"a:N", {7}}, {"a:C", {0, 1, 0.5}}});
  CHECK(tunables.apply("a",
                       "const int N = 3;  // @slider 1 9\nconst vec3 C = vec3(1);  // @color\n"
                       "const bool B = false;  // @checkbox\nconst float F = 2.5;  // @slider 0 9\n") ==
        "const int N = 7;  // @slider 1 9\nconst vec3 C = vec3(0, 1, 0.5);  // @color\n"
        "const bool B = false;  // @checkbox\nconst float F = float(2.5);  // @slider 0 9\n");
}

TEST_CASE("other constants stay as they are") {
  Tunables tunables;
  for (const char* line :
       {"const float X = 2.0f * Y;  // @slider 0 1\n", "float X = 2.0f;  // @slider 0 1\n",
        "const float X = 2.0f;  // slider 0 1\n", "const float X = 2.0f;  // @slider 3 1\n",
        "const float X = 2.0f;  // @color\n", "const vec3 X = vec3(1, 2);  // @color\n",
        "const uint X = 2u;  // @slider 0 1\n", "const bool X = 1;  // @checkbox\n"}) {
    CAPTURE(line);
    CHECK(tunables.apply("a.glsl", line) == line);
  }
  CHECK(tunables.found().empty());
}

TEST_CASE("a line of a shader may have any length") {
  const std::string text = "const float X = 1.0; // " + std::string(1'000'000, '0') + "\n";
  Tunables tunables;
  CHECK(tunables.apply("a.glsl", text + "const float Y = 1.0; // @slider 0 2\n") ==
        text + "#define Y tunables[0].x\n");
}

TEST_CASE("an executor's next sample and photons use the values chosen now") {
  const Scene scene = loader::load_scene(
      "scenes/sppm/points.toml",
      std::vector<loader::Override>{{"image.width=24"}, {"image.height=18"}, {"render.photons=4096"}});
  const test::TemporaryFolder folder;
  const std::string file = "integrators/photon.glsl",
                    declared = "const float BRIGHTER = 1.0f;  // @slider 0 2\n";
  test::lay_shader(folder.path(), file,
                   declared + test::replaced(test::own_shader(file), "photon.flux = sent",
                                             "photon.flux = BRIGHTER * sent"));
  ExecutorOptions options;
  options.shader_folder = folder.path();
  options.gpu.tunables = std::make_shared<Tunables>();
  const auto executor = make_executor(Backend::gpu, scene, options);
  const auto light = [&] {
    const Rect all{0, 0, 24, 18};
    std::vector<PixelSample> samples(size_t(all.pixels()));
    REQUIRE(executor->sample(all, 0, samples));
    Vec3 sum(0);
    for (const PixelSample& sample : samples) sum += sample.color;
    return sum;
  };
  const auto light_by = [&](double share) {
    options.gpu.tunables->choose({{file + ":BRIGHTER", {share}}});
    return light();
  };
  const Vec3 written = light();
  const Vec3 none = light_by(0), twice = light_by(2);
  CHECK(none.x < written.x);
  CHECK(written.x < twice.x);
  CHECK(light_by(1) == written);
}
