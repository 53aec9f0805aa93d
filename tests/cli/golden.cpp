// verify --against and --update.
#include <nlohmann/json.hpp>

#include "scene.hpp"
#include "tests/support/faults.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("a golden picture is made on request, compared, and replaced if the scene's picture differs") {
  const SceneFolder folder;
  const std::string golden = folder / "golden/ball.pfm";
  const auto verify = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"verify", folder.scene(), "--quiet", "--keep", folder / "kept"});
    options.insert(options.end(), {"--against", golden});
    return run_eyeray(options);
  };

  const ProcessResult missing = verify({});
  CHECK(missing.code == 1);
  CHECK(missing.out.find("gate G: " + golden + ": there is no such picture; --update makes it") !=
        std::string::npos);
  const ProcessResult made = verify({"--update"});
  CHECK(made.code == 0);
  CHECK(made.out.find("  updated " + golden) != std::string::npos);
  const auto origin = nlohmann::json::parse(read_text(folder / "golden/ball.json"));
  CHECK(origin.at("scene") == folder.scene());
  CHECK(origin.at("size") == "64x48");
  CHECK(origin.at("samples") == 1);
  const ProcessResult same = verify({});
  CHECK(same.code == 0);
  CHECK(same.out.find("gate G passed golden = gpu, colours: 3072 equal, 0 matching") != std::string::npos);
  CHECK(verify({"--crop", "5,7,20,30"}).code == 0);

  // A golden picture that passes is left as it is, unless forced.
  const std::string first = read_text(golden);
  write_text(folder / "golden/ball.json", "{}");
  CHECK(verify({"--update"}).code == 0);
  CHECK(read_text(folder / "golden/ball.json") == "{}");
  CHECK(verify({"--update=force"}).code == 0);
  CHECK(read_text(folder / "golden/ball.json") != "{}");

  // A scene that has changed: each of its own gates passes.
  replace_in_file(folder.scene(), "0.8, 0.4, 0.2", "0.8, 0.41, 0.2");
  const ProcessResult changed = verify({"--json"});
  CHECK(changed.code == 1);
  const auto report = nlohmann::json::parse(changed.out).at("scenes")[0];
  CHECK(report.at("failures").size() == 1);
  CHECK(report.at("diagnosis").get<std::string>().starts_with("the scene's own gates pass"));
  CHECK(std::filesystem::exists(folder / "kept/golden-difference.png"));
  CHECK(report.at("gate_g").at("changed") == nlohmann::json::array({"scene hash"}));
  CHECK(report.at("gate_g").at("colors").at("unexplained") > 100);
  CHECK(read_text(golden) == first);
  CHECK(verify({"--update"}).code == 0);
  CHECK(read_text(golden) != first);
  CHECK(verify({}).code == 0);

  // Pictures of different sizes cannot be compared.
  CHECK(verify({"-s", "32x24"})
            .out.find("gate G: " + golden + ": it has 64×48 pixels, but the scene's picture has 32×24") !=
        std::string::npos);
}

TEST_CASE("a picture that fails, or is black, becomes no golden picture") {
  const SceneFolder folder;
  const std::string golden = folder / "ball.pfm";
  const auto verify = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"verify", folder.scene(), "-s", "16x12", "--quiet", "--keep",
                                     folder / "kept", "--against", golden});
    return run_eyeray(options);
  };
  const ProcessResult broken = verify({"--update=force", "--shaders", lay_fault(folder, "light")});
  CHECK(broken.code == 1);
  CHECK(broken.out.find("it was not updated: another gate fails") != std::string::npos);
  CHECK(!std::filesystem::exists(golden));

  std::string dark = replaced(small_scene, "[0.25, 0.5, 0.75]", "[0, 0, 0]");
  dark = replaced(replaced(dark, "[0.2, 0.2, 0.2]", "[0, 0, 0]"), "[20, 20, 20]", "[0, 0, 0]");
  write_text(folder.scene(), dark);
  const ProcessResult black = verify({"--update"});
  CHECK(black.code == 1);
  CHECK(black.out.find("it was not updated: the picture is black") != std::string::npos);
  CHECK(!std::filesystem::exists(golden));

  // A damaged golden picture is a file error, and is left as it is.
  write_text(golden, "PF\n16 12\n");
  CHECK(verify({"--update"}).code == 4);
  CHECK(read_text(golden) == "PF\n16 12\n");
}

TEST_CASE("several scenes share a folder of golden pictures") {
  const SceneFolder folder;
  write_text(folder / "b.toml", small_scene);
  const auto verify = [&](const std::string& against, std::vector<std::string> options) {
    options.insert(options.begin(), {"verify", folder.path(), "-s", "16x12", "--quiet", "--keep",
                                     folder / "kept", "--against", against});
    return run_eyeray(options);
  };
  CHECK(verify(folder / "golden", {"--update"}).code == 0);
  int pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "golden"))
    pictures += entry.path().extension() == ".pfm";
  CHECK(pictures == 2);
  CHECK(verify(folder / "golden", {}).code == 0);

  CHECK(verify(folder / "one.pfm", {}).code == 2);
  CHECK(run_eyeray({"verify", folder.scene(), "--update"}).code == 2);
  CHECK(run_eyeray({"verify", folder.scene(), "--update=often", "--against", folder / "a.pfm"}).code == 2);
  CHECK(verify(folder / "golden", {"--update", "--crop", "0,0,4,4"}).code == 2);
}
