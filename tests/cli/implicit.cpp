// Formulas that users write, end to end: their faults, functions without an end, scenes that
// nobody trusts.
#include <fstream>
#include <nlohmann/json.hpp>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// The small scene with a ball of a formula instead of its sphere.
class FormulaFolder : public SceneFolder {
 public:
  explicit FormulaFolder(const std::string& text, const std::string& more = "lipschitz = 1") {
    write_text(*this / "f.glsl", text);
    replace_in_file(scene(), "[[sphere]]\ncenter = [0, 1, 0]\nradius = 1",
                    "[[implicit]]\nfile = \"f.glsl\"\nmin = [-1, 0, -1]\nmax = [1, 2, 1]\n" + more);
  }
};

const std::string ball = "float f(vec3 p) { return distance(p, vec3(0.0, 1.0, 0.0)) - 0.9; }\n";
// A formula whose loop never ends on the plane x = 0. A picture of odd width has rays in that plane, but no
// sample of the formula is taken on it.
const std::string endless_at_0 =
    "float f(vec3 p) {\n  while (p.x == 0.0) p.y += 1.0;\n  return distance(p, vec3(0.0, 1.0, 0.0)) - "
    "0.9;\n}\n";

}  // namespace

TEST_CASE("every backend reports GLSL that does not compile at its line of the user's file") {
  const FormulaFolder folder("float f(vec3 p) {\n  float r = missing * 2.0;\n  return length(p) - r;\n}\n");
  for (const std::string backend : {"gpu", "twin", "reference"}) {
    const ProcessResult result =
        run_eyeray({"render", folder.scene(), "--backend", backend, "-o", folder / "a.png", "--quiet"});
    CAPTURE(result.err);
    CHECK(result.code == 2);
    CHECK(result.err.find(folder / "f.glsl" + ":2:13: error: 'missing': undeclared identifier") !=
          std::string::npos);
  }
  CHECK(folder.names() == std::set<std::string>{"f.glsl", "scene.toml"});
}

TEST_CASE("formulas need no other program, on any backend") {
  const FormulaFolder folder(ball);
  CHECK(run_eyeray({"verify", folder.scene(), "--quiet", "-s", "32x24"},
                   {{"PATH", "/nonexistent"}, {"CXX", ""}})
            .code == 0);
}

TEST_CASE("--no-formulas refuses every function that a scene brings, and accepts ready formulas") {
  const FormulaFolder folder(ball);
  for (const std::string command : {"check", "render", "verify"}) {
    std::vector<std::string> words{command, folder.scene(), "--no-formulas"};
    if (command == "render") words.insert(words.end(), {"-o", folder / "a.png"});
    const ProcessResult result = run_eyeray(words);
    CAPTURE(result.err);
    CHECK(result.code == 2);
    CHECK(result.err.find("error: `file` has a function, which --no-formulas refuses") != std::string::npos);
  }
  // The refusal is the only error: no function is read, wherever it stands.
  write_text(
      folder / "all.toml",
      "[camera]\ntype = \"formula\"\ncode = \"nonsense\"\n[[implicit]]\nfile = \"none.glsl\"\n"
      "[[material]]\nname = \"m\"\ntype = \"phong\"\ndiffuse = { formula = { code = \"nonsense\" } }\n");
  const ProcessResult all = run_eyeray({"check", folder / "all.toml", "--no-formulas"});
  CAPTURE(all.err);
  CHECK(all.code == 2);
  CHECK(all.err.ends_with("\n3 errors\n"));
  CHECK(all.err.find("nonsense'") == std::string::npos);
  CHECK(run_eyeray({"check", folder.scene(), "-D", "camera.file=\"f.glsl\"", "--no-formulas"})
            .err.find("-D camera.file=") != std::string::npos);
  replace_in_file(folder.scene(), "file = \"f.glsl\"", "ready = \"gyroid\"");
  CHECK(run_eyeray({"check", folder.scene(), "--no-formulas"}).code == 0);
}

