// Names and values are shown so that no line is a command to a terminal or to GitHub's workflows, and JSON
// can be read; reports in files hide no characters. The table lists each output that shows a text of a file,
// a name or the command line.
#include <functional>
#include <nlohmann/json.hpp>

#include "host/core/diagnostic.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/github_text.hpp"
#include "host/image/image_writer.hpp"
#include "scene.hpp"
#include "tests/support/nasty_strings.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

using Words = std::vector<std::string>;

// A file whose name holds the text.
std::string file_named(const SceneFolder& folder, const std::string& text, const std::string& ending,
                       const std::string& content) {
  const std::filesystem::path path = folder / ("x" + text + ending);
  std::filesystem::create_directories(path.parent_path());
  write_text(path, content);
  return path;
}

std::string name_of(const SceneFolder& folder, const std::string& text, const std::string& ending) {
  const std::string name = file_named(folder, text, ending, "");
  std::filesystem::remove(name);
  return name;
}

// The small scene with `before` replaced by `after`.
std::string scene_with(const SceneFolder& folder, const std::string& before, const std::string& after) {
  replace_in_file(folder.scene(), before, after);
  return folder.scene();
}

std::string scene_and(const SceneFolder& folder, const std::string& more) {
  write_text(folder.scene(), small_scene + more);
  return folder.scene();
}

std::string broken_scene_named(const SceneFolder& folder, const std::string& text) {
  return file_named(folder, text, ".toml", replaced(small_scene, "width = 64", "width = " + text));
}

std::string picture_named(const SceneFolder& folder, const std::string& text) {
  return file_named(folder, text, ".pfm", std::string("Pf\n1 1\n-1\n\0\0\0\0", 15));
}

std::string exr_with_layer(const SceneFolder& folder, const std::string& layer) {
  image::ImageWriter writer(folder / "layers.exr", 1, 1,
                            {{"R"}, {"G"}, {"B"}, {layer.substr(0, layer.find('\0')) + ".Y"}});
  writer.write(image::Image(1, 1, 4));
  writer.finish();
  return folder / "layers.exr";
}

std::string mesh_scene(const SceneFolder& folder, const std::string& file, const std::string& content) {
  write_text(folder / file, content);
  return scene_and(folder, "[[mesh]]\nmaterial = \"matte\"\nfile = " + toml_string(file) + "\n");
}

