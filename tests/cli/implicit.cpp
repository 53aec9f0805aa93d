// Formulas that users write, end to end: what is wrong with them, machines without a C++ compiler, functions
// without an end.
#include <fstream>
#include <nlohmann/json.hpp>

#include "scene.hpp"
//
#include "support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::test;

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
const Environment no_compiler{{"PATH", "/nonexistent"}, {"CXX", ""}};

}  // namespace

TEST_CASE("GLSL that does not compile is told at its place in the user's file, by every backend") {
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

TEST_CASE("without a C++ compiler the GPU renders, the CPU says why it cannot, and nothing is verified") {
  const FormulaFolder folder(ball);
  CHECK(run_eyeray({"render", folder.scene(), "-o", folder / "a.png", "--quiet"}, no_compiler).code == 0);
  for (const std::string backend : {"twin", "reference"}) {
    const ProcessResult result = run_eyeray(
        {"render", folder.scene(), "--backend", backend, "-o", folder / "b.png", "--quiet"}, no_compiler);
    CAPTURE(result.err);
    CHECK(result.code == 6);
    CHECK(result.err.find("there is no C++ compiler: neither $CXX nor c++, g++ or clang++ in $PATH") !=
          std::string::npos);
  }
  const ProcessResult verify = run_eyeray({"verify", folder.scene(), "--quiet"}, no_compiler);
  CHECK(verify.code == 6);
  CHECK(verify.out.starts_with("NOT VERIFIED " + folder.scene() + "\n"));
  CHECK(verify.out.find("PASSED") == std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"a.png", "f.glsl", "scene.toml"});
}

TEST_CASE("a function that does not end is a time-out, whoever runs it") {
  const FormulaFolder folder("float f(vec3 p) {\n  while (p.x < 1e9) p.y += 1.0;\n  return p.y;\n}\n");
  for (const std::string backend : {"gpu", "twin", "reference"}) {
    // Without a compiler nothing is sampled before the GPU gets to it.
    const ProcessResult result =
        run_eyeray({"render", folder.scene(), "--backend", backend, "-o", folder / "a.png", "--quiet"},
                   backend == "gpu" ? no_compiler : Environment{});
    CAPTURE(result.err);
    CHECK(result.code == 5);
    CHECK(result.err.find("did not come to an end") != std::string::npos);
  }
  CHECK(folder.names() == std::set<std::string>{"f.glsl", "scene.toml"});
}

TEST_CASE("a function that is not a number is no surface, and no NaN in the picture") {
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

TEST_CASE(
    "a part of a solid that is crossed more often than is counted runs out, and the picture says where") {
  // Thousands of sheets in front of the ball that they are cut to, with a Lipschitz constant and without.
  for (const std::string lipschitz : {"lipschitz = 6000", ""}) {
    CAPTURE(lipschitz);
    const FormulaFolder folder("float f(vec3 p) { return sin(6000.0 * p.z); }\n", lipschitz);
    replace_in_file(folder.scene(), "[[implicit]]",
                    "[[solid]]\noperation = \"intersection\"\nmaterial = \"matte\"\n[[solid.sphere]]\ncenter "
                    "= [0, 1, -0.5]\n"
                    "radius = 0.4\n[[solid.implicit]]");
    for (const std::string backend : {"gpu", "twin", "reference"}) {
      const ProcessResult result = run_eyeray(
          {"render", folder.scene(), "--backend", backend, "-o", folder / "a.pfm", "--quiet", "-s", "16x12"});
      CAPTURE(result.err);
      CHECK(result.code == 0);
      CHECK(result.err.find("was not found in the steps allowed") != std::string::npos);
    }
  }
}

TEST_CASE("samples that disprove a Lipschitz constant are a warning with the place") {
  const FormulaFolder folder("float f(vec3 p) { return 3.0 * (distance(p, vec3(0.0, 1.0, 0.0)) - 0.9); }\n");
  const ProcessResult result = run_eyeray({"check", folder.scene()});
  CHECK(result.code == 0);
  CHECK(result.err.find("warning: `lipschitz` is 1, but the function is as steep as 3 at [") !=
        std::string::npos);
  CHECK(run_eyeray({"check", folder.scene()}).err == result.err);
  CHECK(run_eyeray({"check", folder.scene()}, no_compiler).err == "");

  // Of a ready formula too, if it is not its own.
  std::ofstream(folder.scene(), std::ios::app) << "[[implicit]]\nready = \"gyroid\"\nmin = [3, 0, 0]\nmax = "
                                                  "[4, 1, 1]\nlipschitz = 0.5\nmaterial = \"matte\"\n";
  CHECK(run_eyeray({"check", folder.scene()})
            .err.find("warning: `lipschitz` is 0.5, but the function is as steep as 1.") !=
        std::string::npos);
}

TEST_CASE("a formula in a group that is kept once, and one in a solid, is checked and run as any other" *
          doctest::test_suite("long")) {
  const std::string group =
      "[[group]]\nbatch = { transform = [[], [{ translate = [3, 0, 0] }]] }\n[[group.implicit]]";
  const std::string solid =
      "[[solid]]\nmaterial = \"matte\"\n[[solid.sphere]]\ncenter = [0, 1, 0]\nradius = "
      "1\n[[solid.minus.solid]]\n"
      "[[solid.minus.solid.implicit]]";
  for (const std::string& holder : {group, solid}) {
    CAPTURE(holder);
    const auto put = [&](const FormulaFolder& folder) {
      replace_in_file(folder.scene(), "[[implicit]]", holder);
    };
    const FormulaFolder wrong("float f(vec3 p) {\n  return length(p) - missing;\n}\n");
    put(wrong);
    const FormulaFolder endless("float f(vec3 p) {\n  while (p.x < 1e9) p.y += 1.0;\n  return p.y;\n}\n");
    put(endless);
    for (const std::string backend : {"gpu", "twin", "reference"}) {
      const auto render = [&](const FormulaFolder& folder) {
        return run_eyeray({"render", folder.scene(), "--backend", backend, "-o", folder / "a.png", "--quiet",
                           "-D", "render.groups=instanced"},
                          backend == "gpu" ? no_compiler : Environment{});
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
    CHECK(result.err.find("as steep as 3 at [") != std::string::npos);
    CHECK(run_eyeray({"verify", steep.scene(), "--quiet"}, no_compiler).code == 6);
  }
}
