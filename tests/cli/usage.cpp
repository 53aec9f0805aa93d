// Tests of the program's answers to its command line alone.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "scene.hpp"
#include "terminal.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

struct Mistake {
  std::vector<std::string> arguments;
  std::string message;  // all of standard error
};

// The result of a function of build_facts.cpp.
std::string fact_in(const std::string& text, const std::string& name) {
  const std::string before = name + "() {\n  return \"";
  const size_t begin = text.find(before) + before.size();
  return text.substr(begin, text.find('"', begin) - begin);
}

// The same fact of a program that is built from the sources in a folder.
std::string build_fact(const std::string& name, const std::string& source,
                       const std::string& compiler = "a compiler") {
  const TemporaryFolder folder;
  const ProcessResult result = run_process(
      {"cmake", "-D", "GIT=git", "-D", "SOURCE=" + source, "-D", "COMPILER=" + compiler, "-D", "INSTALLED=a",
       "-D", "TREE=b", "-D", "OUTPUT=" + folder / "facts.cpp", "-P", "cmake/write_build_facts.cmake"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  return fact_in(read_text(folder / "facts.cpp"), name);
}

}  // namespace

TEST_CASE("docs/command-line.md describes each AOV") {
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

TEST_CASE("a wrong command line gives one line with a suggestion, and code 2") {
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
      {{"render", scene, "-s", "640"}, "--size must be WIDTHxHEIGHT, such as 640x480, not '640'"},
      {{"render", scene, "-s", "4x4x4"}, "--size must be WIDTHxHEIGHT, such as 640x480, not '4x4x4'"},
      {{"render", scene, "-s", "99999999999x1"},
       "--size must be WIDTHxHEIGHT, such as 640x480, not '99999999999x1'"},
      {{"render", scene, "--crop", "1,2,3"},
       "--crop must be X,Y,W,H in pixels, such as 0,0,64,64, not '1,2,3'"},
      {{"render", scene, "--crop", "60,40,5,5"},
       "the crop 60,40,5,5 extends beyond the picture, which is 64x48"},
      {{"render", scene, "--crop", "0,0,0,0"},
       "--crop 0,0,0,0 has no pixels: width and height must be at least 1"},
      {{"verify", scene, "--crop", "0,0,0,5"},
       "--crop 0,0,0,5 has no pixels: width and height must be at least 1"},
      {{"render", scene, "--crop", "1,1,2147483647,2147483647"},
       "the crop 1,1,2147483647,2147483647 extends beyond the picture, which is 64x48"},
      {{"render", scene, "--backend", "cpu"},
       "no backend is named 'cpu': choose gpu, twin, reference or emulator"},
      {{"render", scene, "--timeout", "nan"},
       "--timeout must be a number from 0.001 to 1000000, not 'nan' (see eyeray render --help)"},
      {{"render", scene, "--aov", "dept"},
       "no AOV 'dept'; did you mean 'depth'? There are depth, position, normal, normal_geometric, front, "
       "uv, shape, primitive, material, hits, bounces, rays, ray_kinds, samples, noise, brightest, noisy, "
       "variance, half, albedo, shading_normal, half_albedo, half_normal, coverage, half_coverage, nodes, "
       "tests, flags "
       "and all"},
      {{"render", scene, "-o", folder / "x.gif"},
       folder / "x.gif" + ": a picture's name must end in .png, .pfm, .hdr or .exr"},
      {{"shaders", "--print", "sphere.glsl"}, "no shader 'sphere.glsl' (see eyeray shaders --list)"},
      {{"check"}, "no scene given (see eyeray check --help)"},
      {{"render", ""}, "SCENE must be the name of a file (see eyeray render --help)"},
      {{"render", scene, "-o"}, "--output needs a value (see eyeray render --help)"},
      {{"render", scene, "--samples", "4"},
       "unknown option '--samples'; did you mean '--spp'? (see eyeray render --help)"},
      {{"render", scene, "--resolution=4"},
       "unknown option '--resolution'; did you mean '--size'? (see eyeray render --help)"},
      {{"render", "-spp", "4", scene},
       "unknown option '-spp'; did you mean '--spp'? (see eyeray render --help)"},
      {{"render", "-seed", scene},
       "unknown option '-seed'; did you mean '--seed'? (see eyeray render --help)"},
      {{"render", scene, "-q=3"}, "-q takes no value: write -q (see eyeray render --help)"},
      {{"verify", scene, "-samples=4"},
       "unknown option '-samples'; did you mean '--spp'? (see eyeray verify --help)"},
      {{"render", scene, "--tune", "rays"}, "--tune must be KEY=VALUE, such as rays=lanes, not 'rays'"},
      {{"verify", scene, "--tune", "ray=lanes"},
       "--tune has no key 'ray'; did you mean 'rays'? There are acceleration, splits, profile, loads, rays, "
       "incoherent, stack, denoise, constants, optimiser, division, subgroup, device-division, "
       "device-contraction, device-denormals, device-nan"},
      {{"probe", scene, "1,1", "--tune", "rays=packets", "--tune", "constants=no"},
       "--tune constants must be one of on, off, not 'no'"},
      {{"render", scene, "--band-memory", "0"},
       "--band-memory must be a whole number from 1 to 1048576, not '0' (see eyeray render --help)"},
      {{"render", scene, "--half=x"}, "--half takes no value (see eyeray render --help)"},
      {{"render", scene, "--json=3"}, "--json takes no value (see eyeray render --help)"},
      {{"render", scene, "--no-formulas=true"}, "--no-formulas takes no value (see eyeray render --help)"},
      {{"render", scene, "--spp", "1", "--spp", "4"}, "--spp is given 2 times (see eyeray render --help)"},
      {{"render", scene, "--classic", "--spp", "4"},
       "--spp and --classic exclude each other (see eyeray render --help)"},
      {{"verify", scene, "--update=x"},
       "--update must be one of failing, force, not 'x' (see eyeray verify --help)"},
      {{"compare", "a.pfm", "b.pfm", "--max-different", "1.5"},
       "--max-different must be a whole number from 0 to 268435456, not '1.5' (see eyeray compare --help)"},
      {{"probe", scene, "1,1", "--sample", "-1"},
       "--sample must be a whole number from 0 to 65535, not '-1' (see eyeray probe --help)"},
      {{"generate", "terrain", "-o", "x.toml", "--seed", "x"},
       "--seed must be a whole number from 0 to 4294967295, not 'x' (see eyeray generate terrain --help)"},
      {{"completion", "bsh"},
       "SHELL must be one of bash, zsh, fish, not 'bsh' (see eyeray completion --help)"},
  };
  for (const Mistake& mistake : mistakes) {
    const ProcessResult result = run_eyeray(mistake.arguments);
    CHECK(result.code == 2);
    CHECK(result.out == "");
    CHECK(result.err == "eyeray: error: " + mistake.message + "\n");
  }
  CHECK(folder.names() == std::set<std::string>{"scene.toml"});
}

TEST_CASE("the error of `eyeray bench` names the new program, eyeray-bench") {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"bench"}, {"bench", "scenes/whitted.toml", "-n", "3", "--plot", "a.svg"}, {"bench", "--help"}}) {
    const ProcessResult result = run_eyeray(words);
    CHECK(result.code == 2);
    CHECK(result.err ==
          "eyeray: error: eyeray bench is now a separate program, eyeray-bench, which is not installed: "
          "build it from source with scripts/build release eyeray-bench\n");
  }
}

