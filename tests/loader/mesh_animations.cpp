// Animations of glTF files that a scene shows, or that are the scene.
#include <fmt/format.h>

#include <cstring>

#include "folder.hpp"
#include "host/loader/scene_file.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using test::Folder;

namespace {

std::string floats(const std::vector<float>& numbers) {
  std::string bytes(numbers.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

// A triangle whose node goes from 0 to 8 along x ("Walk") or y ("Run") from 1 s to 2 s, and stands at 5 along
// z at rest. `nodes`: the nodes and the rest of the file. `path` and `end`: the property that "Walk" moves,
// and its last value.
std::string walker(const Folder& folder, const std::string& name = "walker.gltf",
                   const std::string& nodes = R"("nodes": [{"mesh": 0, "translation": [0, 0, 5]}])",
                   const char* path = "translation", const Vec3& end = Vec3(8, 0, 0)) {
  const auto animation = [](const char* title, int output, const char* what) {
    return fmt::format(
        R"({{"name": "{}", "samplers": [{{"input": 1, "output": {}}}],
             "channels": [{{"sampler": 0, "target": {{"node": 0, "path": "{}"}}}}]}})",
        title, output, what);
  };
  const auto view = [](int offset, int length) {
    return fmt::format(R"({{"buffer": 0, "byteOffset": {}, "byteLength": {}}})", offset, length);
  };
  const auto accessor = [](int index, int count, const char* type, const char* bounds = "") {
    return fmt::format(R"({{"bufferView": {}, "componentType": 5126, "count": {}, "type": "{}"{}}})", index,
                       count, type, bounds);
  };
  const std::string binary = name + ".bin";
  folder.write(binary,
               floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 2, 0, 0, 0, float(end.x), float(end.y), float(end.z),
                       0, 0, 0, 0, 8, 0}));
  return folder.write(
      name,
      fmt::format(
          R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [{}]}}], {},
  "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
  "buffers": [{{"uri": "{}", "byteLength": 92}}], "bufferViews": [{}, {}, {}, {}],
  "accessors": [{}, {}, {}, {}], "animations": [{}, {}]}})",
          nodes.find("camera") == std::string::npos ? "0" : "0, 1", nodes, binary, view(0, 36), view(36, 8),
          view(44, 24), view(68, 24), accessor(0, 3, "VEC3", R"(, "min": [0, 0, 0], "max": [1, 1, 0])"),
          accessor(1, 2, "SCALAR", R"(, "min": [1], "max": [2])"), accessor(2, 2, "VEC3"),
          accessor(3, 2, "VEC3"), animation("Walk", 2, path), animation("Run", 3, "translation")));
}

Scene load(const std::string& file, const std::vector<std::string>& defines = {}) {
  std::vector<Override> overrides;
  for (const std::string& each : defines) overrides.push_back({each});
  return load_scene(file, overrides);
}

Vec3 position(const Instance& instance) {
  return Vec3(instance.transform[3]);
}

constexpr const char* sun = "[[light]]\ntype = \"directional\"\ndirection = [0, -1, -1]\n";

}  // namespace

TEST_CASE("a mesh shows its file's animation at the time of the frame") {
  const Folder folder;
  walker(folder);
  const std::string file =
      folder.write("scene.toml",
                   std::string(sun) + "[animation]\nframes_per_second = 8\n[[mesh]]\nfile = 'walker.gltf'\n");
  const auto at = [&](const char* frame) {
    return position(load(file, {std::string("animation.frame=") + frame}).instances.at(0));
  };
  CHECK(position(load(file).instances.at(0)) == Vec3(0, 0, 0));  // and not the position at rest
  CHECK(at("-3") == Vec3(0, 0, 0));
  CHECK(at("8") == Vec3(0, 0, 0));
  CHECK(at("10") == Vec3(2, 0, 0));
  CHECK(at("12.5") == Vec3(4.5, 0, 0));
  CHECK(at("999") == Vec3(8, 0, 0));
  const Animation animation = load(file).animation;
  CHECK(animation.tracks == 1);
  CHECK(animation.first == 8);
  CHECK(animation.last == 16);
}

