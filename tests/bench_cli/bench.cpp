// eyeray-bench measures the quantities that it names; no test checks how fast anything is.
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/cli/scene.hpp"
#include "tests/cli/terminal.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// eyeray-bench lies beside eyeray.
const std::string bench_binary = eyeray_binary() + "-bench";

ProcessResult run_bench(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), bench_binary);
  return run_process(arguments, {}, 3600);
}

ProcessResult plotted(const std::string& json, const std::string& picture) {
  return run_process({"/usr/bin/python3", "scripts/plot-bench", json, picture});
}

}  // namespace

TEST_CASE("bench measures every backend, and cold and warm starts") {
  const SceneFolder folder;
  const ProcessResult result = run_bench({folder.scene(), "-n", "2", "-s", "64x64", "--no-povray",
                                          "--backends", "gpu,twin,reference", "--json"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  const auto entry = nlohmann::json::parse(result.out).at("bench").at(0);
  CHECK(entry.at("runs") == 2);
  std::vector<std::string> names;
  for (const auto& series : entry.at("series")) {
    names.push_back(series.at("name"));
    CHECK(series.at("rays") >= 64 * 64);
    const auto whole = series.at("seconds").at("whole process");
    CHECK(whole.at("min") <= whole.at("median"));
    CHECK(whole.at("median") <= whole.at("max"));
    CHECK(series.at("tracing").at("median") < whole.at("median"));
  }
  CHECK(names == std::vector<std::string>{"gpu", "twin", "reference", "cold start", "warm start"});

  // The compiler has more to do when nothing is cached.
  const auto compile = [&](int i) {
    return entry.at("series").at(i).at("seconds").at("shader compile").at("median").get<double>();
  };
  CHECK(compile(3) > compile(4));
}

TEST_CASE("rays are raced beside Embree, plotted by a script, and compared with an older run") {
  const SceneFolder folder;
  const std::vector<std::string> command{folder.scene(), "terrain-51k", "-n",           "2",
                                         "-s",           "64x48",       "--no-pictures"};
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(), command.begin(), command.end());
    return run_bench(more);
  };
  const ProcessResult json = run({"--json"});
  CAPTURE(json.err);
  REQUIRE(json.code == 0);
  const auto answer = nlohmann::json::parse(json.out);
  CHECK(answer.at("bench").empty());
  const auto field = answer.at("field");
  REQUIRE(field.size() == 2);
  CHECK(field[0].at("primitives") == 1);
  CHECK(field[1].at("scene") == "terrain-51k");
  CHECK(field[1].at("primitives") == 51200);
  CHECK(field[1].at("builds").at(0).at("contender") == "Embree");
  for (const auto& scene : field) {
    for (const auto& batch : scene.at("batches")) {
      CHECK(batch.at("rays") > 100);
      for (const auto& timing : batch.at("timings")) {
        CHECK(timing.at("rays_per_second") > 1000);
        CHECK(timing.at("seconds").at("min") <= timing.at("seconds").at("max"));
        // A ray towards an edge may hit either side.
        CHECK(timing.at("differing").get<double>() <= 0.01 * batch.at("rays").get<double>());
      }
    }
  }

  write_text(folder / "old.json", json.out);
  const ProcessResult plot = plotted(folder / "old.json", folder / "rays.svg");
  CAPTURE(plot.err);
  CHECK(plot.code == 0);
  const std::string svg = read_text(folder / "rays.svg");
  for (const char* text : {"primary", "shadow", "bounce", "Embree single", "gpu", "terrain-51k, primary"}) {
    CAPTURE(text);
    CHECK(svg.find(fmt::format(">{}<", text)) != std::string::npos);
  }

  const ProcessResult text = run({"--compare", folder / "old.json"});
  CHECK(text.code == 0);
  CHECK(text.out.find("Embree single") != std::string::npos);
  CHECK(text.out.find("since " + (folder / "old.json") + ":\n") != std::string::npos);
  CHECK(text.out.find(" -> ") != std::string::npos);

  // Errors are found before anything is measured.
  CHECK(run({"--compare", folder.scene()}).err ==
        "eyeray-bench: error: " + folder.scene() + " is not what eyeray-bench --json answers\n");
  const ProcessResult unknown = run_bench({"terrain-51l", "-s", "8x8"});
  CHECK(unknown.code == 4);
  CHECK(run_bench({"-s", "70000x1"}).code == 2);
}