TEST_CASE("a function that does not end times out in every backend") {
  const FormulaFolder anywhere("float f(vec3 p) {\n  while (p.x < 1e9) p.y += 1.0;\n  return p.y;\n}\n");
  CHECK(run_eyeray({"check", anywhere.scene()}).code == 5);
  const FormulaFolder folder(endless_at_0);
  CHECK(run_eyeray({"check", folder.scene()}).code == 0);
  for (const std::string backend : {"gpu", "twin", "reference"}) {
    const ProcessResult result = run_eyeray(
        {"render", folder.scene(), "--backend", backend, "-o", folder / "a.png", "--quiet", "-s", "33x25"});
    CAPTURE(result.err);
    CHECK(result.code == 5);
    CHECK(result.err.find("did not end") != std::string::npos);
  }
  CHECK(folder.names() == std::set<std::string>{"f.glsl", "scene.toml"});
}

TEST_CASE("errors of a color's function are reported like a surface's: compilation, endless loops, trust") {
  const SceneFolder folder;
  replace_in_file(folder.scene(), "diffuse = [0.8, 0.4, 0.2]",
                  "diffuse = { formula = { file = \"c.glsl\" } }");
  const auto render = [&](const std::string& backend, const std::string& text) {
    write_text(folder / "c.glsl", text);
    return run_eyeray({"render", folder.scene(), "--backend", backend, "-o", folder / "a.png", "--quiet"});
  };
  for (const std::string backend : {"gpu", "twin", "reference"}) {
    const ProcessResult wrong = render(backend, "vec3 color(vec2 uv) {\n  return uv.xyx * missing;\n}\n");
    CAPTURE(wrong.err);
    CHECK(wrong.code == 2);
    CHECK(wrong.err.find(folder / "c.glsl" + ":2:19: error: 'missing': undeclared identifier") !=
          std::string::npos);
    const ProcessResult endless = render(
        backend, "vec3 color(vec2 uv) {\n  while (uv.x > 0.1) uv.y += 1.0;\n  return vec3(uv.y);\n}\n");
    CAPTURE(endless.err);
    CHECK(endless.code == 5);
    CHECK(endless.err.find("did not end") != std::string::npos);
    CHECK(render(backend, "vec3 color(vec2 uv) { return vec3(sqrt(-uv.x), 1.0 / 0.0, -1.0); }\n").code == 0);
  }
  const ProcessResult refused = run_eyeray({"check", folder.scene(), "--no-formulas"});
  CHECK(refused.code == 2);
  CHECK(refused.err.find("error: `file` has a function, which --no-formulas refuses") != std::string::npos);
}

TEST_CASE("all functions of a scene together must fit into a kernel") {
  const SceneFolder folder;
  std::string text = "float g0(float x) { return x * x + shift; }\n";
  for (int i = 1; i <= 10; ++i)
    text += fmt::format("float g{0}(float x) {{ return g{1}(x) + g{1}(x + {0}.0); }}\n", i, i - 1);
  write_text(folder / "c.glsl", text + "vec3 color(vec2 uv) { return vec3(g10(uv.x)); }\n");
  std::ofstream scene(folder.scene(), std::ios::app);
  for (int i = 0; i < 4; ++i)
    scene << fmt::format(
        "[[material]]\nname = \"m{0}\"\ntype = \"phong\"\ndiffuse = {{ formula = {{ file = \"c.glsl\", "
        "parameters = {{ shift = {0} }} }} }}\n[[sphere]]\ncenter = [{0}, 3, 0]\nradius = 0.4\nmaterial = "
        "\"m{0}\"\n",
        i);
  scene.close();
  const ProcessResult result = run_eyeray({"check", folder.scene()});
  CAPTURE(result.err);
  CHECK(result.code == 2);
  CHECK(result.err.find(folder / "c.glsl" +
                        ":1:1: error: all functions up to the function of { formula = … } at ") !=
        std::string::npos);
  CHECK(result.err.find("instructions; at most 32768") != std::string::npos);
}

TEST_CASE("a function that returns NaN has no surface, and puts no NaN into the picture") {
  const FormulaFolder folder("float f(vec3 p) { return sqrt(-1.0 - p.x * p.x); }\n");
  for (const std::string backend : {"gpu", "twin", "reference"}) {
    const ProcessResult result = run_eyeray(
        {"render", folder.scene(), "--backend", backend, "-o", folder / (backend + ".pfm"), "--quiet"});
    CAPTURE(result.err);
    CHECK(result.code == 0);
  }
  CHECK(run_eyeray({"compare", folder / "gpu.pfm", folder / "twin.pfm", "--tolerance", "0"}).code == 0);
  CHECK(run_eyeray({"compare", folder / "gpu.pfm", folder / "reference.pfm"}).code == 0);
}

