// What .github/actions/verify runs, as GitHub would run it.
#include <filesystem>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::test;

namespace {

// The shell text of the action's step: the lines below "run: |".
std::string step() {
  const std::string action = read_text(".github/actions/verify/action.yml");
  const size_t begin = action.find("run: |\n");
  REQUIRE(begin != std::string::npos);
  std::istringstream lines(action.substr(begin + 7));
  std::string text;
  for (std::string line; std::getline(lines, line) && line.starts_with("        ");) text += line + '\n';
  return text;
}

}  // namespace

TEST_CASE("the CI recipe verifies on lavapipe, and leaves a report whatever comes of it") {
  const SceneFolder folder;
  const std::string here = std::filesystem::current_path();
  const auto run = [&](const std::string& options) {
    return run_process({"sh", "-euc", step()},
                       {{"GITHUB_ACTIONS", "true"},
                        {"GITHUB_ACTION_PATH", here + "/.github/actions/verify"},
                        {"GITHUB_STEP_SUMMARY", folder / "summary.md"},
                        {"EYERAY_BINARY", eyeray_binary()},
                        {"SCENES", folder.path()},
                        {"OPTIONS", options},
                        {"REPORT", folder / "report"}},
                       600);
  };
  const ProcessResult passed = run("-s 16x12");
  CAPTURE(passed.out);
  CAPTURE(passed.err);
  CHECK(passed.code == 0);
  CHECK(read_text(folder / "report/junit.xml").find("failures=\"0\"") != std::string::npos);

  const ProcessResult failed = run("-s 16x12 --inject-fault light");
  CHECK(failed.code == 1);
  CHECK(failed.out.find("\n::error file=") != std::string::npos);
  CHECK(read_text(folder / "summary.md").find("| failed |") != std::string::npos);
  CHECK(std::filesystem::exists(folder / "report/index.html"));
  CHECK(std::filesystem::exists(folder / "report/kept/gpu-causes.png"));
}
