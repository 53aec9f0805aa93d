// What the program answers to its command line alone.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::test;

namespace {

struct Mistake {
  std::vector<std::string> arguments;
  std::string message;  // all of standard error
};

}  // namespace

TEST_CASE("docs/command-line.md says what each AOV holds") {
  const std::string document = read_text("docs/command-line.md");
  const std::string help = run_eyeray({"render", "--help"}).out;
  const std::string refusal = run_eyeray({"render", "none.toml", "--aov", "none"}).err;
  static const std::regex name(R"((\w+)(?=,| and all))");
  int names = 0;
  const std::string list = refusal.substr(refusal.find("There are "));
  for (std::sregex_iterator it(list.begin(), list.end(), name), end; it != end; ++it, ++names) {
    CAPTURE(it->str());
    CHECK(document.find(fmt::format("\n| `{}` | ", it->str())) != std::string::npos);
    CHECK(help.find(it->str()) != std::string::npos);
  }
  CHECK(names >= 8);
}

TEST_CASE("a wrong command line is one line that says what was meant, and code 2") {
  const SceneFolder folder;
  const std::string scene = folder.scene();
  const Mistake mistakes[] = {
      {{"rendr", scene}, "unknown command 'rendr'; did you mean 'render'? (see eyeray --help)"},
      {{"--foo"}, "unknown option '--foo' (see eyeray --help)"},
      {{"--max-depth=4", "check", scene},
       "'--max-depth' belongs after the command: eyeray check ... --max-depth (see eyeray check --help)"},
      {{"render"}, "SCENE is required (see eyeray render --help)"},
      {{"render", scene, "--sp=4"},
       "unknown option '--sp'; did you mean '--spp'? (see eyeray render --help)"},
      {{"render", scene, "second.toml"}, "unexpected argument 'second.toml' (see eyeray render --help)"},
      {{"render", scene, "-s", "640"}, "--size wants WIDTHxHEIGHT, as 640x480, not '640'"},
      {{"render", scene, "-s", "4x4x4"}, "--size wants WIDTHxHEIGHT, as 640x480, not '4x4x4'"},
      {{"render", scene, "-s", "99999999999x1"},
       "--size wants WIDTHxHEIGHT, as 640x480, not '99999999999x1'"},
      {{"render", scene, "--crop", "1,2,3"}, "--crop wants X,Y,W,H in pixels, as 0,0,64,64, not '1,2,3'"},
      {{"render", scene, "--crop", "60,40,5,5"}, "--crop 60,40,5,5 leaves the picture, which is 64x48"},
      {{"render", scene, "--crop", "0,0,0,0"},
       "--crop 0,0,0,0 has no pixels: width and height are at least 1"},
      {{"verify", scene, "--crop", "0,0,0,5"},
       "--crop 0,0,0,5 has no pixels: width and height are at least 1"},
      {{"render", scene, "--crop", "1,1,2147483647,2147483647"},
       "--crop 1,1,2147483647,2147483647 leaves the picture, which is 64x48"},
      {{"render", scene, "--backend", "cpu"}, "no backend 'cpu': there are gpu, twin and reference"},
      {{"render", scene, "--timeout", "nan"},
       "--timeout: wants seconds from 0.001 to 1000000, not 'nan' (see eyeray render --help)"},
      {{"render", scene, "--aov", "dept"},
       "no AOV 'dept'; did you mean 'depth'? There are depth, position, normal, normal_geometric, front, "
       "uv, shape, primitive, material, hits, bounces, rays, ray_kinds, samples, noise, brightest, albedo, "
       "shading_normal, nodes, tests, flags "
       "and all"},
      {{"render", scene, "-o", folder / "x.gif"},
       folder / "x.gif" + ": a picture's name must end in .png, .pfm, .hdr or .exr"},
      {{"shaders", "--print", "sphere.glsl"}, "no shader 'sphere.glsl' (see eyeray shaders --list)"},
      {{"check"}, "no scene given (see eyeray check --help)"},
  };
  for (const Mistake& mistake : mistakes) {
    const ProcessResult result = run_eyeray(mistake.arguments);
    CHECK(result.code == 2);
    CHECK(result.out == "");
    CHECK(result.err == "eyeray: error: " + mistake.message + "\n");
  }
  CHECK(folder.names() == std::set<std::string>{"scene.toml"});
}

TEST_CASE("without a command the help is shown, as words") {
  const ProcessResult result = run_eyeray({});
  CHECK(result.code == 2);
  CHECK(result.out == "");
  CHECK(result.err.find("Usage: eyeray") != std::string::npos);
}

TEST_CASE("every command explains itself with an example, in lines that fit") {
  for (const std::string command :
       {"render", "verify", "compare", "probe", "check", "dev", "devices", "bench", "generate", "shaders"}) {
    CAPTURE(command);
    const ProcessResult result = run_eyeray({command, "--help"});
    CHECK(result.code == 0);
    CHECK(result.err == "");
    CHECK(result.out.find("Usage: eyeray " + command) != std::string::npos);
    CHECK(result.out.find("eyeray " + command + " ", result.out.find("--json")) != std::string::npos);
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) {
      CAPTURE(line);
      CHECK(line.size() <= 125);
    }
  }
}

TEST_CASE("the version is printed") {
  const ProcessResult result = run_eyeray({"--version"});
  CHECK(result.code == 0);
  CHECK(result.out.starts_with("eyeray 0."));
}

TEST_CASE("under --json a failure is JSON on standard output too") {
  const SceneFolder folder;
  replace_in_file(folder.scene(), "radius = 1", "radius = -1\nradios = 2");
  const ProcessResult result = run_eyeray({"check", folder.scene(), "--json"});
  CHECK(result.code == 2);
  const auto error = nlohmann::json::parse(result.out).at("error");
  CHECK(error.at("code") == 2);
  REQUIRE(error.at("diagnostics").size() == 2);
  CHECK(error.at("diagnostics")[0].at("file") == folder.scene());
  CHECK(error.at("diagnostics")[0].at("line") == 26);
  CHECK(result.err.ends_with("2 errors\n"));
}

TEST_CASE("a reader that goes away is no error, a full disk is") {
  const std::string binary = eyeray_binary();
  const ProcessResult pipe =
      run_process({"sh", "-c", "(" + binary + " shaders --print math/math.glsl; echo $? >&2) | true"});
  CHECK(pipe.err == "0\n");
  const ProcessResult full = run_process({"sh", "-c", binary + " shaders --list > /dev/full"});
  CHECK(full.code == 4);
  CHECK(full.err == "eyeray: error: cannot write to standard output: No space left on device\n");
}
