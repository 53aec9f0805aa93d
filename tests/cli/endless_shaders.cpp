// Loops of --shaders that never end: exit code 5, the loop's file and line, and no picture.
#include <fmt/format.h>

#include <algorithm>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// A folder with a scene, and a shader with `statements` in a sphere's intersection.
class Shaders : public SceneFolder {
 public:
  std::string sphere() const { return *this / "shaders/shapes/sphere.glsl"; }
  void insert(const std::string& statements) {
    const std::string before = "  return discriminant > 0.0f ? t : T_NONE;\n";
    lay_changed_shader(*this / "shaders", "shapes/sphere.glsl", before, statements + before);
    const std::string text = read_text(sphere());
    line_ = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(text.find(statements + before)), '\n');
  }
  // The shader and the line of the first statement: "…/sphere.glsl:41:".
  std::string location() const { return fmt::format("{}:{}:", sphere(), line_); }
  ProcessResult run(std::vector<std::string> words, const std::vector<std::string>& more = {}) const {
    words.insert(words.begin() + 1, scene());
    words.insert(words.end(), {"--shaders", *this / "shaders"});
    words.insert(words.end(), more.begin(), more.end());
    return run_eyeray(words);
  }

 private:
  std::ptrdiff_t line_ = 0;
};

}  // namespace

TEST_CASE("an error names an endless loop, whatever its form and however rays are traced") {
  Shaders shaders;
  for (const std::string loop :
       {// Optimisers see that this one never ends, and remove it with the code after it.
        "int i = 0; while (i < 10) t += 0.001f;", "while (true) {}", "for (;;) t += 0.001f;",
        // This one depends on the ray.
        "for (float w = 0.0f; w < 1.0f; w += 0.0f * ray.d.x) t += 0.001f;",
        "do { for (int i = 0; i < 3; i++) t += 0.001f; } while (t > -1e30f);"}) {
    CAPTURE(loop);
    shaders.insert("  " + loop + "\n");
    for (const std::string rays : {"lanes", "packets"}) {
      const ProcessResult result =
          shaders.run({"render"}, {"--tune", "rays=" + rays, "-o", shaders / "a.png"});
      CAPTURE(result.err);
      CHECK(result.code == 5);
      CHECK(result.err.starts_with("eyeray: error: a loop of your shaders did not end within "));
      CHECK(result.err.ends_with(fmt::format("\n{} {}\n", shaders.location(), loop)));
      CHECK_FALSE(shaders.names().contains("a.png"));
    }
  }
}

TEST_CASE("every command that renders reports the endless loop") {
  Shaders shaders;
  shaders.insert("  while (true) {}\n");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"verify"},
           {"verify", "--integrator", "path", "--backends", "gpu"},
           {"probe", "32,24"},
           {"dev", "--once", "--no-page"},
           {"render", "--stats", "-o", shaders / "a.png"},
           {"render", "--aov", "depth", "--integrator", "path", "-o", shaders / "a.png"}}) {
    CAPTURE(words[0]);
    const ProcessResult result = shaders.run(words);
    CAPTURE(result.err);
    CHECK(result.code == 5);
    CHECK(result.err.find("a loop of your shaders did not end within ") != std::string::npos);
    CHECK(result.err.find(shaders.location() + " while (true) {}\n") != std::string::npos);
  }
  CHECK_FALSE(shaders.names().contains("a.png"));
}

TEST_CASE("the twin of a user's shaders stops at an endless loop, too") {
  Shaders shaders;
  for (const std::string loop :
       {"while (true) {}", "for (float w = 0.0f; w < 1.0f; w += 0.0f * ray.d.x) t += 0.001f;"}) {
    CAPTURE(loop);
    shaders.insert("  " + loop + "\n");
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"render", "--backend", "twin", "-o", shaders / "a.png"},
                                               {"render", "--backend", "twin", "--integrator", "path",
                                                "--aov", "albedo", "-o", shaders / "a.exr"},
                                               {"verify", "--backends", "twin", "--compile-twin"},
                                               {"probe", "32,24", "--backends", "twin", "--compile-twin"},
                                               {"dev", "--once", "--no-page", "--backend", "twin"}}) {
      CAPTURE(words[0]);
      const ProcessResult result = shaders.run(words, {"--timeout", "30"});
      CAPTURE(result.err);
      CHECK(result.code == 5);
      CHECK(result.err.find("a loop of your shaders did not end within 1048576 iterations in one sample of a "
                            "pixel; it is this one, or one inside of it:\n" +
                            shaders.location() + " " + loop + "\n") != std::string::npos);
    }
  }
  CHECK_FALSE(shaders.names().contains("a.png"));
}

TEST_CASE("counting the iterations of a finite loop changes no bit, and mistakes are shown as written") {
  Shaders shaders;
  for (const std::string backend : {"gpu", "twin"}) {
    CAPTURE(backend);
    shaders.insert(
        "  float kept = t;\n  for (int i = 0; i < 9; i++) kept = kept * 0.5f;\n  t = kept * 512.0f;\n");
    REQUIRE(shaders.run({"render"}, {"--backend", backend, "-o", shaders / "a.pfm"}).code == 0);
    REQUIRE(run_eyeray({"render", shaders.scene(), "--backend", backend, "-o", shaders / "b.pfm"}).code == 0);
    CHECK(read_text(shaders / "a.pfm") == read_text(shaders / "b.pfm"));

    shaders.insert("  while (nonsense) {}\n");
    const ProcessResult mistake = shaders.run({"render"}, {"--backend", backend, "-o", shaders / "c.pfm"});
    CAPTURE(mistake.err);
    CHECK(mistake.code == 2);
    CHECK(mistake.err.find(shaders.location()) != std::string::npos);
    CHECK(mistake.err.find("  while (nonsense) {}\n") != std::string::npos);
  }
}
