// Faults of geometry on the GPU's side, against triangles of the device's rasteriser: gate R must detect each
// that changes a camera ray's hit, and pass the twin and the reference.
#include <nlohmann/json.hpp>

#include "tests/support/faults.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// The findings of gate R, by executor.
nlohmann::json gate_r(const std::string& scene, const std::string& fault) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = {"verify", scene,     "-s",     "96x72",        "--raster",
                                        "--json", "--quiet", "--keep", folder / "kept"};
  if (!fault.empty()) arguments.insert(arguments.end(), {"--shaders", lay_fault(folder, fault)});
  const ProcessResult result = run_eyeray(arguments);
  CAPTURE(result.err);
  CHECK(result.code == (fault.empty() ? 0 : 1));
  return nlohmann::json::parse(result.out).at("scenes").at(0).at("gate_r");
}

void expect_noticed(const std::string& scene, const std::string& fault, int least) {
  CAPTURE(scene);
  CAPTURE(fault);
  const nlohmann::json gates = gate_r(scene, fault);
  REQUIRE(gates.size() == 3);
  CHECK(gates[0]["value"] == "gpu");
  CHECK(gates[0]["passed"] == false);
  CHECK(gates[0]["unexplained"] >= least);
  CHECK(gates[1]["passed"] == true);
  CHECK(gates[2]["passed"] == true);
}

}  // namespace

TEST_CASE("gate R detects every fault of geometry that changes the hit of a camera ray") {
  expect_noticed("scenes/inside_glass.toml", "near_root", 1000);
  expect_noticed("scenes/meshes.toml", "edge", 100);
  expect_noticed("scenes/shapes/superellipsoid.toml", "steps", 100);
  expect_noticed("scenes/whitted.toml", "position", 1000);
  expect_noticed("scenes/whitted.toml", "ids", 1000);
  expect_noticed("scenes/whitted.toml", "camera", 1000);
  expect_noticed("scenes/whitted.toml", "shift", 1000);
}

TEST_CASE("gate R passes without a fault, and with a fault that changes no first hit") {
  for (const char* fault : {"", "light"}) {
    const nlohmann::json gates = gate_r("scenes/meshes.toml", fault);
    REQUIRE(gates.size() == 3);
    for (const nlohmann::json& gate : gates) {
      CHECK(gate["passed"] == true);
      CHECK(gate["unexplained"] == 0);
      CHECK(gate["equal"] >= 0.999 * 96 * 72);
    }
  }
}