std::string gltf(const std::string& text) {
  const nlohmann::json json{{"asset", {{"version", "2.0"}}},
                            {text, 1},
                            {"extensionsUsed", {text}},
                            {"extensionsRequired", {text}},
                            {"materials", {{{"name", text}, {text, 1}}}},
                            {"nodes", {{{"name", text}}}},
                            {"scenes", {{{"nodes", {0}}}}}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

struct Case {
  std::string name;
  // Returns the words of a command that shows the text, and makes the files that the command reads.
  std::function<Words(const SceneFolder&, const std::string& text)> words;
};

const Words small = {"-s", "8x6", "--backend", "twin", "--quiet"};

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

#define CASE(name, ...)                                                                                     \
  Case {                                                                                                    \
    name,                                                                                                   \
        [](const SceneFolder& folder, const std::string& text) { return (void)folder, Words(__VA_ARGS__); } \
  }

const Case cases[] = {
    // Names of files.
    CASE("check: its scene", {"check", file_named(folder, text, ".toml", small_scene)}),
    CASE("check --json: its scene", {"check", file_named(folder, text, ".toml", small_scene), "--json"}),
    CASE("check: a scene that is wrong", {"check", broken_scene_named(folder, text)}),
    CASE("check --json: a scene that is wrong", {"check", broken_scene_named(folder, text), "--json"}),
    CASE("render: its picture",
         {"render", folder.scene(), "-s", "8x6", "--backend", "twin", "-o", name_of(folder, text, ".png")}),
    CASE("render --json: its picture",
         Words{"render", folder.scene(), "--json", "-o", name_of(folder, text, ".png")} + small),
    CASE("render: a name without an ending", {"render", folder.scene(), "-o", name_of(folder, text, "")}),
    CASE("render: a checkpoint that is there",
         {"render", folder.scene(), "--checkpoint", file_named(folder, text, ".work", "")}),
    CASE("render: a checkpoint that is none",
         {"render", folder.scene(), "--resume", file_named(folder, text, ".work", "")}),
    CASE("render: frames",
         {"render", folder.scene(), "--frames", "0:1", "-o", name_of(folder, text, ".png")}),
    CASE("merge: a part that is none",
         {"merge", file_named(folder, text, ".eyeray", "EYERAY"), "-o", folder / "a.png"}),
    CASE("merge --check: parts of a scene",
         [&] {
           run_eyeray(Words{"render", file_named(folder, text, ".toml", small_scene), "--shard", "1/1", "-o",
                            folder / "part.eyeray"} +
                      small);
           return Words{"merge", "--check", folder / "part.eyeray"};
         }()),
    CASE("compare: pictures", {"compare", picture_named(folder, text), picture_named(folder, text)}),
    CASE("compare: one that is not there",
         {"compare", picture_named(folder, text), name_of(folder, text, ".png")}),
    CASE("probe: its scene", {"probe", file_named(folder, text, ".toml", small_scene), "4,3", "-s", "8x6",
                              "--backends", "twin,reference"}),
    CASE("probe --json: its scene", {"probe", file_named(folder, text, ".toml", small_scene), "4,3", "-s",
                                     "8x6", "--backends", "twin,reference", "--json"}),
    CASE("verify: scenes that are wrong",
         {"verify", broken_scene_named(folder, text), broken_scene_named(folder, text + "2"), "--junit",
          folder / "junit.xml", "--report", folder / "page", "--json"}),
    CASE("verify: a golden picture",
         {"verify", file_named(folder, text, ".toml", small_scene), "-s", "8x6", "--backends", "twin",
          "--against", name_of(folder, text, ".pfm"), "--update"}),
    CASE(
        "verify: a difference",
        {"verify", file_named(folder, text, ".toml", small_scene), "-s", "8x6", "--backends", "twin",
         "--against", file_named(folder, text, ".pfm", std::string("PF\n8 6\n-1\n") + std::string(576, '\0')),
         "--junit", folder / "junit.xml", "--report", folder / "page", "--keep", folder / "kept"}),
    CASE("new: its folder", {"new", name_of(folder, text, "")}),
    CASE("new: a folder with other files",
         [&] {
           const std::string name = name_of(folder, text, "");
           run_eyeray({"new", name});
           return Words{"new", name};
         }()),
    CASE("new --json: its folder", {"new", name_of(folder, text, ""), "--json"}),
    CASE("generate: its scene",
         {"generate", "sphereflake", "--size-factor", "1", "-o", name_of(folder, text, ".toml")}),
    CASE("generate: a file of somebody else",
         {"generate", "sphereflake", "--size-factor", "1", "-o", file_named(folder, text, ".toml", "mine")}),
    CASE("shaders: the folder of an export", {"shaders", "--export", name_of(folder, text, "")}),
    CASE("slurm: its folder", {"slurm", folder.scene(), "--folder", file_named(folder, text, "/x", "")}),
    CASE("manual: its folder", {"manual", file_named(folder, text, "", "")}),
    CASE("dev: its scene and picture",
         Words{"dev", file_named(folder, text, ".toml", small_scene), "--once", "--no-page", "-s", "8x6",
               "--backend", "twin", "-o", name_of(folder, text, ".png")}),
    CASE("dev --json: its scene", Words{"dev", file_named(folder, text, ".toml", small_scene), "--once",
                                        "--no-page", "-s", "8x6", "--backend", "twin", "--json"}),
    CASE("dev: a scene that is wrong",
         {"dev", broken_scene_named(folder, text), "--once", "--no-page", "--json"}),
    CASE("dev --diagnostics json",
         {"dev", broken_scene_named(folder, text), "--once", "--no-page", "--diagnostics", "json"}),
    // Text in files.
    CASE("names of a scene",
         {"check", scene_with(folder, "[[sphere]]\n", "[[sphere]]\nname = " + toml_string(text) + "\n")}),
    CASE("names of a scene, in JSON",
         {"check", scene_with(folder, "[[sphere]]\n", "[[sphere]]\nname = " + toml_string(text) + "\n"),
          "--json"}),
    CASE("names of a scene, in a legend",
         Words{"render", scene_with(folder, "[[sphere]]\n", "[[sphere]]\nname = " + toml_string(text) + "\n"),
               "--aov", "primitive", "-o", folder / "a.png"} +
             small),
    CASE("names of a scene, in a probe",
         {"probe", scene_with(folder, "[[sphere]]\n", "[[sphere]]\nname = " + toml_string(text) + "\n"),
          "4,3", "-s", "8x6", "--backends", "twin,reference"}),
    CASE("an unknown key",
         {"check", scene_with(folder, "width = 64", "width = 64\n" + toml_string(text) + " = 1")}),
    CASE("an unknown table", {"check", scene_and(folder, "[[" + toml_string(text) + "]]\n")}),
    CASE("an unknown value", {"check", scene_with(folder, "\"point\"", toml_string(text))}),
    CASE("an unknown material",
         {"check", scene_with(folder, "material = \"matte\"", "material = " + toml_string(text))}),
    CASE("a file that is not there",
         {"check", scene_and(folder, "[[mesh]]\nfile = " + toml_string(text + ".obj") + "\n")}),
    CASE("no TOML", {"check", scene_and(folder, text)}),
    CASE("a formula",
         {"check", scene_and(folder, "[[implicit]]\ncode = " +
                                         toml_string("float f(vec3 p) { return " + text + "; }") +
                                         "\nmin = [-1, -1, -1]\nmax = [1, 1, 1]\nmaterial = \"matte\"\n")}),
    CASE("OBJ", {"check", mesh_scene(folder, "a.obj",
                                     "mtllib " + text + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl " + text + "\n" +
                                         text + "\nf 1 2 3\n")}),
    CASE("PLY", {"check", mesh_scene(folder, "a.ply",
                                     "ply\nformat ascii 1.0\ncomment TextureFile " + text + "\nelement " +
                                         text + " 1\n" + text + "\nend_header\n")}),
    CASE("glTF", {"check", mesh_scene(folder, "a.gltf", gltf(text))}),
    CASE("layers of OpenEXR",
         {"compare", exr_with_layer(folder, text), exr_with_layer(folder, text), "--layer", "none"}),
    // The command line.
    CASE("an unknown command", {text}),
    CASE("an unknown option", {"render", "--" + text}),
    CASE("one argument too many", {"check", folder.scene(), "x" + text}),
    CASE("-D", {"check", folder.scene(), "-D", text}),
    CASE("-D with a value", {"check", folder.scene(), "-D", "image.width=" + text}),
    CASE("--size", {"check", folder.scene(), "-s", "x" + text}),
    CASE("--integrator", {"check", folder.scene(), "--integrator", "x" + text}),
    CASE("--backend", {"render", folder.scene(), "--backend", "x" + text}),
    CASE("--aov", {"render", folder.scene(), "--aov", "x" + text, "-o", folder / "a.png"}),
    CASE("--crop", {"render", folder.scene(), "--crop", "x" + text, "-o", folder / "a.png"}),
    CASE("--frames", {"render", folder.scene(), "--frames", "x" + text, "-o", folder / "a%d.png"}),
    CASE("--shaders", {"render", folder.scene(), "--shaders", "x" + text}),
    CASE("--sanitize", {"render", folder.scene(), "--sanitize", "x" + text}),
    CASE("--layer",
         {"compare", picture_named(folder, "a"), exr_with_layer(folder, "a"), "--layer", "x" + text}),
    CASE("a pixel", {"probe", folder.scene(), "x" + text}),
    CASE("a shader", {"shaders", "x" + text}),
    CASE("a shell", {"completion", "x" + text}),
    CASE("--allow-unverified", {"verify", folder.scene(), "--allow-unverified", "x" + text}),
};

void check_lines(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) CHECK(line == log_line(line));
}

// Checks the reports that the command wrote: JSON by the rules of lines, XML and HTML for hidden characters.
void check_files(const SceneFolder& folder) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
    const std::string ending = entry.path().extension();
    if (ending == ".json") check_lines(read_text(entry.path()));
    if (ending != ".xml" && ending != ".html") continue;
    CAPTURE(ending);
    std::istringstream lines(read_text(entry.path()));
    for (std::string line; std::getline(lines, line);) CHECK(line == printable(line));
  }
}

