// Every message that a scene's author may see: NAME.toml is the scene, and NAME.txt is exactly the printed
// text.
#include <fstream>
#include <iterator>
#include <set>

#include "host/loader/scene_file.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

namespace {

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The scenes in tests/loader/FOLDER, sorted.
std::set<std::filesystem::path> scenes_in(const std::string& folder) {
  std::set<std::filesystem::path> scenes;
  for (const auto& entry : std::filesystem::directory_iterator("tests/loader/" + folder)) {
    if (entry.path().extension() == ".toml") scenes.insert(entry.path());
  }
  return scenes;
}

std::string expected_for(std::filesystem::path scene) {
  return read(scene.replace_extension(".txt"));
}

}  // namespace

TEST_CASE("a wrong scene is refused with all of its errors") {
  const auto scenes = scenes_in("rejected");
  REQUIRE(scenes.size() >= 20);
  for (const auto& scene : scenes) {
    CAPTURE(scene);
    std::string text;
    try {
      parse_scene(read(scene), "scene.toml");
    } catch (const InputError& error) {
      CHECK(error.code() == ExitCode::bad_input);
      text = std::string(error.what()) + "\n";
    }
    CHECK(text == expected_for(scene));
  }
}

TEST_CASE("a scene that is legal but probably not intended is loaded with warnings") {
  const auto scenes = scenes_in("warned");
  REQUIRE(scenes.size() >= 2);
  for (const auto& scene : scenes) {
    CAPTURE(scene);
    std::string text;
    for (const Diagnostic& warning : parse_scene(read(scene), "scene.toml").warnings) {
      CHECK(warning.severity == Severity::warning);
      text += format_diagnostic(warning) + "\n";
    }
    CHECK(text == expected_for(scene));
  }
}
