// eyeray new: a project that renders, verifies and reloads at once.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

const std::vector<std::string> project_files{".github/workflows/pictures.yml", "README.md",
                                             "materials/mosaic.glsl", "scene.toml", "shapes/column.glsl"};

}  // namespace

TEST_CASE("a new project passes the commands of its README") {
  const TemporaryFolder folder;
  const std::string project = folder / "mine";
  const ProcessResult made = run_eyeray({"new", project, "--json"});
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
  const nlohmann::json summary = nlohmann::json::parse(made.out);
  CHECK(summary["files"] == project_files);
  CHECK(summary["scene"] == project + "/scene.toml");
  for (const std::string& file : project_files) CHECK(std::filesystem::exists(project + "/" + file));

  const std::string scene = project + "/scene.toml";
  replace_in_file(scene, "width = 480\nheight = 320\n", "width = 96\nheight = 64\n");
  const ProcessResult verified = run_eyeray({"verify", scene, "--record"});
  CAPTURE(verified.out);
  CHECK(verified.code == 0);
  CHECK(read_text(scene).find("max_explained = ") != std::string::npos);
  const ProcessResult rendered = run_eyeray({"dev", scene, "--once", "-o", folder / "a.png"});
  CAPTURE(rendered.err);
  CHECK(rendered.code == 0);
  CHECK(rendered.err.find("warning") == std::string::npos);

  // A wrong line of the project's own shape is reported at its position.
  replace_in_file(project + "/shapes/column.glsl", "float angle = twist * p.y;",
                  "float angle = twist * p.w;");
  const ProcessResult broken = run_eyeray({"dev", scene, "--once"});
  CAPTURE(broken.err);
  CHECK(broken.code == 2);
  CHECK(broken.err.find("shapes/column.glsl:3:") != std::string::npos);
}

TEST_CASE("a project is written whole or not at all, and overwrites nothing") {
  const TemporaryFolder folder;
  write_text(folder / "scene.toml", "mine");
  const ProcessResult refused = run_eyeray({"new", folder.path()});
  CHECK(refused.code == 4);
  CHECK(refused.err.find("scene.toml exists already; nothing was written") != std::string::npos);
  CHECK(read_text(folder / "scene.toml") == "mine");
  CHECK(folder.names() == std::set<std::string>{"scene.toml"});
  CHECK(run_eyeray({"new", folder / "scene.toml"}).code == 4);
  CHECK(run_eyeray({"new"}).code == 2);
}
