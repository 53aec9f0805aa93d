// The probe finds each fault of the GPU's side at the value that is wrong.
#include <nlohmann/json.hpp>
#include <span>

#include "tests/support/faults.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

struct Probed {
  std::string fault;
  std::string pixel;
  std::string ray;    // the last ray on the way to the difference
  std::string value;  // "" where a ray is missing
  std::vector<std::string> scene = {"scenes/whitted.toml"};
};

void expect_found(const Probed& probed) {
  CAPTURE(probed.fault);
  const TemporaryFolder folder;
  std::vector<std::string> arguments = {"probe"};
  arguments.insert(arguments.end(), probed.scene.begin(), probed.scene.end());
  arguments.insert(arguments.end(), {probed.pixel, "-s", "96x72", "--json"});
  if (!probed.fault.empty())
    arguments.insert(arguments.end(), {"--shaders", lay_fault(folder, probed.fault)});
  const ProcessResult result = run_eyeray(arguments);
  CAPTURE(result.err);
  REQUIRE(result.code == 1);
  const auto first = nlohmann::json::parse(result.out).at("first_difference");
  CAPTURE(first.dump());
  CHECK(first.at("way").get<std::string>().ends_with(probed.ray));
  CHECK(first.value("name", "") == probed.value);
}

// The faults and the first difference of each; one entry differs by an option instead of a fault.
const Probed probed_faults[] = {
    {"ior", "56,22", "camera ray", "ior"},
    {"shadow", "31,60", "shadow ray to light 0", "visibility"},
    {"bit", "47,30", "shadow ray to light 0", "direction"},
    {"near_root", "43,21", "shadow ray to light 0", "visibility"},
    {"edge", "22,42", "camera ray", "primitive"},
    {"position", "10,48", "pixel", "first_hit_position"},
    {"ids", "44,20", "pixel", "first_hit_primitive"},
    {"normal", "13,46", "camera ray", "normal"},
    {"uv", "1,48", "camera ray", "uv"},
    {"camera", "4,62", "camera ray", "direction"},
    {"fresnel", "41,28", "camera ray", "reflected"},
    {"refraction", "48,45", "refracted ray", "origin"},
    {"mirror", "41,50", "reflected ray", "direction"},
    {"depth", "43,21", "ray", ""},
    {"checker", "13,46", "camera ray", "ambient"},
    {"counts", "0,0", "pixel", "hits"},
    {"offset", "39,22", "ray", "origin"},
    {"light", "30,43", "shadow ray to light 0", "contribution"},
    {"near_light", "47,29", "shadow ray to light 0", "direction"},
    {"materials", "32,43", "camera ray", "material"},
    {"nan", "0,36", "pixel", "color"},
    {"black", "47,30", "pixel", "color"},
    {"shift", "58,47", "camera ray", "direction"},
    {"", "21,52", "camera ray", "direction", {"scenes/whitted.toml", "--fast-math"}},
    {"random",
     "43,21",
     "camera ray",
     "direction",
     {"scenes/whitted.toml", "--spp", "4", "-D", "image.pattern=jittered"}},
};

}  // namespace

TEST_CASE("the probe locates a wrong index of refraction, a missing shadow and a flipped bit") {
  for (const Probed& probed : std::span(probed_faults).first(3)) expect_found(probed);
}

TEST_CASE("the probe locates every fault that a pixel's kernel has" * doctest::test_suite("long")) {
  for (const Probed& probed : probed_faults) expect_found(probed);
}
