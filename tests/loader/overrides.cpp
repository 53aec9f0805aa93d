// -D KEY=VALUE.
#include <algorithm>
#include <bit>

#include "host/loader/scene_file.hpp"
#include "host/scene/integrator.hpp"
//
#include "folder.hpp"
#include "tests/support/camera.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using eyeray::engine::test::Folder;

namespace {

constexpr std::string_view text = R"(
[image]
width = 64
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[material]]
name = "floor.1"
type = "phong"
diffuse = { checker = { even = 1, odd = 0, size = 1 } }
[[sphere]]
center = [0, 0, 0]
radius = 1
material = "glass"
[[sphere]]
batch = { center = [[0, 0, 0], [1, 0, 0]], radius = [1, 2] }
material = "floor.1"
)";

Scene with(std::initializer_list<const char*> changes) {
  std::vector<Override> overrides;
  for (const char* change : changes) overrides.push_back({change});
  return parse_scene(text, "scene.toml", overrides);
}

std::string refusal(const char* change) {
  try {
    with({change});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// A triangle as glTF. Its 36 bytes of positions are in the file itself, or in the second chunk of a .glb.
std::string gltf_triangle(bool embedded) {
  const std::string uri =
      embedded
          ? R"("uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA",)"
          : "";
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{)" +
         uri + R"("byteLength": 36}]})";
}

// `json` and the triangle's positions as chunks.
std::string glb_of(std::string json) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string bytes;
  const auto word = [&](uint32_t value) {
    for (int i = 0; i < 4; ++i) bytes += char(value >> (8 * i) & 0xff);
  };
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  bytes += "glTF";
  word(2);
  word(uint32_t(12 + 8 + json.size() + 8 + sizeof positions));
  word(uint32_t(json.size()));
  bytes += "JSON" + json;
  word(sizeof positions);
  bytes += std::string("BIN\0", 4);
  for (const float value : positions) word(std::bit_cast<uint32_t>(value));
  return bytes;
}

}  // namespace

TEST_CASE("an override replaces the file's value") {
  const Scene scene =
      with({"image.width=32", "render.max_depth=3", "render.integrator=raycast", "camera.eye=[1, 2, 3]",
            "camera.eye.1=9", "camera . fov = 30 # degrees", "image.width=16"});
  CHECK(scene.image.width == 16);
  CHECK(scene.render.max_depth == 3);
  CHECK(scene.render.integrator == IntegratorType::raycast);
  CHECK(scene.camera.eye == Vec3(1, 9, 3));
  CHECK(test::camera_as<PerspectiveCamera>(scene).fov_degrees == 30);
}

TEST_CASE("elements are named by index or by name") {
  const Scene scene = with({"sphere.0.radius=5", "sphere.1.batch.radius.1=7", "material.glass.ior=1.25",
                            "material.\"floor.1\".diffuse.checker.odd=0.5", "material.1.reflectance=0.5"});
  CHECK(scene.shapes[0]->bounds().max.x == 5);
  CHECK(scene.shapes[2]->bounds().max.x == 8);
  CHECK(scene.materials[0]->medium()->ior == 1.25);
  CHECK(scene.materials[1]->base_color(Vec2{1.5, 0}) == Vec3(0.5));
}

TEST_CASE("an override corrects a wrong value") {
  const Override mend{"image.width=5"};
  CHECK(parse_scene("[image]\nwidth = -5", "scene.toml", {&mend, 1}).image.width == 5);
}