TEST_CASE("without a command the help is printed as text") {
  const ProcessResult result = run_eyeray({});
  CHECK(result.code == 2);
  CHECK(result.out == "");
  CHECK(result.err.find("Usage: eyeray") != std::string::npos);
}

TEST_CASE("every command explains itself with an example, in lines that fit") {
  for (const std::string command : {"render", "verify", "compare", "probe", "check", "dev", "devices",
                                    "generate", "shaders", "merge", "slurm", "new"}) {
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
      // CLI11's own words: a flag's value, a type, options that exclude each other.
      if (line.starts_with("  ") && line.find("eyeray") == std::string::npos)
        CHECK_FALSE(std::regex_search(line, std::regex(R"(\{\w|:value|Excludes|TEXT|REQUIRED)")));
    }
  }
}

TEST_CASE("help is as wide as the terminal, and 110 columns elsewhere") {
  // Options only: examples follow them.
  const auto widest = [](const std::string& help) {
    std::istringstream lines(help.substr(0, help.find("Examples:")));
    size_t columns = 0;
    for (std::string line; std::getline(lines, line);) columns = std::max(columns, line.size());
    return columns;
  };
  CHECK(widest(run_eyeray({"render", "--help"}).out) > 100);
  CHECK(widest(run_eyeray({"render", "--help"}).out) <= 110);
  Terminal terminal(80);
  Process eyeray(terminal.command("", "sh -c '" + eyeray_binary() + " render --help >&2'"), xterm);
  REQUIRE(terminal.wait_for("Ctrl-C keeps"));
  const size_t narrow = widest(std::regex_replace(terminal.shown(), std::regex("\r"), ""));
  CHECK(narrow > 70);
  CHECK(narrow <= 80);
}

TEST_CASE("the help of an option that overrides a key is made from the key's row") {
  const std::string help = std::regex_replace(run_eyeray({"check", "--help"}).out, std::regex("\\s+"), " ");
  for (const std::string text :
       {"--integrator NAME Integrator (docs/scene-reference.md): raycast, whitted, path or sppm.",
        "--triangle METHOD Triangle intersection: woop or moller-trumbore.",
        "--spp N Samples a pixel: an integer from 1 to 65536."}) {
    CAPTURE(text);
    CHECK(help.find(text) != std::string::npos);
  }
}

TEST_CASE("a wrong value of an option that overrides a key is reported as written") {
  const SceneFolder folder;
  for (const std::string written : {"-s 0x48", "--spp 0", "--exposure high", "--integrator whited",
                                    "--max-depth -1", "--seed -1", "--triangle no"}) {
    const size_t space = written.find(' ');
    const ProcessResult result =
        run_eyeray({"check", folder.scene(), written.substr(0, space), written.substr(space + 1)});
    CAPTURE(result.err);
    CHECK(result.code == 2);
    CHECK(result.err.starts_with(written + ": error: "));
  }
  CHECK(run_eyeray({"check", folder.scene(), "-D", "image.width=0"})
            .err.starts_with("-D image.width=0: error: "));
}