TEST_CASE("a scene is written for POV-Ray, or a message states why not") {
  const auto names_of = [](const char* scene, std::string& err) {
    const ProcessResult run = run_bench(
        {scene, "-n", "1", "-s", "32x24", "--no-rays", "--no-start", "--backends", "twin", "--json"});
    err = run.err;
    REQUIRE(run.code == 0);
    const auto answer = nlohmann::json::parse(run.out);
    std::vector<std::string> names;
    for (const auto& series : answer.at("bench").at(0).at("series")) names.push_back(series.at("name"));
    return names;
  };
  const bool povray = std::system("povray --version > /dev/null 2>&1") == 0;
  std::string err;
  CHECK(names_of("scenes/shapes/bezier.toml", err).size() == (povray ? 2 : 1));
  CHECK(err.find("POV-Ray") == std::string::npos);
  CHECK(names_of("scenes/shapes/bilinear.toml", err) == std::vector<std::string>{"twin"});
  CHECK((err.find("bilinear.toml: without POV-Ray: ") != std::string::npos) == povray);
}

TEST_CASE("a mesh is measured from file to picture, and compared with POV-Ray and an older run" *
          doctest::test_suite("long")) {
  const SceneFolder folder;
  const auto run = [&](std::vector<std::string> more) {
    const std::vector<std::string> command{"terrain-51k", "scenes/meshes/gem.obj", "-n", "1", "-s", "64x48",
                                           "--no-rays"};
    more.insert(more.begin(), command.begin(), command.end());
    return run_bench(more);
  };
  const ProcessResult json = run({"--json"});
  CAPTURE(json.err);
  REQUIRE(json.code == 0);
  const auto pictures = nlohmann::json::parse(json.out).at("bench");
  REQUIRE(pictures.size() == 2);
  CHECK(pictures[0].at("scene") == "terrain-51k");
  CHECK(pictures[0].at("primitives") == 51200);
  const bool povray = std::system("povray --version > /dev/null 2>&1") == 0;
  for (const auto& picture : pictures) {
    CHECK(picture.at("kernels").at(0).at("name") == "render");
    std::vector<std::string> names;
    for (const auto& series : picture.at("series")) {
      names.push_back(series.at("name"));
      if (names.back() == "povray") continue;
      CHECK(series.at("seconds").at("load").at("median") > 0);
      CHECK(series.at("seconds").at("pack").at("median") > 0);
      CHECK(series.at("peak_memory").at("median") > 1 << 20);
    }
    const std::vector<std::string> ours{"gpu", "cold start", "warm start"};
    const std::vector<std::string> all{"gpu", "povray", "cold start", "warm start"};
    CHECK(names == (povray ? all : ours));
  }

  write_text(folder / "old.json", json.out);
  const ProcessResult text = run({"--compare", folder / "old.json"});
  CHECK(text.code == 0);
  CHECK(text.out.find("bytes a primitive") != std::string::npos);
  CHECK(text.out.find("time to first pixel: cold start ") != std::string::npos);
  for (const char* row : {"gpu          whole process", "gpu          tracing", "warm start   memory"}) {
    CAPTURE(row);
    CHECK(text.out.find(row) != std::string::npos);
  }
  write_text(folder / "wrong.json", R"({"bench": [{"scene": "terrain-51k"}], "field": []})");
  CHECK(run({"--compare", folder / "wrong.json"}).code == 2);
}

