// verify with a folder of scenes.
#include <nlohmann/json.hpp>

#include "scene.hpp"
#include "tests/support/faults.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("verify takes every scene in a folder and below, except included parts") {
  const SceneFolder folder;
  std::filesystem::create_directories(folder / "sub/parts");
  write_text(folder / "sub/parts/ball.toml", small_scene);
  write_text(folder / "sub/whole.toml", "include = [\"parts/ball.toml\"]\n");
  write_text(folder / "notes.txt", "no scene");
  const auto verify = [&](std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"verify", folder.path(), "-s", "16x12", "--quiet", "--keep", folder / "kept"});
    return run_eyeray(options);
  };
  const ProcessResult passed = verify({"--junit", folder / "report.xml"});
  CAPTURE(passed.out);
  CHECK(passed.code == 0);
  CHECK(passed.out.starts_with("passed  " + folder.scene()));
  CHECK(passed.out.find(folder / "sub/whole.toml") != std::string::npos);
  CHECK(passed.out.find("ball.toml") == std::string::npos);
  CHECK(passed.out.find("\n2 scenes in ") != std::string::npos);
  CHECK(read_text(folder / "report.xml").find("tests=\"2\" failures=\"0\"") != std::string::npos);

  // A scene that cannot be rendered fails; the others are verified all the same.
  write_text(folder / "bad.toml", "sphere = 3\n");
  const ProcessResult failed = verify({"--json"});
  CHECK(failed.code == 1);
  const auto report = nlohmann::json::parse(failed.out);
  CHECK(report.at("scenes").size() == 3);
  CHECK(report.at("scenes")[0].at("verdict") == "failed");
  CHECK(report.at("scenes")[1].at("verdict") == "passed");
  CHECK(verify({"--allow-unverified", folder / "bad.toml"}).code == 0);
  CHECK(verify({"--allow-unverified", folder / "none.toml"}).code == 2);

  // A scene nested too deep for any stack does not end the program either.
  write_text(folder / "deep.toml", "a = " + std::string(200'000, '['));
  CHECK(verify({}).out.find("failed  " + (folder / "deep.toml")) != std::string::npos);
  std::filesystem::remove(folder / "deep.toml");
  CHECK(verify({"--json", "--github"}).code == 2);

  // If the bad scene is verified by its file's name, its error ends the program; a folder without scenes is
  // an error too.
  CHECK(run_eyeray({"verify", folder / "bad.toml"}).code == 2);
  std::filesystem::create_directories(folder / "empty");
  // Reports that were asked for name it as failed.
  for (const std::string name : {"bad.toml", "missing.toml", "empty"}) {
    CAPTURE(name);
    CHECK(run_eyeray({"verify", folder / name, "--junit", folder / (name + ".xml"), "--report",
                      folder / (name + ".page")})
              .code != 0);
    CHECK(read_text(folder / (name + ".xml")).find("tests=\"1\" failures=\"1\"") != std::string::npos);
    CHECK(read_text(folder / (name + ".page/index.html")).find(name) != std::string::npos);
  }

  // Alone in a folder, the bad scene is a failed scene of a suite, and gets reports. Names in them are not
  // markup.
  std::filesystem::create_directories(folder / "one");
  write_text(folder / "one/<!--<script>.toml", "sphere = 3\n");
  CHECK(run_eyeray({"verify", folder / "one", "--junit", folder / "one.xml", "--report", folder / "page"})
            .code == 1);
  CHECK(read_text(folder / "one.xml").find("tests=\"1\" failures=\"1\"") != std::string::npos);
  CHECK(read_text(folder / "page/index.html").find("<!--<script>") == std::string::npos);

  CHECK(run_eyeray({"verify", folder / "empty"}).err ==
        "eyeray: error: there is no scene in " + (folder / "empty") + "\n");
}

TEST_CASE("verify --github annotates failures and adds to the step's summary") {
  const SceneFolder folder;
  write_text(folder / "summary.md", "before\n");
  const ProcessResult result =
      run_eyeray({"verify", folder.scene(), "-s", "16x12", "--quiet", "--keep", folder / "kept", "--shaders",
                  lay_fault(folder, "light"), "--github"},
                 {{"GITHUB_STEP_SUMMARY", folder / "summary.md"}});
  CHECK(result.code == 1);
  CHECK(result.out.find("\n::error file=") != std::string::npos);
  CHECK(read_text(folder / "summary.md").starts_with("before\n### eyeray verify\n\n1 scene in "));
}
