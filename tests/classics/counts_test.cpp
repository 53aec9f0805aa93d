// With Haines' sampling, his databases take as many rays as he published (the package's Readme.txt, 3.14).
#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "classics.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

struct Published {
  std::string_view classic;
  int size_factor;
  int64_t eye_hits, reflected, refracted, shadow;
  bool quick = true;  // false: tested only with EYERAY_FULL_TESTS=1
};

// docs/experiments/ray-counts.md explains the differences.
const Published published[] = {
    {"sphereflake", 4, 263169, 175095, 0, 954368},
    {"tetra", 6, 49788, 0, 0, 46112},
    {"tree", 11, 169836, 0, 0, 1097419},
    {"rings", 7, 263169, 315236, 0, 1085002, false},
    {"gears", 4, 245086, 304643, 207564, 2246955, false},
    {"mount", 6, 173125, 354769, 354769, 412922},
    {"teapot", 12, 161120, 225248, 0, 407656},
};

// True if the counts agree within half a per cent; a count of 0 must be exact.
bool agrees(int64_t ours, int64_t theirs) {
  return 200 * std::abs(ours - theirs) <= theirs;
}

}  // namespace

TEST_CASE("the classics trace the published numbers of rays" * doctest::test_suite("long")) {
  for (const Published& each : published) {
    if (!each.quick && !std::getenv("EYERAY_FULL_TESTS")) continue;
    CAPTURE(each.classic);
    const TemporaryFolder folder;
    const std::string scene = folder / "scene.toml";
    const auto classic = std::ranges::find(classics::all_classics(), each.classic, &classics::Classic::name);
    if (classic != classics::all_classics().end())
      classics::write(*classic, each.size_factor, folder.path());
    else
      REQUIRE(run_eyeray({"generate", std::string(each.classic), "-o", scene}).code == 0);
    const ProcessResult result =
        run_eyeray({"render", scene, "--classic", "--stats", "--json", "--quiet", "-o", folder / "a.png"});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const auto report = nlohmann::json::parse(result.out);
    CHECK(report.at("width") == 512);
    CHECK(report.at("height") == 512);
    const auto& kinds = report.at("ray_kinds");
    CHECK(kinds.at("eye") == 513 * 513);
    const auto count = [&](const char* kind) { return kinds.at(kind).get<int64_t>(); };
    CHECK(agrees(count("eye_hits"), each.eye_hits));
    CHECK(agrees(count("reflected"), each.reflected));
    // His count of refracted rays includes those that are totally reflected.
    CHECK(agrees(count("refracted") + count("total_reflections"), each.refracted));
    CHECK(agrees(count("shadow"), each.shadow));
    CHECK(report.at("rays") == count("eye") + count("reflected") + count("refracted") + count("shadow"));
  }
}
