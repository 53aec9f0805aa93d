// [[mesh]], and mesh files in place of scenes.
#include <cmath>
#include <fstream>

#include "folder.hpp"
#include "host/loader/scene_file.hpp"
//
#include "tests/support/camera.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
namespace fs = std::filesystem;

namespace {

using test::Folder;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
const std::string light = "[[light]]\ntype = \"directional\"\ndirection = [0, -1, -1]\n";

std::string refusal(const std::string& scene, std::span<const Override> overrides = {}) {
  try {
    load_scene(scene, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Vec3 moved(const Instance& instance, const Vec3& p) {
  return Vec3(instance.transform * Vec4(p, 1));
}

}  // namespace

TEST_CASE("a mesh file is read once, however many instances show it") {
  const Folder folder;
  const std::string obj = folder.write("parts/a.obj", square + "mtllib a.mtl\nusemtl red\nf 1 2 3\n");
  const std::string mtl = folder.write("parts/a.mtl", "newmtl red\nKd 1 0 0\n");
  const std::string file = folder.write("scene.toml", light + R"(
[[material]]
name = "m"
type = "phong"
[[mesh]]
file = "parts/a.obj"
[[mesh]]
file = "parts/../parts/a.obj"
material = "m"
batch = { transform = [[{ translate = [1, 0, 0] }], [{ scale = 2 }], []] }
[[mesh]]
file = "parts/a.obj"
smooth = 0
)");
  const Scene scene = load_scene(file);
  CHECK(scene.warnings.empty());
  CHECK(scene.files == std::vector<fs::path>{file, obj, mtl});
  CHECK(scene.meshes.size() == 4);  // plain and red, smooth and flat
  REQUIRE(scene.instances.size() == 10);
  CHECK(scene.primitive_count() == 15);
  CHECK(moved(scene.instances[2], {1, 1, 0}) == Vec3(2, 1, 0));
  CHECK(moved(scene.instances[4], {1, 1, 0}) == Vec3(2, 2, 0));
  CHECK(scene.instances[2].mesh == scene.instances[0].mesh);
  CHECK(scene.instances[8].mesh != scene.instances[0].mesh);
  const auto material = [&](size_t i) { return scene.materials[size_t(scene.instances[i].material)]->name; };
  CHECK(material(0) == "plain");
  CHECK(material(1) == "red");
  CHECK(material(3) == "m");
  CHECK(material(9) == "red");
  CHECK(scene.instances[2].position.line == 13);
}

TEST_CASE("names are relative to the file that contains them") {
  const Folder folder;
  folder.write("parts/a.obj", square);
  folder.write("parts/b.toml", "[[mesh]]\nfile = 'a.obj'\n");
  const std::string file = folder.write("scene.toml", "include = 'parts/b.toml'\n" + light);
  CHECK(load_scene(file).instances.size() == 1);
  const Override other{"mesh.0.file='parts/a.obj'"};  // an override stands in the scene
  CHECK(load_scene(file, {&other, 1}).instances.size() == 1);
}

TEST_CASE("a fault in a mesh is an error at its key") {
  const Folder folder;
  folder.write("in/a.obj", square);
  folder.write("in/bad.obj", "v 0 0 0\nf 1 2 3\n");
  folder.write("outside.obj", square);
  const auto message = [&](const std::string& table) {
    const std::string scene = folder.write("in/scene.toml", "[[mesh]]\n" + table);
    const std::string text = refusal(scene);
    return text.starts_with(scene) ? text.substr(scene.size() + 1, text.find('\n') - scene.size() - 1) : text;
  };
  CHECK(message("file = 'bad.obj'") ==
        "2:8: error: " + (folder / "in/bad.obj") + ":2:7: there is no vertex 3: the file has 1");
  CHECK(message("file = 'ab.obj'") == "2:8: error: cannot read the mesh " + (folder / "in/ab.obj") +
                                          ": No such file or directory; did you mean " +
                                          (folder / "in/a.obj") + "?");
  CHECK(message("file = '../outside.obj'") ==
        "2:8: error: ../outside.obj lies outside the scene's folder; --allow-path DIR allows other ones");
  CHECK(message("file = ''") == "2:8: error: `file` needs the name of a file");
  CHECK(contains(message("file = 'scene.toml'"),
                 "a mesh file's name must end in .obj, .ply, .stl, .off, .3mf, .gltf, .glb, .xyz or .pcd"));
  CHECK(message("smooth = 3") == "1:1: error: [[mesh]] needs `file`, a string");
  CHECK(message("file = 'a.obj'\nsmooth = 181") ==
        "3:10: error: `smooth` must be a number from 0 to 180, not 181");
  CHECK(message("file = 'a.obj'\nmaterial = 'x'") == "3:12: error: no [[material]] is named \"x\"");
  CHECK(message("file = 'a.obj'\ntransform = [{ translate = [9e11, 9e11, 9e14] }]") ==
        "3:13: error: the transformed vertices are out of range (coordinates up to 1e12)");
  CHECK(message("file = 'a.obj'\nradius = 3") ==
        "3:1: error: unknown key `radius` in [[mesh]]; its keys are name, file, material, transform, smooth, "
        "point_shape, point_size, line_width, up, animation, gltf_scene, variant, loop, batch, repeat");
  CHECK(contains(message("file = 'a.obj'\nbatch = { radius = [3] }"),
                 "unknown key `radius` in the batch of [[mesh]]"));
  CHECK_THROWS_AS(parse_scene("[[mesh]]\nfile = 'a.obj'", "memory.toml"), InputError);
}

TEST_CASE("a transform that leaves triangles without area is refused") {
  const Folder folder;
  folder.write("a.obj", square + "v 0.5 3e-9 0\nf 1 2 5\n");
  const auto scaled = [&](const char* scale) {
    return refusal(folder.write("scene.toml", light + fmt::format("[[mesh]]\nfile = 'a.obj'\ntransform = [{{ "
                                                                  "scale = {} }}]\n",
                                                                  scale)));
  };
  CHECK(scaled("1e-6") == "accepted");
  CHECK(scaled("[3, 0.3, 3]") == "accepted");
  CHECK(contains(scaled("[1000, 0.001, 1]"), "the transform leaves some of the triangles without area"));
}

TEST_CASE("warnings of mesh files become warnings of the scene") {
  const Folder folder;
  const std::string obj = folder.write("a.obj", square + "f 1 1 2\n");
  const std::string file =
      folder.write("scene.toml", light + "[[mesh]]\nfile = 'a.obj'\n[[mesh]]\nfile = 'a.obj'\n");
  const Scene scene = load_scene(file);
  REQUIRE(scene.warnings.size() == 1);
  CHECK(scene.warnings[0].message == obj + ": 1 face without area was left out");
  CHECK(scene.warnings[0].position.line == 4);
  const Scene alone = load_scene(obj);
  REQUIRE(alone.warnings.size() == 1);
  CHECK(format_diagnostic(alone.warnings[0]) == obj + ": warning: 1 face without area was left out");
}

TEST_CASE("a mesh file alone is a scene that frames it") {
  const Folder folder;
  const std::string obj = folder.write("a.obj", "v -3 0 0\nv 5 0 0\nv 5 1 0\nv 0 7 -2\nf 1 2 3\nf 1 3 4\n");
  const Scene scene = load_scene(obj);
  CHECK(scene.file == obj);
  CHECK(scene.files == std::vector<fs::path>{obj});
  CHECK(scene.lights.empty());
  CHECK(scene.shapes.size() == 4);  // a floor and three area lights
  const std::vector<Override> whitted{{"render.integrator=whitted"}};
  CHECK(load_scene(obj, whitted).lights.size() == 2);
  CHECK(load_scene(obj, whitted).render.ambient.x > 0);

  // Whatever the picture's shape, every vertex is in the square in its middle, and one is near the square's
  // edge.
  for (const char* size : {"image.width=100", "image.height=100", "image.width=2000"}) {
    const Override shape{size};
    const Scene other = load_scene(obj, {&shape, 1});
    const double half = std::min(
        1.0, double(other.image.height) / other.image.width);  // half the square's side, in half widths
    double most = 0;
    for (const Vec3& p : other.meshes[0].positions) {
      REQUIRE(glm::dot(p - other.camera.eye, camera_axes(other.camera).w) > 0);
      const Vec2 position = test::position_seen(other, p) / half;
      most = std::max({most, std::fabs(position.x), std::fabs(position.y)});
    }
    CHECK(most == doctest::Approx(0.94));
  }
}

TEST_CASE("overrides apply to mesh files; a file's own camera and lights are used only if it is the scene") {
  const Folder folder;
  const std::string obj = folder.write("a.obj", square);
  const Override overrides[] = {{"look=plain"},
                                {"camera.eye=[1, 2, 3]"},
                                {"mesh.0.smooth=0"},
                                {"light.0.intensity=2"},
                                {"render.background=1"}};
  const Scene scene = load_scene(obj, overrides);
  CHECK(scene.camera.eye == Vec3(1, 2, 3));
  CHECK(scene.meshes[0].normals.empty());
  CHECK(std::get<DirectionalLight>(scene.lights[0]->form()).intensity == Vec3(2));
  CHECK(scene.render.background == Vec3(1));

  const std::string gltf =
      folder.write("a.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
    "extensionsUsed": ["KHR_mesh_quantization", "KHR_lights_punctual"],
    "nodes": [{"mesh": 0}, {"camera": 0, "translation": [1, 2, 3]},
              {"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [4, 5, 6]}],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 1}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5121, "type": "VEC3", "count": 3, "min": [0, 0, 0],
                   "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 12, "byteStride": 4}],
    "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAEAAAAAAQAA"}]})");
  const Scene own = load_scene(gltf);
  CHECK(own.warnings.empty());
  CHECK(own.camera.eye == Vec3(1, 2, 3));
  CHECK(test::camera_as<PerspectiveCamera>(own).fov_axis == FovAxis::vertical);
  REQUIRE(own.lights.size() == 1);
  CHECK(std::get<PointLight>(own.lights[0]->form()).position == Vec3(4, 5, 6));

  // If a scene file shows the mesh, its camera and lights are left out, with a warning.
  const Scene shown = load_scene(folder.write("scene.toml", light + "[[mesh]]\nfile = 'a.gltf'\n"));
  CHECK(shown.lights.size() == 1);
  REQUIRE(shown.warnings.size() == 1);
  CHECK(contains(shown.warnings[0].message,
                 "its camera and lights are not used: only those of the scene file count"));
}

TEST_CASE(
    "a camera of a glTF file alone is chosen by its name or number; the first is the default, with a "
    "warning") {
  const Folder folder;
  const std::string gltf = folder.write(
      "a.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3, 4]}],
    "extensionsUsed": ["KHR_mesh_quantization"],
    "nodes": [{"mesh": 0}, {"camera": 0, "translation": [1, 0, 0]}, {"camera": 1, "name": "from above", "translation": [2, 0, 0]},
              {"camera": 0, "name": "from above", "translation": [3, 0, 0]}, {"camera": 0, "translation": [4, 0, 0]}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 1}},
                {"type": "orthographic", "name": "plan", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 9}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5121, "type": "VEC3", "count": 3, "min": [0, 0, 0],
                   "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 12, "byteStride": 4}],
    "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAEAAAAAAQAA"}]})");
  const auto eye = [&](const char* camera) {
    const Scene scene = load_scene(gltf, std::vector<Override>{{camera}});
    CHECK(scene.warnings.empty());
    return scene.camera.eye.x;
  };
  const Scene first = load_scene(gltf);
  CHECK(first.camera.eye.x == 1);
  REQUIRE(first.warnings.size() == 1);
  CHECK(contains(
      first.warnings[0].message,
      "shows the first of its cameras; --camera NAME shows another: 0, \"from above\", \"from above\", 3"));
  CHECK(eye("camera=0") == 1);
  CHECK(eye("camera=from above") == 2);
  CHECK(eye("camera=\"from above\"") == 2);
  CHECK(eye("camera=3") == 4);
  for (const char* wrong : {"camera=plan", "camera=4", "camera=0 ", "camera=-1", "camera="}) {
    CAPTURE(wrong);
    CHECK_THROWS_WITH(load_scene(gltf, std::vector<Override>{{wrong}}),
                      (std::string("-D ") + wrong + ": " + gltf +
                       " has no such camera; it has 0, \"from above\", \"from above\", 3")
                          .c_str());
  }
  const std::string obj = folder.write("a.obj", square);
  CHECK_THROWS_WITH(load_scene(obj, std::vector<Override>{{"camera=0"}}),
                    ("-D camera=0: " + obj + " has no such camera; it has none").c_str());
}

