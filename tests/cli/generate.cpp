// eyeray generate writes scenes that eyeray reads, whole or not at all.
#include <nlohmann/json.hpp>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("a generated sphereflake is a scene, the same every time") {
  const TemporaryFolder folder;
  const std::string scene = folder / "balls.toml";
  const ProcessResult made = run_eyeray({"generate", "sphereflake", "-o", scene, "--json"});
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
  const auto summary = nlohmann::json::parse(made.out);
  CHECK(summary.at("spheres") == 7381);
  CHECK(summary.at("bytes") == std::filesystem::file_size(scene));
  const std::string text = read_text(scene);
  CHECK(text.starts_with("# Made by eyeray generate: sphereflake --size-factor 4\n"));

  const ProcessResult check = run_eyeray({"check", scene, "--json"});
  CHECK(check.code == 0);
  CHECK(check.err == "");
  CHECK(check.out.find("7381") != std::string::npos);

  // It overwrites files that it made itself.
  CHECK(run_eyeray({"generate", "sphereflake", "-o", scene}).code == 0);
  CHECK(read_text(scene) == text);
  // It overwrites them under the model's first name too.
  CHECK(run_eyeray({"generate", "balls", "-o", scene}).code == 0);
  CHECK(read_text(scene) == text);
  CHECK(folder.names() == std::set<std::string>{"balls.toml"});
}

TEST_CASE("generated meshes lie beside their scene, and have the reported size") {
  const TemporaryFolder folder;
  const ProcessResult flake = run_eyeray({"generate", "sphereflake", "-o", folder / "flake.toml",
                                          "--size-factor", "2", "--triangles", "10000", "--json"});
  REQUIRE(flake.code == 0);
  CHECK(nlohmann::json::parse(flake.out).at("triangles") == 91 * 8 * 16);
  CHECK(
      read_text(folder / "flake.toml").ends_with("\n[[mesh]]\nfile = \"flake.ply\"\nmaterial = \"ball\"\n"));

  const ProcessResult terrain =
      run_eyeray({"generate", "terrain", "-o", folder / "alps.toml", "--grid", "20", "--json"});
  REQUIRE(terrain.code == 0);
  const auto summary = nlohmann::json::parse(terrain.out);
  CHECK(summary.at("mesh") == folder / "alps.ply");
  CHECK(summary.at("vertices") == 441);
  CHECK(summary.at("triangles") == 800);
  CHECK(summary.at("bytes") ==
        std::filesystem::file_size(folder / "alps.ply") + std::filesystem::file_size(folder / "alps.toml"));
  CHECK(read_text(folder / "alps.toml").find("file = \"alps.ply\"") != std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"alps.ply", "alps.toml", "flake.ply", "flake.toml"});
}

TEST_CASE("a scene that cannot be generated is refused in one line, and leaves no file") {
  const SceneFolder folder;
  struct Refusal {
    std::vector<std::string> arguments;
    int code;
    std::string message;
  };
  const std::string scene = folder.scene(), fresh = folder / "fresh.toml";
  const Refusal refusals[] = {
      {{"sphereflake", "-o", scene},
       4,
       scene + " exists and was not made by eyeray generate; --force overwrites it"},
      {{"sphereflake", "-o", folder / "a.tml"}, 2, folder / "a.tml" + ": a scene's name must end in .toml"},
      {{"sphereflake", "-o", fresh, "--size-factor", "7"},
       2,
       "size factor 7 makes 5380840 spheres, too many for a scene file; the largest size factor is 6, or let "
       "--tessellate make a mesh"},
      {{"sphereflake", "-o", fresh, "--size-factor", "8", "--tessellate", "2"},
       2,
       "the mesh would have 1549681952 triangles; at most 536870912 are allowed"},
      {{"terrain", "-o", fresh, "--triangles", "600000000"},
       2,
       "--triangles must be a whole number from 1 to 536870912, not '600000000' (see eyeray generate terrain "
       "--help)"},
      {{"terrain", "-o", fresh, "--trangles", "6"},
       2,
       "unknown option '--trangles'; did you mean '--triangles'? (see eyeray generate terrain --help)"},
      {{"terain"}, 2, "unknown command 'terain'; did you mean 'terrain'? (see eyeray generate --help)"},
      {{"terrain", "-o", "/no/such/folder/a.toml"},
       4,
       "cannot write /no/such/folder/a.toml: No such file or directory"},
  };
  for (const Refusal& refusal : refusals) {
    std::vector<std::string> arguments{"generate"};
    arguments.insert(arguments.end(), refusal.arguments.begin(), refusal.arguments.end());
    const ProcessResult result = run_eyeray(arguments);
    CHECK(result.code == refusal.code);
    CHECK(result.out == "");
    CHECK(result.err == "eyeray: error: " + refusal.message + "\n");
  }
  CHECK(read_text(scene) == small_scene);
  CHECK(folder.names() == std::set<std::string>{"scene.toml"});
  CHECK(run_eyeray({"generate", "sphereflake", "-o", scene, "--size-factor", "1", "--force"}).code == 0);
}

TEST_CASE("generate without a subcommand shows its help") {
  const ProcessResult result = run_eyeray({"generate"});
  CHECK(result.code == 2);
  CHECK(result.out == "");
  CHECK(result.err.find("Usage: eyeray generate") != std::string::npos);
  CHECK(result.err.find("sphereflake") != std::string::npos);
}

TEST_CASE("Ctrl-C leaves nothing") {
  const TemporaryFolder folder;
  const ProcessResult result =
      run_eyeray({"generate", "terrain", "-o", folder / "a.toml", "--grid", "16384"}, {}, 60, 700);
  CHECK(result.code == 130);
  CHECK(result.err.starts_with("eyeray: error: interrupted"));
  CHECK(folder.names().empty());
}
