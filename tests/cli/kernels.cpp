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

Json kernels_of(const std::vector<std::string>& options, const std::string& scene) {
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

}  // namespace

TEST_CASE("kernels lists all kernels that a scene's integrator and the profile lead to") {
  const SceneFolder folder;
  const std::set<std::string> simple{"render", "render-first-hits", "query", "query-any"};
  CHECK(names_of(kernels_of({}, folder.scene())) == simple);
  std::set<std::string> path = simple;
  path.insert("render-auxiliary");
  CHECK(names_of(kernels_of({"--integrator", "path"}, folder.scene())) == path);
  std::set<std::string> photons = path;
  photons.insert("photons");
  CHECK(names_of(kernels_of({}, "scenes/sppm/box.toml")) == photons);
  const std::set<std::string> wavefront{
      "packet-primary",    "packet-shadow",          "wavefront-stored-hits", "bvh4-bounce-hits",
      "bvh4-bounce-shadow", "wavefront-listed-stored-hits", "render-first-hits",  "render-auxiliary",
      "packet",            "packet-query-any",       "bvh4",                  "bvh4-query-any"};
  CHECK(names_of(kernels_of({"--tune", "profile=cpu", "--tune", "rays=packets", "--tune",
                             "incoherent=cooperative", "--tune", "acceleration=bvh", "--integrator", "path"},
                            "scenes/shapes/sphere.toml")) == wavefront);
}