TEST_CASE(
    "scenes and variants of glTF are chosen in [[mesh]] and for a file alone; unknown names are errors") {
  const Folder folder;
  const std::string gltf = folder.write("a.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
    "scenes": [{"name": "near", "nodes": [0]}, {"nodes": [1, 2, 3]}],
    "extensionsUsed": ["KHR_mesh_quantization", "KHR_materials_variants"],
    "extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "glow"}]}},
    "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [7, 0, 0]}, {"camera": 0, "translation": [1, 0, 0]},
              {"camera": 1, "name": "bad"}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 1}},
                {"type": "perspective", "perspective": {"yfov": 5, "znear": 1}}],
    "materials": [{"name": "red"}, {"name": "glow"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0, "extensions": {"KHR_materials_variants":
                {"mappings": [{"material": 1, "variants": [1]}]}}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5121, "type": "VEC3", "count": 3, "min": [0, 0, 0],
                   "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 12, "byteStride": 4}],
    "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAEAAAAAAQAA"}]})");
  const auto check = [](const Scene& scene, double x, const std::string& material) {
    REQUIRE(scene.instances.size() == 1);
    CHECK(scene.instances[0].transform[3].x == x);
    CHECK(scene.materials[size_t(scene.instances[0].material)]->name == material);
  };
  const auto alone = [&](const std::vector<Override>& overrides) { return load_scene(gltf, overrides); };
  check(alone({{"look=plain"}}), 0, "red");
  check(alone({{"look=plain"}, {"gltf_scene=1"}, {"variant=glow"}, {"camera=0"}}), 7, "glow");
  CHECK(alone({{"gltf_scene=1"}, {"camera=0"}}).camera.eye.x == 1);
  CHECK(alone({}).camera.eye.x != 1);
  const auto complaint = [&](const std::vector<Override>& overrides) {
    try {
      load_scene(gltf, overrides);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK(contains(complaint({{"gltf_scene=far"}}), "the file has no scene \"far\"; it has \"near\", 1"));
  CHECK(
      contains(complaint({{"variant=blue"}}), "the file has no variant \"blue\"; it has \"red\", \"glow\""));
  CHECK(contains(complaint({{"gltf_scene=1"}, {"camera=bad"}}),
                 "cameras[1].perspective has a yfov that is out of range"));

  const auto in_scene = [&](const std::string& keys) {
    return folder.write("scene.toml", light + "[[mesh]]\nfile = 'a.gltf'\n" + keys);
  };
  check(load_scene(in_scene("gltf_scene = '1'\nvariant = 'glow'\n")), 7, "glow");
  CHECK(contains(refusal(in_scene("gltf_scene = 'far'\nvariant = 'blue'\n")),
                 "the file has no scene \"far\"; it has \"near\", 1"));
  CHECK(contains(refusal(in_scene("variant = 'blue'\n")), "it has \"red\", \"glow\""));
}

TEST_CASE("`up` turns a file upright: its axis points along +y, and nothing is mirrored") {
  const Folder folder;
  // A triangle in the plane x = 0 whose longest side is along z, and points in the same positions.
  folder.write("a.obj", "v 0 0 0\nv 0 1 0\nv 0 0 5\nf 1 2 3\n");
  folder.write("a.xyz", "0 0 0\n0 1 0\n0 0 5\n");
  const auto corner = [&](const std::string& up, const Vec3& at) {
    const Scene scene = load_scene(folder.write(
        "scene.toml",
        light + fmt::format(
                    "[[mesh]]\nfile = 'a.obj'\nup = '{}'\ntransform = [{{ translate = [1, 0, 0] }}]\n", up)));
    REQUIRE(scene.instances.size() == 1);
    const Mat4& map = scene.instances[0].transform;
    CHECK(glm::determinant(map) == 1);
    return Vec3(map * Vec4(at, 1)) - Vec3(1, 0, 0);
  };
  CHECK(corner("y", {1, 2, 3}) == Vec3(1, 2, 3));
  CHECK(corner("z", {1, 2, 3}) == Vec3(1, 3, -2));
  CHECK(corner("-z", {1, 2, -3}) == Vec3(1, 3, 2));
  CHECK(corner("x", {1, 2, 3}) == Vec3(-2, 1, 3));
  CHECK(corner("-x", {-1, 2, 3}) == Vec3(2, 1, 3));
  CHECK(corner("-y", {1, -2, 3}) == Vec3(1, 2, -3));

  const Scene points =
      load_scene(folder / "a.xyz", std::vector<Override>{{"up=z"}, {"point_size=0.5"}, {"look=plain"}});
  REQUIRE(points.shapes.size() == 1);
  CHECK(points.shapes[0]->bounds().max.y == 5.25);
  CHECK(points.shapes[0]->bounds().min.z == -1.25);
  CHECK_THROWS_WITH(load_scene(folder / "a.obj", std::vector<Override>{{"up=w", "--up w"}}),
                    "--up w: the axis that is up is y, z, x, -y, -z, -x");
  folder.write("a.gltf", "{}");
  CHECK(contains(refusal(folder.write("scene.toml", light + "[[mesh]]\nfile = 'a.gltf'\nup = 'z'\n")),
                 "+y is up in glTF, by its specification"));
}

TEST_CASE("a mesh alone that leaves no room for a studio is shown plain, with a warning") {
  const Folder folder;
  const auto load = [&](const char* reach) {
    return load_scene(
        folder.write("a.obj", fmt::format("v 0 0 0\nv {0} 0 0\nv {0} {0} 0\nf 1 2 3\n", reach)));
  };
  const Scene within = load("1e10"), beyond = load("1.1e10");
  CHECK(within.warnings.empty());
  CHECK(within.shapes.size() == 4);
  CHECK(beyond.shapes.empty());
  REQUIRE(beyond.warnings.size() == 1);
  CHECK(contains(beyond.warnings[0].message, "reaches beyond 1e10"));
  CHECK(load("9e11").shapes.empty());
}

TEST_CASE("a mesh file that cannot be read is an error") {
  const Folder folder;
  CHECK(refusal(folder.write("bad.ply", "ply\nx\n")) ==
        (folder / "bad.ply") + ":2:1: error: `x` is not a statement of a PLY header");
  try {
    load_scene(folder / "none.glb");
    FAIL("read");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::file_io);
  }
}