TEST_CASE("a wrong override is refused, and the error names it") {
  const std::pair<const char*, const char*> cases[] = {
      {"rendr.max_depth=3", "unknown table `rendr`; did you mean [render]?"},
      {"render.max_dept=3", "unknown key `max_dept` in [render]; did you mean `max_depth`?"},
      {"render.max_depth=1099", "`max_depth` must be an integer from 0 to 1024, not 1099"},
      {"render.integrator=whited",
       "`integrator` must be \"raycast\", \"whitted\", \"path\" or \"sppm\", not \"whited\"; did you mean "
       "\"whitted\"?"},
      {"sphere.7.radius=2", "there is no sphere.7: the scene has 2 [[sphere]], from 0 to 1"},
      {"sphere.-1.radius=2", "there is no sphere.-1: the scene has 2 [[sphere]], from 0 to 1"},
      {"light.0.intensity=2", "the scene has no [[light]]"},
      {"material.glas.ior=2", "no [[material]] is named `glas`; did you mean `glass`?"},
      {"camera.eye=[1,2]", "`eye` must be three numbers [x, y, z], not a list of 2"},
      {"sphere.0.center.3=7", "`center` has 3 elements, counted from 0, so there is no element `3`"},
      {"sphere.0.center.x=7", "`center` has 3 elements, counted from 0, so there is no element `x`"},
      {"image.width.x=3", "`width` is a single value, so it has no `x`"},
      {"camera=3", "name the key too: camera.KEY=VALUE"},
      {"camera={eye=[1,2,3]}", "name the key too: camera.KEY=VALUE"},
      {"sphere.0=3", "name the key too: sphere.INDEX.KEY=VALUE"},
      {"include=x.toml", "`include` is allowed only in a file"},
      {"width", "write KEY=VALUE, such as render.max_depth=3"},
      {"image.width=", "syntax: a value is missing"},
      {"image.width=[", "syntax: encountered end-of-file"},
      {"=3", "syntax: expected keys, tables, whitespace or comments, saw '='"},
      {"a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r=1", "write KEY=VALUE, such as render.max_depth=3"},
      {"image={}\nimage.width=3", nullptr},
  };
  for (const auto& item : cases) {
    const char* change = item.first;
    const char* message = item.second;
    CAPTURE(change);
    if (message) {
      CHECK(refusal(change) == fmt::format("-D {}: error: {}", change, message));
    } else {
      CHECK(refusal(change).ends_with("write KEY=VALUE, such as render.max_depth=3"));
    }
  }
}

TEST_CASE("a file in an override is relative to the scene, whatever kind of input the scene is") {
  const Folder folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
  folder.write("in/other.obj", triangle);
  folder.write("in/colors.glsl", "vec3 color(vec2 uv) { return vec3(uv, 0); }\n");
  folder.write("in/sky.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x80\x81");
  std::filesystem::copy_file("tests/image/pictures/rgb.png", folder / "in/rgb.png");
  const std::string shapes =
      "[[material]]\nname = \"m\"\ntype = \"phong\"\n[[mesh]]\nfile = \"other.obj\"\nmaterial = \"m\"\n"
      "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n";
  folder.write("in/parts.toml", shapes);
  const std::string alone[] = {
      folder.write("in/alone.obj", triangle),
      folder.write("in/alone.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                   "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                   "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
      folder.write("in/alone.gltf", gltf_triangle(true)),
      folder.write("in/alone.glb", glb_of(gltf_triangle(false)))};
  const std::string odd = "a=b,c&d:e(f)[g]it's#.hdr";
  std::filesystem::copy_file(folder / "in/sky.hdr", folder / ("in/" + odd));
  std::vector<std::string> inputs(std::begin(alone), std::end(alone));
  inputs.push_back(folder.write("in/scene.toml", shapes));
  inputs.push_back(folder.write("in/main.toml", "include = [\"parts.toml\"]\n"));

  struct Value {
    std::string key, file;
    bool in_mesh;  // a mesh alone has no material to change
  };
  const Value values[] = {{"environment.image=NAME", "sky.hdr", true},
                          {"environment.image=NAME", odd, true},
                          {"mesh.0.file=NAME", "other.obj", true},
                          {"material.0.diffuse={image=\"NAME\"}", "rgb.png", false},
                          {"material.0.diffuse={formula={file=\"NAME\"}}", "colors.glsl", false}};
  for (const std::string& input : inputs) {
    for (const Value& value : values) {
      for (const std::string& name : {value.file, "./" + value.file, folder / "in/" + value.file}) {
        const std::string change = std::string(value.key).replace(value.key.find("NAME"), 4, name);
        CAPTURE(input);
        CAPTURE(change);
        if (!value.in_mesh && std::ranges::find(alone, input) != std::end(alone)) {
          CHECK_THROWS_AS(load_scene(input, std::vector<Override>{{change}}), InputError);
          continue;
        }
        const Scene scene = load_scene(input, std::vector<Override>{{change}});
        CHECK(std::ranges::count(scene.files, std::filesystem::path(folder / "in/" + value.file)) == 1);
      }
      const std::string missing = std::string(value.key).replace(value.key.find("NAME"), 4, "missing.hdr");
      CHECK_THROWS_AS(load_scene(input, std::vector<Override>{{missing}}), InputError);
    }
  }
  // A scene given as text has no folder, so it cannot name files, not even existing ones.
  for (const std::string key : {"environment.image=NAME", "material.1.diffuse={image=\"NAME\"}",
                                "material.1.diffuse={formula={file=\"NAME\"}}"}) {
    for (const std::string& name :
         {std::string("missing.hdr"), folder / "in/sky.hdr", folder / "in/colors.glsl"}) {
      const std::string change = std::string(key).replace(key.find("NAME"), 4, name);
      CAPTURE(change);
      CHECK(refusal(change.c_str()).find("error: only a scene in a file can ") != std::string::npos);
    }
  }
}