TEST_CASE("one file may be shown in each of its animations, and at rest, in one scene") {
  const Folder folder;
  walker(folder);
  const std::string file = folder.write("scene.toml", std::string(sun) + R"(
[animation]
frame = 36
[[mesh]]
file = "walker.gltf"
batch = { animation = ["Run", "0", "none", "1"] }
[[mesh]]
file = "walker.gltf"
[[mesh]]
file = "walker.gltf"
loop = true
)");
  const Scene scene = load(file);
  REQUIRE(scene.instances.size() == 6);
  CHECK(position(scene.instances[0]) == Vec3(0, 4, 0));
  CHECK(position(scene.instances[1]) == Vec3(4, 0, 0));
  CHECK(position(scene.instances[2]) == Vec3(0, 0, 5));
  CHECK(position(scene.instances[3]) == Vec3(0, 4, 0));
  CHECK(position(scene.instances[4]) == Vec3(4, 0, 0));
  CHECK(position(scene.instances[5]) == Vec3(4, 0, 0));
  CHECK(position(load(file, {"animation.frame=84"}).instances[5]) == Vec3(4, 0, 0));  // 3.5 s
  CHECK(position(load(file, {"animation.frame=84"}).instances[4]) == Vec3(8, 0, 0));
  // If every shown file is at rest, the scene has no animation.
  const std::string still =
      folder.write("still.toml", std::string(sun) + "[[mesh]]\nfile = 'walker.gltf'\nanimation = 'none'\n");
  CHECK(load(still).animation.tracks == 0);
}

TEST_CASE("an animation missing from a file is an error at the key, which lists the file's animations") {
  const Folder folder;
  walker(folder);
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  const auto message = [&](const char* table) {
    const std::string file = folder.write("scene.toml", std::string("[[mesh]]\n") + table);
    try {
      load(file);
    } catch (const InputError& error) {
      const std::string text = error.what();
      return text.substr(file.size() + 1, text.find('\n') - file.size() - 1);
    }
    return std::string("accepted");
  };
  CHECK(message("file = 'walker.gltf'\nanimation = 'walk'") ==
        "3:13: error: the file has no animation \"walk\"; it has \"Walk\", \"Run\"");
  CHECK(message("file = 'walker.gltf'\nanimation = '2'") ==
        "3:13: error: the file has no animation \"2\"; it has \"Walk\", \"Run\"");
  CHECK(message("file = 'a.obj'\nanimation = 'Walk'") == "3:13: error: the file has no animations");
  CHECK(message("file = 'a.obj'\nanimation = 'none'") == "accepted");
  CHECK(message("file = 'walker.gltf'\nanimation = 1") == "3:13: error: `animation` must be a string, not 1");
  CHECK(message("file = 'walker.gltf'\nloop = 1") == "3:8: error: `loop` must be true or false, not 1");
}

TEST_CASE("a mesh file used as the scene is animated too, in front of a fixed camera") {
  const Folder folder;
  const std::string file = walker(folder);
  const Scene first = load(file), later = load(file, {"animation.frame=36"});
  CHECK(position(first.instances.at(0)) == Vec3(0, 0, 0));
  CHECK(position(later.instances.at(0)) == Vec3(4, 0, 0));
  CHECK(first.camera.eye == later.camera.eye);
  CHECK(first.animation.tracks == 1);
  CHECK(later.warnings.empty());
  CHECK(position(load(file, {"animation.frames_per_second=12", "animation.frame=18"}).instances.at(0)) ==
        Vec3(4, 0, 0));
  const Scene run = load(file, {"animation.frame=36", "mesh.0.animation=Run"});
  CHECK(position(run.instances.at(0)) == Vec3(0, 4, 0));
  const Scene still = load(file, {"mesh.0.animation=none"});
  CHECK(position(still.instances.at(0)) == Vec3(0, 0, 5));
  CHECK(still.animation.tracks == 0);

  // The file's own camera moves with its node.
  const std::string filming = walker(folder, "film.gltf", R"("nodes": [{"camera": 0}, {"mesh": 0}],
  "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])");
  CHECK(load(filming, {"animation.frame=36"}).camera.eye == Vec3(4, 0, 0));
  const Scene other = load(filming, {"animation.frame=36", "mesh.0.smooth=40"});
  CHECK(other.warnings.empty());

  // A mesh that grows from nothing is shown once it has an extent. If no mesh is visible at rest, the camera
  // frames it then.
  const std::string grows = walker(folder, "grows.gltf", R"("nodes": [{"mesh": 0}])", "scale", Vec3(8));
  CHECK(load(grows).instances.empty());
  CHECK(load(grows, {"animation.frame=36"}).instances.size() == 1);
  const std::string from_nothing =
      walker(folder, "out.gltf", R"("nodes": [{"mesh": 0, "scale": [0, 0, 0]}])", "scale", Vec3(8));
  CHECK(load(from_nothing, {"animation.frame=36"}).instances.size() == 1);
  CHECK_THROWS_WITH_AS(load(from_nothing), doctest::Contains("no visible triangles"), InputError);
}
