// Runs the commands of .github/actions/verify as GitHub would.
#include <filesystem>

#include "scene.hpp"
#include "tests/support/faults.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

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

TEST_CASE("the CI recipe verifies on lavapipe, and leaves a report whatever the result") {
  const SceneFolder folder;
  const std::string here = std::filesystem::current_path();
  const auto run = [&](const std::string& options) {
    return run_process({"sh", "-euc", step()},
                       {{"GITHUB_ACTIONS", "true"},
                        {"GITHUB_ACTION_PATH", here + "/.github/actions/verify"},
                        {"GITHUB_STEP_SUMMARY", folder / "summary.md"},
                        {"EYERAY_BINARY", eyeray_binary()},
                        {"BUNDLE", ""},
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

  const ProcessResult failed = run("-s 16x12 --shaders " + lay_fault(folder, "light"));
  CHECK(failed.code == 1);
  CHECK(failed.out.find("\n::error file=") != std::string::npos);
  CHECK(read_text(folder / "summary.md").find("| failed |") != std::string::npos);
  CHECK(std::filesystem::exists(folder / "report/index.html"));
  CHECK(std::filesystem::exists(folder / "report/kept/gpu-causes.png"));
}

TEST_CASE("the CI recipe runs a given archive on the archive's driver, and builds nothing") {
  const SceneFolder folder;
  const std::string archive = folder / "eyeray-0.1.0";
  for (const char* name : {"bin", "share/vulkan/icd.d"})
    std::filesystem::create_directories(archive + "/" + name);
  std::filesystem::copy("scripts/verify-in-ci", archive + "/bin/verify-in-ci");
  write_text(archive + "/share/vulkan/icd.d/lvp_icd.json", "");
  write_text(archive + "/bin/eyeray",
             "#!/bin/sh\necho \"$VK_DRIVER_FILES $*\" >>\"$REPORT.calls\"\n"
             "echo '{\"driver\":\"llvmpipe\",\"usable\":true}'\n");
  std::filesystem::permissions(archive + "/bin/eyeray", std::filesystem::perms::owner_all);
  REQUIRE(run_process({"tar", "-czf", folder / "eyeray.tar.gz", "-C", folder.path(), "eyeray-0.1.0"}, {}, 60)
              .code == 0);

  const ProcessResult run = run_process({"sh", "-euc", step()},
                                        {{"GITHUB_ACTION_PATH", "/nowhere"},
                                         {"RUNNER_TEMP", folder / "temp"},
                                         {"EYERAY_BINARY", ""},
                                         {"BUNDLE", folder / "eyeray.tar.gz"},
                                         {"SCENES", "a.toml"},
                                         {"OPTIONS", "-s 16x12"},
                                         {"REPORT", folder / "report"}},
                                        60);
  CAPTURE(run.err);
  CHECK(run.code == 0);
  const std::string calls = read_text(folder / "report.calls");
  CAPTURE(calls);
  CHECK(calls.find("/share/vulkan/icd.d/lvp_icd.json devices --json\n") != std::string::npos);
  CHECK(calls.find(" verify --quiet ") != std::string::npos);
  CHECK(calls.find(" a.toml -s 16x12\n") != std::string::npos);
  CHECK(calls.starts_with(std::string(folder / "temp") + "/eyeray/"));
}
