// eyeray bench measures what it says; how fast anything is, no test asks.
#include <nlohmann/json.hpp>

#include "scene.hpp"
//
#include "support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::test;

TEST_CASE("bench measures every backend, and cold and warm starts") {
  const SceneFolder folder;
  const ProcessResult result = run_eyeray(
      {"bench", folder.scene(), "-n", "2", "-s", "64x64", "--backends", "gpu,twin,reference", "--json"});
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

TEST_CASE("bench as text, and a scene that is not there") {
  const SceneFolder folder;
  const ProcessResult text = run_eyeray({"bench", folder.scene(), "-n", "1", "-s", "16x16", "--no-start"});
  CHECK(text.code == 0);
  CHECK(text.out.find("whole process") != std::string::npos);
  CHECK(text.out.find("rays/s") != std::string::npos);
  CHECK(run_eyeray({"bench", folder / "nope.toml"}).code == 4);
}
