// eyeray kernels: the kernels of a scene, on lavapipe and on RADV's null hardware.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;
using Json = nlohmann::json;

namespace {

Json kernels_of(const std::string& scene, const std::vector<std::string>& options) {
  std::vector<std::string> arguments{"kernels", scene, "--json"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ProcessResult result = run_eyeray(arguments);
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  return Json::parse(result.out);
}

std::set<std::string> names_of(const Json& answer) {
  std::set<std::string> names;
  for (const Json& kernel : answer.at("kernels")) names.insert(kernel.at("name"));
  return names;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// The environment in which the Vulkan loader finds lavapipe alone.
Environment only_lavapipe() {
  for (const auto& file : std::filesystem::directory_iterator("/usr/share/vulkan/icd.d"))
    if (file.path().filename().string().starts_with("lvp_icd"))
      return {{"VK_DRIVER_FILES", file.path()}, {"VK_ICD_FILENAMES", file.path()}};
  FAIL("lavapipe is missing");
  return {};
}

}  // namespace

TEST_CASE("kernels lists all kernels that a scene's integrator and the profile lead to") {
  const SceneFolder folder;
  const std::set<std::string> simple{"render", "render-first-hits", "query", "query-any"};
  CHECK(names_of(kernels_of(folder.scene(), {})) == simple);
  std::set<std::string> path = simple;
  path.insert("render-auxiliary");
  CHECK(names_of(kernels_of(folder.scene(), {"--integrator", "path"})) == path);
  std::set<std::string> photons = path;
  photons.insert("photons");
  CHECK(names_of(kernels_of("scenes/sppm/box.toml", {})) == photons);
  REQUIRE(run_eyeray({"generate", "terrain", "--grid", "20", "-o", folder / "terrain.toml"}).code == 0);
  const std::set<std::string> wavefront{"packet-primary",
                                        "packet-shadow",
                                        "wavefront-stored-hits",
                                        "bvh4-bounce-hits",
                                        "bvh4-bounce-shadow",
                                        "wavefront-listed-stored-hits",
                                        "render-first-hits",
                                        "render-auxiliary",
                                        "packet",
                                        "packet-query-any",
                                        "bvh4",
                                        "bvh4-query-any"};
  CHECK(names_of(kernels_of(folder / "terrain.toml",
                            {"--tune", "profile=cpu", "--tune", "rays=packets", "--tune",
                             "incoherent=cooperative", "--integrator", "path"})) == wavefront);
}

TEST_CASE("without the driver's statistics, kernels says so and lists SPIR-V bytes and build times") {
  const SceneFolder folder;
  const ProcessResult table =
      run_eyeray({"kernels", folder.scene(), "--device", "cpu", "--spirv", folder / "spirv"});
  CHECK(table.code == 0);
  CHECK(table.err == "");
  CHECK(contains(table.out, "kernel             SPIR-V bytes   build\n"));
  CHECK(contains(table.out,
                 "\nThe driver states no registers, spills or waves: it lacks "
                 "VK_KHR_pipeline_executable_properties.\n"));
  const Json answer = kernels_of(folder.scene(), {"--device", "cpu"});
  CHECK(contains(answer.at("device"), "llvmpipe"));
  for (const Json& kernel : answer.at("kernels")) {
    const std::string name = kernel.at("name");
    CAPTURE(name);
    CHECK(kernel.at("programs").empty());
    CHECK(kernel.at("build_seconds").get<double>() > 0);
    // The bytes that the driver gets, which begin with SPIR-V's magic number.
    const std::string spirv = read_text(folder / ("spirv/" + name + ".spv"));
    CHECK(kernel.at("spirv_bytes") == spirv.size());
    CHECK(spirv.substr(0, 4) == "\x03\x02\x23\x07");
    CHECK(contains(table.out, "\n" + name + " "));
  }
}

TEST_CASE("kernels states registers, spills and waves of AMD GPUs that are not there") {
  const SceneFolder folder;
  for (const auto& each : {std::pair{"navi21", "NAVI21"},
                           {"gfx1100", ""},
                           {"navi31", ""},
                           {"vega10", "VEGA10"},
                           {"polaris10", "POLARIS10"}}) {
    const std::string family = each.first;
    CAPTURE(family);
    const Json answer = kernels_of(folder.scene(), {"--family", family, "--tune", "division=own"});
    CHECK(contains(answer.at("device"), "Null hardware"));
    CHECK(contains(answer.at("device"), each.second));
    CHECK(names_of(answer).size() == 4);
    for (const Json& kernel : answer.at("kernels")) {
      CAPTURE(kernel.dump());
      REQUIRE(kernel.at("programs").size() == 1);
      const Json& program = kernel.at("programs")[0];
      CHECK(program.at("subgroup_size") == 64);
      const Json& statistics = program.at("statistics");
      CHECK(statistics.at("vgprs") > 0);
      CHECK(statistics.at("sgprs") > 0);
      CHECK(statistics.at("waves") >= 1);
      CHECK(statistics.at("waves") <= 32);
      CHECK(statistics.at("instructions") > 100);
      CHECK(statistics.at("latency") > 100);
      CHECK(statistics.at("scratch_bytes") >= 0);
      CHECK(statistics.at("spilled_vgprs") == 0);
      CHECK(statistics.at("spilled_sgprs") >= 0);
      CHECK(statistics.contains("Code size"));  // by the driver's own name
    }
  }
  const ProcessResult table =
      run_eyeray({"kernels", folder.scene(), "--family", "navi21", "--tune", "division=own"});
  CHECK(contains(table.out, "VGPRs  SGPRs  spilled VGPRs  spilled SGPRs  scratch  waves  instructions"));
  CHECK_FALSE(contains(table.out, "Code size"));
}

TEST_CASE("kernels for a GPU that is not there divide exactly, as no GPU does by itself") {
  const SceneFolder folder;
  const auto bytes = [&](const std::string& division) {
    return kernels_of(folder.scene(), {"--family", "navi21", "--tune", "division=" + division})
        .at("kernels")[0]
        .at("spirv_bytes")
        .get<size_t>();
  };
  CHECK(bytes("auto") == bytes("exact"));
  CHECK(bytes("auto") > bytes("own"));
}

TEST_CASE("kernels --compare lists the figures that differ, with code 1") {
  const SceneFolder folder;
  const std::vector<std::string> words{"kernels", folder.scene(), "--family",
                                       "navi21",  "--tune",       "division=own"};
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return run_eyeray(more);
  };
  const std::string old_file = folder / "old.json";
  write_text(old_file, run({"--json"}).out);
  const ProcessResult same = run({"--compare", old_file});
  CHECK(same.code == 0);
  CHECK(contains(same.out, "\nNo figure differs from " + old_file + ".\n"));

  Json old = Json::parse(read_text(old_file));
  Json& statistics = old["kernels"][0]["programs"][0]["statistics"];
  const int vgprs = statistics["vgprs"];
  statistics["vgprs"] = vgprs + 8;
  statistics.erase("waves");
  old["kernels"][0]["build_seconds"] = 1000;  // differs each time, and is not compared
  write_text(old_file, old.dump());
  const ProcessResult changed = run({"--compare", old_file});
  CHECK(changed.code == 1);
  CHECK(contains(changed.out, fmt::format("\nThese figures differ from {}:\n  render: vgprs {} -> {}\n",
                                          old_file, vgprs + 8, vgprs)));
  CHECK(contains(changed.out, "\n  render: waves none -> "));
  const ProcessResult in_json = run({"--compare", old_file, "--json"});
  CHECK(in_json.code == 1);
  const Json changes = Json::parse(in_json.out).at("changes");
  REQUIRE(changes.size() == 2);
  CHECK(changes[0] == Json{{"kernel", "render"}, {"figure", "vgprs"}, {"old", vgprs + 8}, {"new", vgprs}});
  CHECK(changes[1].at("old").is_null());
}

TEST_CASE("kernels refuses a wrong OLD.json with code 4, and names it") {
  const SceneFolder folder;
  const std::string old_file = folder / "old.json";
  const auto refuses = [&](const std::string& message) {
    const ProcessResult result = run_eyeray({"kernels", folder.scene(), "--compare", old_file});
    CAPTURE(result.err);
    CHECK(result.code == 4);
    CHECK(contains(result.err, old_file));
    CHECK(contains(result.err, message));
    CHECK(result.out == "");
  };
  refuses("No such file");
  for (const std::string& text :
       {std::string(), std::string("{}"), std::string("[1, 2"), std::string(100000, '['),
        std::string(R"({"kernels": [7]})"), std::string(R"({"kernels": [{"name": "render"}]})"),
        std::string(R"({"kernels": [{"name": "render", "spirv_bytes": 1, "programs": [1]}]})")}) {
    CAPTURE(text.substr(0, 100));
    write_text(old_file, text);
    refuses("it is not the output of eyeray kernels --json");
  }
}

TEST_CASE("kernels reports an unknown family, and a machine without RADV") {
  const SceneFolder folder;
  const ProcessResult unknown = run_eyeray({"kernels", folder.scene(), "--family", "navi99"});
  CHECK(unknown.code == 2);
  CHECK(unknown.err ==
        "eyeray: error: --family must be a family of AMD's GPUs that this machine's RADV knows, such as "
        "navi21, gfx1100, vega10 or polaris10, not 'navi99'\n");
  const ProcessResult missing =
      run_eyeray({"kernels", folder.scene(), "--family", "navi21"}, only_lavapipe());
  CHECK(missing.code == 3);
  CHECK(contains(missing.err, "--family needs RADV, Mesa's Vulkan driver for AMD, but the Vulkan loader"));
  CHECK(run_eyeray({"kernels", folder.scene(), "--family", "navi21", "--device", "cpu"}).code == 2);
}

TEST_CASE("no command renders on hardware that only compiles") {
  const SceneFolder folder;
  const Environment forced{{"RADV_FORCE_FAMILY", "navi21"}};
  const std::string picture = folder / "a.pfm";
  const ProcessResult chosen = run_eyeray({"render", folder.scene(), "-o", picture}, forced);
  CHECK(chosen.code == 0);
  CHECK(contains(chosen.err, "llvmpipe"));
  const ProcessResult forced_there =
      run_eyeray({"render", folder.scene(), "--device", "radv", "-o", picture}, forced);
  CHECK(forced_there.code == 3);
  CHECK(contains(forced_there.err, "not usable: it compiles kernels, but runs none"));
}