TEST_CASE("bench --paths clamps samples as render does") {
  const ProcessResult result = run_bench({"scenes/path/cornell_box.toml", "--paths", "-n", "2", "-s", "8x8",
                                          "--spp", "4", "--clamp", "1e-6", "--json"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  const auto series = nlohmann::json::parse(result.out).at("paths").at(0).at("series");
  for (const auto& each : series) CHECK(each.at("levels").at(0).at("mse") <= 1e-12);

  const TemporaryFolder folder;
  write_text(folder / "paths.json", result.out);
  CHECK(plotted(folder / "paths.json", folder / "paths.svg").code == 0);
  CHECK(read_text(folder / "paths.svg").find("cornell_box") != std::string::npos);
}

TEST_CASE("the plot refuses a file that is not output of eyeray-bench, in one line") {
  const TemporaryFolder folder;
  for (const char* const text : {"{", "[]", R"({"field": [], "paths": []})", R"({"field": [{}]})"}) {
    CAPTURE(text);
    write_text(folder / "a.json", text);
    const ProcessResult refused = plotted(folder / "a.json", folder / "a.svg");
    CHECK(refused.code == 2);
    CHECK(refused.err.ends_with("scripts/plot-bench: " + folder / "a.json" +
                                ": there are neither rays nor paths of eyeray-bench --json in it\n"));
  }
  const ProcessResult missing = plotted(folder / "none.json", folder / "a.svg");
  CHECK(missing.code == 4);
  CHECK(missing.err.find("No such file") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "a.svg"));
}

TEST_CASE("bench prints text, and refuses a missing scene") {
  const SceneFolder folder;
  const ProcessResult text = run_bench({folder.scene(), "-n", "1", "-s", "16x16", "--no-start"});
  CHECK(text.code == 0);
  CHECK(text.out.find("whole process") != std::string::npos);
  CHECK(text.out.find("rays/s") != std::string::npos);
  CHECK(text.out.find(": single") != std::string::npos);
  CHECK(run_bench({folder / "nope.toml"}).code == 4);
}

TEST_CASE("frames and shards are measured as whole processes") {
  const std::string scene = "scenes/animation.toml";
  const auto measure = [&](const char* what, std::initializer_list<const char*> ways) {
    const ProcessResult result = run_bench({scene, what, "3", "-s", "64x48", "--spp", "4", "-D",
                                            "image.width=64", "-D", "image.height=48", "--json"});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const auto output = nlohmann::json::parse(result.out);
    CHECK(output.at(what + 2) == 3);
    for (const char* way : ways) CHECK(output.at(way).at("processor") > 0);
    CHECK(output.at("ratio").at("wall") > 0);
  };
  measure("--frames", {"together", "apart"});
  measure("--shards", {"whole", "parts", "merge"});
  CHECK(run_bench({"none.toml", "--frames", "3"}).code == 4);
  CHECK(run_bench({"none.toml", "--shards", "3"}).code == 4);
  CHECK(run_bench({scene, scene, "--shards", "3"}).code == 2);
}

TEST_CASE("eyeray-bench reports mistakes as eyeray does, under its own name") {
  CHECK(run_bench({"--run", "3"}).err ==
        "eyeray-bench: error: unknown option '--run'; did you mean '--runs'? (see eyeray-bench --help)\n");
  const ProcessResult help = run_bench({"--help"});
  CHECK(help.code == 0);
  CHECK(help.out.find("Usage: eyeray-bench") != std::string::npos);
  const ProcessResult json = run_bench({"none.toml", "--json"});
  CHECK(json.code == 4);
  CHECK(nlohmann::json::parse(json.out).at("error").at("code") == 4);
}

TEST_CASE("a terminal shows that kernels compile, until there is something to print") {
  const SceneFolder folder;
  Terminal terminal(100);
  Process bench(terminal.command(folder.scene() + " -n 1 --no-pictures >/dev/null", bench_binary), xterm);
  CHECK(terminal.wait_for("building BVHs and compiling kernels, then measuring"));
  bench.wait(600);
  CHECK(bench.code() == 0);
  const std::string& shown = terminal.shown();
  CHECK(shown.rfind("compiling kernels") < shown.rfind("\r\033[K"));
}

TEST_CASE("each way to trace incoherent rays races by itself; an unknown one is refused") {
  const auto race = [](const std::string& ways) {
    return run_bench({"terrain-51k", "-n", "1", "-s", "64x48", "--no-pictures", "--no-start", "--incoherent",
                      ways, "--json"});
  };
  const ProcessResult result = race("cooperative,lanes");
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  const auto builds = nlohmann::json::parse(result.out).at("field").at(0).at("builds");
  REQUIRE(builds.size() == 3);
  CHECK(builds.at(1).at("contender") == "gpu cooperative");
  CHECK(builds.at(2).at("contender") == "gpu lanes");
  // The BVH4's bytes include those of the BVH that it was made of.
  CHECK(builds.at(1).at("bytes") > builds.at(2).at("bytes"));

  const ProcessResult refused = race("wider");
  CHECK(refused.code == 2);
  CHECK(refused.err.find("--incoherent must be one of cooperative, lanes, packets, not 'wider'") !=
        std::string::npos);
}

TEST_CASE("an edit of a formula shows the twin's pixels long before its kernel is compiled" *
          doctest::test_suite("long")) {
  const ProcessResult result = run_bench({"--dev", "-n", "2", "--json"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  const auto report = nlohmann::json::parse(result.out);
  for (const char* kind : {"shader", "scene", "formula"}) {
    REQUIRE(report.at(kind).size() == 2);
    for (const auto& edit : report.at(kind)) {
      CHECK(edit.at("first_pixels") > 0);
      CHECK(edit.at("first_pixels") <= edit.at("whole"));
      CHECK(edit.at("first_processor") <= edit.at("processor"));
    }
  }
  for (const auto& edit : report.at("formula")) {
    CHECK(edit.at("compiling") > 0.1);
    CHECK(edit.at("first_processor").get<double>() < edit.at("processor").get<double>() / 4);
  }
}
