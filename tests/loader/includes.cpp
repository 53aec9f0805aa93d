// Scenes in several files.
#include <fstream>

#include "folder.hpp"
#include "host/loader/scene_file.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
namespace fs = std::filesystem;

namespace {

using test::Folder;

std::string refusal(const std::string& scene) {
  try {
    load_scene(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

const std::string material = "[[material]]\nname = \"m\"\ntype = \"phong\"\n";
std::string sphere(double radius) {
  return fmt::format("[[sphere]]\ncenter = [0, 0, 0]\nradius = {}\nmaterial = \"m\"\n", radius);
}

}  // namespace

TEST_CASE("included shapes come first; the including file's settings win") {
  const Folder folder;
  const std::string main =
      folder.write("main.toml", "include = ['parts/a.toml', 'b.toml']\n[image]\nwidth = 1\n" + sphere(1));
  const std::string a =
      folder.write("parts/a.toml", "include = \"c.toml\"\n[image]\nwidth = 2\nheight = 2\n" + sphere(2));
  const std::string c =
      folder.write("parts/c.toml", "[image]\nheight = 3\nsamples = 9\n" + material + sphere(3));
  const std::string b =
      folder.write("b.toml", "include = \"parts/c.toml\"\n[image]\nheight = 4\n" + sphere(4));
  const Scene scene = load_scene(main);
  CHECK(scene.image.width == 1);
  CHECK(scene.image.height == 4);
  CHECK(scene.image.samples == 9);
  CHECK(scene.file == main);
  CHECK(scene.files == std::vector<fs::path>{main, a, c, b});  // c once, though two include it
  REQUIRE(scene.shapes.size() == 4);
  for (size_t i = 0; i < 4; ++i) CHECK(scene.shapes[i]->bounds().max.x == std::array{3.0, 2.0, 4.0, 1.0}[i]);
  CHECK(scene.shapes[0]->position.file == c);
}

TEST_CASE("errors of all files are reported together, each at its position") {
  const Folder folder;
  const std::string main = folder.write("main.toml", "include = 'a.toml'\n[image]\nwidth = 0\n");
  const std::string a = folder.write("a.toml", "[image]\nheight = 0\n" + material + material);
  CHECK(refusal(main) ==
        main + ":3:9: error: `width` must be an integer from 1 to 65536, not 0\n  width = 0\n          ^\n" +
            a +
            ":2:10: error: `height` must be an integer from 1 to 65536, not 0\n  height = 0\n           ^\n" +
            a + ":7:8: error: material \"m\" is defined twice; the first is at " + a +
            ":3\n  name = \"m\"\n         ^");
}

TEST_CASE("a file that includes itself is refused") {
  const Folder folder;
  const std::string main = folder.write("main.toml", "include = 'a.toml'");
  folder.write("a.toml", "include = 'b/../b.toml'");
  folder.write("b.toml", "include = 'main.toml'");
  fs::create_directory(folder.path() / "b");
  CHECK(refusal(main).find(
            "b.toml:1:11: error: main.toml includes itself: main.toml → a.toml → b.toml → main.toml") !=
        std::string::npos);
}

TEST_CASE("includes are nested up to a limit") {
  const Folder folder;
  for (int i = 0; i < 30; ++i) {
    folder.write(fmt::format("{}.toml", i), i < 29 ? fmt::format("include = '{}.toml'", i + 1) : "");
  }
  CHECK(refusal(folder / "13.toml") == "accepted");
  CHECK(refusal(folder / "0.toml").find("16.toml:1:11: error: includes are nested more than 16 deep") !=
        std::string::npos);
}

TEST_CASE("includes stay in the scene's folder tree, unless others are allowed") {
  const Folder folder;
  folder.write("outside.toml", material);
  folder.write("scene-b/outside.toml", material);
  fs::create_directory(folder.path() / "scene");
  fs::create_symlink(folder / "outside.toml", folder / "scene/link.toml");
  fs::create_directory_symlink(folder.path(), folder.path() / "scene/tree");
  const std::string names[] = {"../outside.toml",        folder / "outside.toml", "link.toml",
                               "tree/outside.toml",      "a/../../outside.toml",  "/etc/passwd",
                               "../scene-b/outside.toml"};
  for (const std::string& name : names) {
    CAPTURE(name);
    const std::string scene = folder.write("scene/main.toml", "include = '" + name + "'");
    CHECK(
        refusal(scene).find(name + " lies outside the scene's folder; --allow-path DIR allows other ones") !=
        std::string::npos);
    if (name == "/etc/passwd") continue;
    CHECK(load_scene(scene, {}, {.folders = {folder.path()}}).materials.size() == 1);
  }
}

TEST_CASE("an include that cannot be read is an error at its name") {
  const Folder folder;
  folder.write("parts.toml", "");
  const std::string main = folder.write("main.toml", "include = [\n  'part.toml',\n  '.',\n  '',\n]");
  const std::string message = refusal(main);
  CHECK(message.find(main + ":2:3: error: cannot read the scene " + (folder / "part.toml") +
                     ": No such file or directory; did you mean " + (folder / "parts.toml") + "?") !=
        std::string::npos);
  CHECK(message.find(":3:3: error: cannot read the scene ") != std::string::npos);
  CHECK(message.find("it is a folder") != std::string::npos);
  CHECK(message.find(main + ":4:3: error: `include` needs the name of a file") != std::string::npos);
  CHECK(refusal(folder.write("list.toml", "include = ['parts.toml', 3]"))
            .find("`include` must be a file name or a list of them") != std::string::npos);
}