void check_cases(const std::vector<std::string>& texts) {
  for (const Case& each : cases) {
    CAPTURE(each.name);
    for (const std::string& text : texts) {
      if (text.find('\0') != std::string::npos) continue;  // neither a name nor a word holds it
      CAPTURE(text);
      const SceneFolder folder;
      const Words words = each.words(folder, text);
      const ProcessResult result = run_eyeray(words);
      CAPTURE(result.out);
      CAPTURE(result.err);
      CHECK(result.code >= 0);
      CHECK(result.code <= int(ExitCode::cannot_resume));
      check_lines(result.err);
      check_lines(result.out);
      if (std::ranges::find(words, "--json") != words.end()) {
        std::istringstream lines(result.out);
        for (std::string line; std::getline(lines, line);) CHECK(nlohmann::json::accept(line));
      }
      check_files(folder);
    }
  }
}

}  // namespace

TEST_CASE("no text that eyeray shows acts as a command") {
  check_cases({"##[a]\n::error::b", "\x1b[2J\"'", "\xff</x>"});
}

TEST_CASE("none of forty texts that eyeray shows acts as a command" * doctest::test_suite("long")) {
  check_cases(nasty_strings);
}

TEST_CASE("an error of dev is one command of GitHub's workflows, whatever the scene's name" *
          doctest::test_suite("long")) {
  for (const std::string& text : nasty_strings) {
    if (text.find('\0') != std::string::npos) continue;
    CAPTURE(text);
    const SceneFolder folder;
    const ProcessResult result = run_eyeray(
        {"dev", broken_scene_named(folder, text), "--once", "--no-page", "--diagnostics", "github"});
    CAPTURE(result.err);
    std::istringstream lines(result.err);
    int errors = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line == log_line(line)) continue;
      ++errors;
      CHECK(line.starts_with("::error file="));
      CHECK(line.find("::", 2) == line.find("::", line.find(",col=")));
    }
    CHECK(errors > 0);
  }
}

