// verify --report: the page, and what a browser makes of it.
#include <nlohmann/json.hpp>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::test;

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

  CHECK(report_on(folder, {"--inject-fault", "light"}).code == 1);
  const auto failed = data_of(page_of(folder)).at("scenes").at(0);
  CHECK(failed.at("pictures").contains("twin"));
  CHECK(failed.at("causes").at("unexplained").at("pixels") > 20);
  CHECK(failed.at("pixels").at(0).at("outcome") == "unexplained");
  CHECK(failed.at("pixels").at(0).at("gpu").at("color").size() == 3);
  CHECK(failed.at("text").get<std::string>().starts_with("FAILED "));
  CHECK(std::filesystem::exists(folder / "report/kept/gpu.pfm"));
}

TEST_CASE("nothing that a scene is called ends the page's data") {
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
  REQUIRE(report_on(folder, {"--inject-fault", "light"}).code == 1);
  const auto shown = [&](const std::string& view) {
    const ProcessResult result =
        run_process({"chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--user-data-dir=" + (folder / "browser"), "--virtual-time-budget=5000", "--dump-dom",
                     "file://" + (folder / "report/index.html") + view},
                    {}, 600);
    CAPTURE(result.err);
    CHECK(result.code == 0);
    // What the script made, without the script.
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

TEST_CASE("the page's keys, slider, split, zoom and read-out do what the manual says" *
          doctest::test_suite("long")) {
  const SceneFolder folder;
  REQUIRE(report_on(folder, {"--inject-fault", "light"}).code == 1);
  const ProcessResult result =
      run_process({"node", "tests/cli/page/drive.mjs", folder / "report/index.html", folder.path()}, {}, 900);
  CAPTURE(result.err);
  CHECK(result.code == 0);
  for (const char* picture : {"light.png", "dark.png"})
    CHECK(std::filesystem::file_size(folder / picture) > 10'000);
}