TEST_CASE("the version is printed, with the commit if there was one") {
  const ProcessResult result = run_eyeray({"--version"});
  CHECK(result.code == 0);
  CHECK(std::regex_match(result.out, std::regex(R"(eyeray 0\.\d+\.\d+( \(commit [0-9a-f]{12}\))?\n)")));
}

TEST_CASE("the commit is that of the sources' own clone, and there is none without") {
  const TemporaryFolder folder;
  const auto facts_of = [](const std::string& source) { return build_fact("commit", source); };
  const std::string clone = folder / "clone", inside = clone + "/inside";
  REQUIRE(std::filesystem::create_directories(inside));
  CHECK(facts_of(clone) == "");
  const ProcessResult made = run_process(
      {"sh", "-c",
       "cd " + clone +
           " && git init -q && git -c user.name=a -c user.email=a@b commit -q --allow-empty -m a && git "
           "rev-parse HEAD"});
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
  CHECK(facts_of(clone) == made.out.substr(0, 12));
  CHECK(facts_of(inside) == "");  // as of a source package that was unpacked in another project's clone
}

TEST_CASE("parts identify the program by sources and compiler, not by commit or build folder") {
  const TemporaryFolder folder;
  const auto tree = [&](const std::string& name) {
    const std::filesystem::path root = folder / name;
    for (const char* const file : {"CMakeLists.txt", "host/core/a.cpp", "shaders/a.glsl", "docs/a.md"}) {
      std::filesystem::create_directories((root / file).parent_path());
      write_text(root / file, file);
    }
    return root.string();
  };
  const std::string one = tree("one"), two = tree("two");
  const std::string sum = build_fact("sum_of_sources", one);
  CHECK(sum.size() == 64);
  REQUIRE(run_process({"sh", "-c",
                       "cd " + two +
                           " && git init -q && git -c user.name=a -c user.email=a@b commit -q --allow-empty "
                           "-m a"})
              .code == 0);
  write_text(two + "/docs/a.md", "changed");
  CHECK(build_fact("commit", two) != build_fact("commit", one));
  CHECK(build_fact("sum_of_sources", two) == sum);
  CHECK(build_fact("sum_of_sources", one, "another compiler") != sum);
  for (const char* const file :
       {"/CMakeLists.txt", "/host/core/a.cpp", "/shaders/a.glsl", "/shaders/new.glsl"}) {
    CAPTURE(file);
    const std::string changed = tree("changed");
    write_text(changed + file, "changed");
    CHECK(build_fact("sum_of_sources", changed) != sum);
    std::filesystem::remove_all(changed);
  }

  // The sum in the part is that of the built program's sources.
  const SceneFolder scene;
  REQUIRE(run_eyeray({"render", scene.scene(), "--shard", "1/2", "-o", scene / "a.eyeray"}).code == 0);
  const std::string part = read_text(scene / "a.eyeray");
  const std::string facts = read_text(BUILD_FACTS);
  CHECK(part.find("[\"sources of eyeray\",\"" + fact_in(facts, "sum_of_sources") + "\",") !=
        std::string::npos);
  CHECK(part.find("\"build\":\"" + fact_in(facts, "sum_of_sources") + "\"") != std::string::npos);
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

TEST_CASE("a reader that closes its pipe is no error, but a full disk is") {
  const std::string binary = eyeray_binary();
  const ProcessResult pipe =
      run_process({"sh", "-c", "(" + binary + " shaders --print math/math.glsl; echo $? >&2) | true"});
  CHECK(pipe.err == "0\n");
  const ProcessResult full = run_process({"sh", "-c", binary + " shaders --list > /dev/full"});
  CHECK(full.code == 4);
  CHECK(full.err == "eyeray: error: cannot write to standard output: No space left on device\n");
  // Texts that are longer than the buffer of the stream, and a stream that is closed.
  for (const std::string command : {"check --schema", "completion bash"}) {
    CAPTURE(command);
    CHECK(run_process({"sh", "-c", binary + " " + command + " > /dev/full"}).err == full.err);
    const ProcessResult closed = run_process({"sh", "-c", binary + " " + command + " >&-"});
    CHECK(closed.code == 4);
    CHECK(closed.err == "eyeray: error: cannot write to standard output: Bad file descriptor\n");
  }
}

TEST_CASE("a folder that cannot be made is reported with name, reason and code 4") {
  const SceneFolder folder;
  const std::string below = folder.scene() + "/below";
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"shaders", "--export", below},
                                             {"new", below},
                                             {"manual", below},
                                             {"verify", folder.scene(), "--report", below}}) {
    CAPTURE(words[0]);
    const ProcessResult result = run_eyeray(words);
    CHECK(result.code == 4);
    CHECK(result.err.starts_with("eyeray: error: cannot make the folder " + below));
    CHECK(result.err.ends_with(": Not a directory\n"));
  }
}