TEST_CASE("generate writes a scene that names its mesh, whatever the mesh's name" *
          doctest::test_suite("long")) {
  for (const std::string& text : nasty_strings) {
    if (text.find('\0') != std::string::npos) continue;
    CAPTURE(text);
    const SceneFolder folder;
    const std::string scene = name_of(folder, text, ".toml");
    const ProcessResult result = run_eyeray({"generate", "terrain", "--triangles", "8", "-o", scene});
    CAPTURE(result.err);
    if (text == printable(text)) {
      CHECK(result.code == 0);
      CHECK(run_eyeray({"check", scene}).code == 0);
    } else {
      CHECK(result.code == 2);
      CHECK(result.err.find("UTF-8") != std::string::npos);
      CHECK_FALSE(std::filesystem::exists(scene));
    }
  }
}

TEST_CASE("commands that messages show can be pasted into a shell" * doctest::test_suite("long")) {
  for (const std::string& text : nasty_strings) {
    if (text.find('\0') != std::string::npos || text != log_line(text) || text.find('/') != std::string::npos)
      continue;
    CAPTURE(text);
    const SceneFolder folder;
    const std::string name = folder / text;
    const ProcessResult made = run_eyeray({"new", name});
    REQUIRE(made.code == 0);
    const size_t at = made.err.find("\n  eyeray dev ");
    REQUIRE(at != std::string::npos);
    const ProcessResult read = run_process({"sh", "-c", "printf %s " + made.err.substr(at + 14)});
    CHECK(read.out == name + "/scene.toml");
  }
}
