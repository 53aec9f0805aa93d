// verify --report: the page, and its contents in a browser.
#include <nlohmann/json.hpp>

#include "scene.hpp"
#include "tests/support/faults.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

ProcessResult report_on(const SceneFolder& folder, std::vector<std::string> options = {}) {
  options.insert(options.begin(),
                 {"verify", folder.scene(), "-s", "16x12", "--quiet", "--report", folder / "report"});
  return run_eyeray(options);
}

std::string page_of(const SceneFolder& folder) {
  return read_text(folder / "report/index.html");
}

// The data that the page's script reads.
nlohmann::json data_of(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const size_t from = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

}  // namespace

TEST_CASE("the page of a report holds its pictures, numbers and the values of pixels that differ") {
  const SceneFolder folder;
  CHECK(report_on(folder).code == 0);
  const std::string page = page_of(folder);
  CHECK(page.find("http") == std::string::npos);  // needs no other file
  const auto scene = data_of(page).at("scenes").at(0);
  CHECK(scene.at("verdict") == "passed");
  for (const char* picture : {"gpu", "reference", "difference", "causes"})
    CHECK(scene.at("pictures").at(picture).get<std::string>().starts_with("data:image/png;base64,iVBOR"));
  CHECK_FALSE(scene.at("pictures").contains("twin"));  // bit for bit the GPU's
  CHECK(scene.at("pixels").empty());

  CHECK(report_on(folder, {"--shaders", lay_fault(folder, "light")}).code == 1);
  const auto failed = data_of(page_of(folder)).at("scenes").at(0);
  CHECK(failed.at("pictures").contains("twin"));
  CHECK(failed.at("causes").at("unexplained").at("pixels") > 20);
  CHECK(failed.at("pixels").at(0).at("outcome") == "unexplained");
  CHECK(failed.at("pixels").at(0).at("gpu").at("color").size() == 3);
  CHECK(failed.at("text").get<std::string>().starts_with("FAILED "));
  CHECK(std::filesystem::exists(folder / "report/kept/gpu.pfm"));
}

TEST_CASE("a report names the shaders of --shaders that differ") {
  const SceneFolder folder;
  const std::string shader = folder / "my/bsdf/fresnel.glsl";
  lay_shader(folder / "my", "bsdf/fresnel.glsl", own_shader("bsdf/fresnel.glsl"));
  const auto changed = [&] {
    report_on(folder, {"--shaders", folder / "my"});
    return data_of(page_of(folder)).at("scenes").at(0).at("changed_shaders");
  };
  CHECK(changed().empty());
  write_text(shader, read_text(shader) + "// changed\n");
  CHECK(changed() == nlohmann::json{shader});
}

TEST_CASE("the page of a report shows the golden picture as it was compared") {
  const SceneFolder folder;
  const auto golden_of = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"--against", folder / "golden.pfm", "--keep-passed"});
    CHECK(report_on(folder, options).code < 2);
    return data_of(page_of(folder)).at("scenes").at(0).at("pictures").value("golden", "none");
  };
  CHECK(golden_of({}) == "none");
  CHECK(golden_of({"--update"}) == "none");
  const std::string golden = golden_of({});
  CHECK(golden.starts_with("data:image/png;base64,iVBOR"));

  replace_in_file(folder.scene(), "0.8, 0.4, 0.2", "0.4, 0.8, 0.2");
  CHECK(golden_of({}) == golden);
  CHECK(golden_of({"--update"}) == golden);
  CHECK(golden_of({}) != golden);
  CHECK(golden_of({"--crop", "3,4,5,6"}) != "none");
  CHECK(std::filesystem::exists(folder / "report/kept/golden-difference.png"));
}

TEST_CASE("no name of a scene ends the page's data") {
  const SceneFolder folder;
  const std::string name = folder / "</script><b>.toml";
  std::filesystem::create_directories(std::filesystem::path(name).parent_path());
  write_text(name, small_scene);
  CHECK(run_eyeray({"verify", name, "-s", "16x12", "--quiet", "--report", folder / "report"}).code == 0);
  const std::string page = page_of(folder);
  CHECK(data_of(page).at("scenes").at(0).at("scene") == name);
  CHECK(page.find("<b>.toml") > page.find("<script type"));
}

TEST_CASE("a browser shows the page, and the view that its link names" * doctest::test_suite("long")) {
  const SceneFolder folder;
  REQUIRE(report_on(folder, {"--shaders", lay_fault(folder, "light")}).code == 1);
  const auto shown = [&](const std::string& view) {
    const ProcessResult result =
        run_process({"chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--user-data-dir=" + (folder / "browser"), "--virtual-time-budget=5000", "--dump-dom",
                     "file://" + (folder / "report/index.html") + view},
                    {}, 600);
    CAPTURE(result.err);
    CHECK(result.code == 0);
    // The page that the script made, without the script.
    return result.out.substr(0, result.out.find("<script"));
  };
  const auto pressed = [](const std::string& name) { return "aria-pressed=\"true\">" + name + " <"; };
  const std::string first = shown("");
  CAPTURE(first);
  CHECK(first.find("<span class=\"failed\">failed</span>") != std::string::npos);
  CHECK(first.find("Diagnosis: ") != std::string::npos);
  CHECK(first.find(" unexplained: ") != std::string::npos);
  CHECK(first.find(pressed("causes")) != std::string::npos);
  const std::string linked = shown("#0,twin,split,reference");
  for (const char* button : {"twin", "split", "reference"})
    CHECK(linked.find(pressed(button)) != std::string::npos);
}

TEST_CASE("the page's keys, slider, split, zoom and read-out work as the manual states" *
          doctest::test_suite("long")) {
  const SceneFolder folder;
  const std::string golden = folder / "golden.pfm";
  REQUIRE(
      run_eyeray({"render", folder.scene(), "-s", "16x12", "-D", "camera.fov=30", "-q", "-o", golden}).code ==
      0);
  REQUIRE(report_on(folder, {"--shaders", lay_fault(folder, "light"), "--against", golden}).code == 1);
  const ProcessResult result =
      run_process({"node", "tests/cli/page/drive.mjs", folder / "report/index.html", folder.path()}, {}, 900);
  CAPTURE(result.err);
  CHECK(result.code == 0);
  for (const char* picture : {"light.png", "dark.png"})
    CHECK(std::filesystem::file_size(folder / picture) > 10'000);
}