TEST_CASE("a CSG part with more crossings than are counted reaches the limit, and an AOV shows its pixels") {
  // Thousands of sheets in front of the ball that they are cut to, with a Lipschitz constant and without.
  for (const std::string lipschitz : {"lipschitz = 6000", ""}) {
    CAPTURE(lipschitz);
    const FormulaFolder folder("float f(vec3 p) { return sin(6000.0 * p.z); }\n", lipschitz);
    replace_in_file(folder.scene(), "[[implicit]]",
                    "[[csg]]\noperation = \"intersection\"\nmaterial = \"matte\"\n[[csg.sphere]]\ncenter "
                    "= [0, 1, -0.5]\n"
                    "radius = 0.4\n[[csg.implicit]]");
    for (const std::string backend : {"gpu", "twin", "reference"}) {
      const ProcessResult result = run_eyeray(
          {"render", folder.scene(), "--backend", backend, "-o", folder / "a.pfm", "--quiet", "-s", "16x12"});
      CAPTURE(result.err);
      CHECK(result.code == 0);
      CHECK(result.err.find("ran out of steps") != std::string::npos);
    }
  }
}

TEST_CASE("samples that disprove a Lipschitz constant give a warning with the position") {
  const FormulaFolder folder("float f(vec3 p) { return 3.0 * (distance(p, vec3(0.0, 1.0, 0.0)) - 0.9); }\n");
  const ProcessResult result = run_eyeray({"check", folder.scene()});
  CHECK(result.code == 0);
  CHECK(result.err.find("warning: `lipschitz` is 1, but the function's slope is 3 at [") !=
        std::string::npos);
  CHECK(run_eyeray({"check", folder.scene()}).err == result.err);

  // The warning holds for a ready formula too, if `lipschitz` is not the formula's own.
  std::ofstream(folder.scene(), std::ios::app) << "[[implicit]]\nready = \"gyroid\"\nmin = [3, 0, 0]\nmax = "
                                                  "[4, 1, 1]\nlipschitz = 0.5\nmaterial = \"matte\"\n";
  CHECK(run_eyeray({"check", folder.scene()})
            .err.find("warning: `lipschitz` is 0.5, but the function's slope is 1.") != std::string::npos);
}

TEST_CASE("a formula in an instanced group or a CSG object is checked and run as any other" *
          doctest::test_suite("long")) {
  const std::string group =
      "[[group]]\nbatch = { transform = [[], [{ translate = [3, 0, 0] }]] }\n[[group.implicit]]";
  const std::string csg =
      "[[csg]]\nmaterial = \"matte\"\n[[csg.sphere]]\ncenter = [0, 1, 0]\nradius = "
      "1\n[[csg.minus.csg]]\n"
      "[[csg.minus.csg.implicit]]";
  for (const std::string& holder : {group, csg}) {
    CAPTURE(holder);
    const auto put = [&](const FormulaFolder& folder) {
      replace_in_file(folder.scene(), "[[implicit]]", holder);
    };
    const FormulaFolder wrong("float f(vec3 p) {\n  return length(p) - missing;\n}\n");
    put(wrong);
    const FormulaFolder endless(endless_at_0);
    put(endless);
    for (const std::string backend : {"gpu", "twin", "reference"}) {
      const auto render = [&](const FormulaFolder& folder) {
        return run_eyeray({"render", folder.scene(), "--backend", backend, "-o", folder / "a.png", "--quiet",
                           "-D", "render.groups=instanced", "-s", "33x25"});
      };
      const ProcessResult refused = render(wrong);
      CAPTURE(refused.err);
      CHECK(refused.code == 2);
      CHECK(refused.err.find(wrong / "f.glsl" + ":2:22: error: 'missing': undeclared identifier") !=
            std::string::npos);
      CHECK(render(endless).code == 5);
    }
    const FormulaFolder steep("float f(vec3 p) { return 3.0 * (distance(p, vec3(0.0, 1.0, 0.0)) - 0.9); }\n");
    put(steep);
    const ProcessResult result = run_eyeray({"check", steep.scene(), "-D", "render.groups=instanced"});
    CHECK(result.code == 0);
    CHECK(result.err.find("3 at [") != std::string::npos);
  }
}
