// [environment]: messages about files that cannot be an environment.
#include <cmath>
#include <limits>

#include "folder.hpp"
#include "host/image/image_file.hpp"
#include "host/loader/scene_file.hpp"
#include "host/scene/environment.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

namespace {

image::Image gray(int width, int height, float value, int channels = 3) {
  image::Image picture(width, height, channels);
  for (float& sample : picture.samples()) sample = value;
  return picture;
}

// The error, without its position, of a scene in the folder with that [environment] table; or the first
// warning.
std::string message_of(const test::Folder& folder, const std::string& table, const std::string& rest = "") {
  const std::string scene = folder.write("scene.toml", "[environment]\n" + table + "\n" + rest);
  std::string message;
  try {
    for (const Diagnostic& warning : load_scene(scene).warnings)
      if (warning.position.line > 0) return "warning: " + warning.message;
    return "accepted";
  } catch (const InputError& error) {
    message = error.what();
  }
  message = message.substr(message.find("error: ") + 7);
  return message.substr(0, message.find('\n'));
}

std::shared_ptr<const EnvironmentMap> loaded(const test::Folder& folder, const std::string& table) {
  return load_scene(folder.write("scene.toml", "[environment]\n" + table + "\n")).environment;
}

}  // namespace

TEST_CASE(
    "an environment's texels are loaded, scaled and rotated, from each kind of file, greyscale ones too") {
  const test::Folder folder;
  image::Image picture = gray(4, 2, 0.5f);
  picture.pixel(1, 0)[2] = 3;
  for (const char* name : {"a.pfm", "a.hdr", "a.exr"}) {
    CAPTURE(name);
    image::write_image(folder / name, picture);
    const auto map =
        loaded(folder, fmt::format("image = '{}'\nscale = [2, 1, 4]\nrotate = -90\nshare = 0.25", name));
    REQUIRE(map);
    CHECK(map->width() == 4);
    CHECK(map->height() == 2);
    CHECK(map->texel(1, 0) == Vec3(1, 0.5, 12));
    CHECK(map->texel(3, 1) == Vec3(1, 0.5, 2));
    CHECK(map->turn() == 0.75);
    CHECK(map->share == 0.25);
  }
  image::write_image(folder / "gray.pfm", gray(1, 3, 0.5f, 1));
  const auto map = loaded(folder, "image = 'gray.pfm'");
  REQUIRE(map);
  CHECK(map->texel(0, 2) == Vec3(0.5));
  CHECK(map->share == 0.5);
  CHECK_FALSE(load_scene(folder.write("none.toml", "")).environment);
}

TEST_CASE("texels out of range are an error with their count and first position; a black file is a warning") {
  const test::Folder folder;
  const auto message = [&](const auto& spoil) {
    image::Image picture = gray(4, 3, 1);
    spoil(picture);
    image::write_image(folder / "a.pfm", picture);
    return message_of(folder, "image = 'a.pfm'");
  };
  const std::string wanted = "out of range: light must be from 0 to 1e+15; the first is ";
  CHECK(message([](image::Image&) {}) == "accepted");
  CHECK(message([](image::Image& picture) { picture.pixel(2, 1)[1] = std::nanf(""); }) ==
        "1 value of the picture is " + wanted + "nan, in column 2 of row 1");
  CHECK(message([](image::Image& picture) { picture.pixel(0, 2)[0] = picture.pixel(3, 2)[0] = -0.5f; }) ==
        "2 values of the picture are " + wanted + "-0.5, in column 0 of row 2");
  CHECK(message([](image::Image& picture) {
          picture.pixel(3, 0)[2] = std::numeric_limits<float>::infinity();
        }) == "1 value of the picture is " + wanted + "inf, in column 3 of row 0");
  CHECK(message([](image::Image& picture) { picture.pixel(0, 0)[0] = 2e15f; }) ==
        "1 value of the picture is " + wanted + "2e+15, in column 0 of row 0");
  CHECK(message([](image::Image& picture) { picture = gray(4, 3, 0); }) ==
        "warning: the environment is black: it lights nothing");
  CHECK(message([](image::Image& picture) { picture = gray(1, 1, 2); }) == "accepted");
}

TEST_CASE("a file that is not an environment is an error at its name") {
  const test::Folder folder;
  CHECK(message_of(folder, "image = 'none.hdr'") ==
        "cannot read " + (folder / "none.hdr") + ": No such file or directory");
  CHECK(message_of(folder, "image = 'a.png'") ==
        (folder / "a.png") + ": a .png stores colours for a screen, not light; use a .hdr, .exr or .pfm");
  CHECK(message_of(folder, "image = 'a.jpg'") ==
        (folder / "a.jpg") + ": a picture's name must end in .png, .pfm, .hdr or .exr");
  folder.write("a.hdr", "nothing");
  CHECK(message_of(folder, "image = 'a.hdr'") ==
        "cannot read " + (folder / "a.hdr") + " as HDR: it ends within its header");
  CHECK(message_of(folder, "image = '../a.hdr'")
            .ends_with("lies outside the scene's folder; --allow-path DIR allows other ones"));
  CHECK(message_of(folder, "imagee = 'a.hdr'").starts_with("[environment] of type image needs `image`"));
  CHECK(message_of(folder, "share = 1\nimage = 'a.hdr'") ==
        "`share` must be a number above 0 and below 1, not 1");
  image::write_image(folder / "b.pfm", gray(2, 1, 1));
  CHECK(message_of(folder, "image = 'b.pfm'", "[render]\nbackground = 1") ==
        "[environment] takes the place of `background`: a scene has one or the other");
}

TEST_CASE("a sky adds its sun as the last light; by night there is none") {
  const test::Folder folder;
  const std::string day = "[environment]\ntype = 'sky'\nsun = [0, 2, -2]\nscale = 3\n";
  const Scene scene =
      load_scene(folder.write("day.toml", day + "[[light]]\ntype = 'point'\nposition = [0, 1, 0]\n"));
  REQUIRE(scene.environment);
  REQUIRE(scene.lights.size() == 2);
  const auto sun = std::get<DirectionalLight>(scene.lights[1]->form());
  CHECK(glm::length(sun.to_light - glm::normalize(Vec3(0, 1, -1))) < 1e-12);
  CHECK(sun.intensity.x > 1);
  CHECK(load_scene(folder.write("night.toml", "[environment]\ntype = 'sky'\nsun = [0, -1, -9]\n"))
            .lights.empty());

  CHECK(message_of(folder, "type = 'sky'").starts_with("[environment] of type sky needs `sun`"));
  CHECK(message_of(folder, "type = 'sky'\nsun = [0, 0, 0]") == "`sun` has no length");
  CHECK(message_of(folder, "type = 'sky'\nsun = [0, 1, 0]\nrotate = 3") ==
        "`rotate` is for type = \"image\" only");
  CHECK(message_of(folder, "type = 'sky'\nsun = [0, 1, 0]\nscale = 1e10") == "`scale` must be at most 1e9");
  CHECK(message_of(folder, "type = 'sky'\nsun = [0, 1, 0]\nscale = 0") ==
        "warning: the environment is black: it lights nothing");
}
