// Images that a scene names: the folders where they may lie, their textures, and the messages for files that
// are not images.
#include <sys/stat.h>

#include "host/core/atomic_file.hpp"
#include "host/loader/image_files.hpp"
#include "host/loader/scene_file.hpp"
#include "host/scene/image_texture_file.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::image;
namespace fs = std::filesystem;

namespace {

// red    green  blue
// black  white  (64, 128, 192)
const char* picture = "tests/image/pictures/rgb.png";

// A folder with a picture at `name`, and scenes that use it.
class Folder : public test::TemporaryFolder {
 public:
  explicit Folder(const std::string& name = "a.png") { copy(name); }

  std::string copy(const std::string& name) const {
    fs::create_directories((path() / name).parent_path());
    fs::copy_file(picture, path() / name);
    return path() / name;
  }
  std::string write(const std::string& name, const std::string& text) const {
    fs::create_directories((path() / name).parent_path());
    test::write_text(path() / name, text);
    return path() / name;
  }
};

// A scene with a material whose `diffuse` is that text.
std::string scene_with(const std::string& diffuse) {
  return "[[material]]\nname = \"m\"\ntype = \"phong\"\ndiffuse = " + diffuse + "\n";
}

std::string refusal(const std::string& scene, std::span<const Override> overrides = {}) {
  try {
    load_scene(scene, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a texture's keys set its image's properties") {
  const Folder folder;
  const auto color = [&](const std::string& settings, const Vec2& uv) {
    const std::string scene = folder.write("scene.toml", scene_with("{ image = \"a.png\"" + settings + " }"));
    return load_scene(scene).materials[0]->base_color(uv);
  };
  const Vec3 red(1, 0, 0), green(0, 1, 0), black(0), white(1);
  const auto near = [](const Vec3& a, const Vec3& b) { return glm::length(a - b) < 1e-12; };

  // Bilinear and repeated by default: at u = 0 the first column and the last are mixed.
  CHECK(near(color("", {1.0 / 6, 0.75}), red));
  CHECK(near(color("", {2.0 / 6, 0.75}), (red + green) / 2.0));
  CHECK(near(color("", {0, 0.75}), Vec3(0.5, 0, 0.5)));
  CHECK(near(color(", filter = \"nearest\"", {0.3, 0.75}), red));
  CHECK(near(color(", wrap = \"clamp\"", {0, 0.75}), red));
  CHECK(near(color(", wrap = \"mirror\"", {-0.5, 0.75}), green));
  CHECK(near(color(", filter = 'nearest', wrap = ['clamp', 'repeat']", {-0.9, 1.2}), black));
  CHECK(near(color(", filter = 'nearest', wrap = ['repeat', 'clamp']", {-0.5, 1.2}), green));
  CHECK(near(color(", scale = 2", {1, 0.5}), white));
  CHECK(near(color(", scale = [2, 1], tint = [0.5, 0.25, 2]", {1, 0.25}), {0.5, 0.25, 2}));
  CHECK(near(color(", color_space = \"linear\", wrap = \"clamp\"", {1, 0}), Vec3(64, 128, 192) / 255.0));
  CHECK(glm::length(color(", wrap = \"clamp\"", {1, 0}) - Vec3(0.0512694583, 0.2158605001, 0.5271151257)) <
        1e-9);
}

TEST_CASE("names are relative to the file that contains them; each file is read once, and watched") {
  const Folder folder("parts/a.png");
  const std::string picture_path = folder / "parts/a.png";
  const std::string part = folder.write("parts/part.toml", scene_with("{ image = 'a.png' }"));
  const std::string main =
      folder.write("main.toml",
                   "include = 'parts/part.toml'\n[[material]]\nname = 'n'\ntype = 'phong'\n"
                   "diffuse = { image = 'parts/../parts/a.png', filter = 'nearest' }\n"
                   "specular = { image = './parts/a.png' }\n");
  const Scene scene = load_scene(main);
  CHECK(scene.files == std::vector<fs::path>{main, part, picture_path});

  DiagnosticLog log;
  const AllowedFolders allowed(main, {});
  PixelBudget budget;
  NamedFiles named(allowed, {main, part});
  ImageFiles files(named, budget, log);
  ImageTexture wanted;
  wanted.name = "a.png";
  const auto first = files.load(wanted, {part, 1, 1});
  REQUIRE(first);
  wanted.name = "parts/a.png";
  CHECK(files.load(wanted, {main, 1, 1}) == first);
  CHECK(files.load(wanted, {"-D", 0, 0}) == first);
  wanted.filter = Filter::nearest;
  const auto nearest = files.load(wanted, {main, 1, 1});
  CHECK(nearest->filter == Filter::nearest);
  CHECK(first->filter == Filter::bilinear);
  CHECK(nearest->texels == first->texels);
  CHECK(named.files().size() == 1);
}

TEST_CASE("an override's image is relative to the scene") {
  const Folder folder;
  const std::string scene = folder.write("scene.toml", scene_with("0.5"));
  const Override change{"material.m.diffuse={ image = \"a.png\", filter = \"nearest\" }"};
  CHECK(load_scene(scene, {&change, 1}).materials[0]->base_color(Vec2{0.1, 0.9}) == Vec3(1, 0, 0));
  const Override wrong{"material.m.diffuse={ image = \"b.png\" }"};
  CHECK(refusal(scene, {&wrong, 1}) == "-D material.m.diffuse={ image = \"b.png\" }: error: cannot read " +
                                           (folder / "b.png") + ": No such file or directory");
}

TEST_CASE("images stay in the scene's folder tree, unless others are allowed") {
  const Folder folder("outside.png");
  fs::create_directory(folder.path() / "scene");
  fs::create_symlink(folder / "outside.png", folder / "scene/link.png");
  for (const std::string& name :
       {std::string("../outside.png"), folder / "outside.png", std::string("link.png")}) {
    CAPTURE(name);
    const std::string scene = folder.write("scene/main.toml", scene_with("{ image = '" + name + "' }"));
    CHECK(refusal(scene) == scene + ":4:21: error: " + name +
                                " lies outside the scene's folder; --allow-path DIR allows other ones\n"
                                "  diffuse = { image = '" +
                                name + "' }\n                      ^");
    CHECK(load_scene(scene, {}, {.folders = {folder.path()}}).materials.size() == 1);
  }
}

TEST_CASE("a file that is no picture is an error at its name") {
  const Folder folder;
  folder.write("text.png", "no picture");
  folder.write("short.png", read_file(picture).substr(0, 60));
  fs::create_directory(folder.path() / "folder.png");
  REQUIRE(mkfifo((folder / "pipe.png").c_str(), 0600) == 0);
  folder.write("long.png", "");
  fs::resize_file(folder / "long.png", (size_t{1} << 30) + 1);
  const auto message_of = [&](const std::string& name) {
    const std::string scene = folder.write("scene.toml", scene_with("{ image = \"" + name + "\" }"));
    const std::string message = refusal(scene);
    const std::string start = scene + ":4:21: error: ";
    REQUIRE(message.starts_with(start));
    return message.substr(start.size(), message.find('\n') - start.size());
  };
  const auto unreadable = [&](const std::string& name) { return "cannot read " + (folder / name) + ": "; };
  CHECK(message_of("b.png") == unreadable("b.png") + "No such file or directory");
  CHECK(message_of("text.png") == unreadable("text.png") + "it is not a PNG, JPEG, WebP, TIFF, BMP or TGA");
  CHECK(message_of("short.png").starts_with(unreadable("short.png") + "it is damaged ("));
  CHECK(message_of("folder.png") == unreadable("folder.png") + "it is a folder");
  CHECK(message_of("pipe.png") == unreadable("pipe.png") + "it is not a regular file");
  CHECK(message_of("long.png") ==
        unreadable("long.png") + "it has 1073741825 bytes; the most is 1073741824 (1 GiB)");
  CHECK(message_of("") == "`image` needs the name of a file");
  CHECK(message_of("a.png\\u0000") == "`image` needs the name of a file");
}

TEST_CASE("all images of a scene share one budget of pixels; each setting of an image counts") {
  const Folder folder("a.png");
  const std::string main = folder.write(
      "scene.toml", scene_with("{ image = 'a.png' }\nspecular = { image = 'a.png', filter = 'nearest' }"));
  DiagnosticLog log;
  log.add_source(main, read_file(main));
  const AllowedFolders allowed(main, {});
  PixelBudget budget{10};
  NamedFiles named(allowed, {main});
  ImageFiles files(named, budget, log);
  ImageTexture wanted;
  wanted.name = "a.png";
  CHECK(files.load(wanted, {main, 4, 21}));
  CHECK(files.load(wanted, {main, 4, 21}));
  CHECK(budget.left == 4);
  wanted.filter = Filter::nearest;
  CHECK_FALSE(files.load(wanted, {main, 5, 22}));
  REQUIRE(log.sorted().size() == 1);
  CHECK(format_diagnostic(log.sorted()[0])
            .starts_with(main + ":5:22: error: cannot read " + (folder / "a.png") +
                         ": it has 3×2 pixels; of the 2^28"));
}

TEST_CASE("a picture decoded from memory equals one from a file, except for its name") {
  const std::string bytes = read_file(picture);
  PixelBudget budget;
  std::vector<std::string> warnings;
  const ImageTexture image =
      decode_image_texture(std::as_bytes(std::span(bytes)), "model.glb, image 2", budget, warnings);
  const ImageTexture file = load_image_texture(picture, budget, warnings);
  CHECK(image.name == "model.glb, image 2");
  CHECK(file.name == picture);
  CHECK(image.width == 3);
  CHECK(image.height == 2);
  CHECK(image.texels == file.texels);
  CHECK(image.texels[5] == std::array<uint8_t, 4>{64, 128, 192, 255});
  CHECK(image.srgb);
  CHECK_THROWS_WITH_AS(decode_image_texture({}, "model.glb, image 3", budget, warnings),
                       "cannot read model.glb, image 3: it is not a PNG, JPEG, WebP, TIFF, BMP or TGA",
                       Error);
}
