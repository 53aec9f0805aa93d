#include "benchmarks/contenders/cycles_scene.hpp"

#include "host/core/error.hpp"
#include "host/loader/scene_file.hpp"
#include "tests/support/environments.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::contenders;

namespace {

bool script_has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::string cycles_stage = R"([camera]
eye = [0, 0, 5]
target = [0, 0, 0]
fov = 90
[render]
integrator = "path"
max_depth = 7
background = [0.5, 0.25, 1]
[[material]]
name = "m"
type = "phong"
diffuse = [0.5, 0.25, 1]
reflectance = 0.125
[[material]]
name = "lamp"
type = "phong"
diffuse = 0
emission = [4, 2, 1]
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
)";

std::string script_of(const std::string& rest) {
  return cycles_scene(parse_scene(cycles_stage + rest, "scene.toml"), 320, 240);
}

// The error for a scene that Blender has no equivalent of.
std::string refused(const std::string& rest) {
  try {
    script_of(rest);
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::bad_input);
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a Cycles script has size, depth, camera, lights, materials and shapes, and no biased setting") {
  const std::string text = script_of(R"(
[[light]]
type = "directional"
direction = [0, -1, 0]
intensity = [1, 2, 3]
[[light]]
type = "point"
position = [1, 2, 3]
[[sphere]]
center = [1, 2, 3]
radius = 0.5
material = "m"
[[sphere]]
center = [0, 0, 0]
radius = 2
material = "glass"
[[triangle]]
vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
material = "lamp"
[[parallelogram]]
origin = [0, 0, 0]
edge_u = [1, 0, 0]
edge_v = [0, 0, 2]
material = "m"
[[disk]]
center = [0, 1, 0]
normal = [0, 1, 0]
radius = 1
inner_radius = 0.25
material = "m"
[[box]]
min = [-1, -1, -1]
max = [1, 1, 1]
material = "m"
[[torus]]
center = [0, 0, 0]
axis = [0, 1, 0]
major_radius = 2
minor_radius = 0.5
material = "m"
)");
  for (const char* line :
       {"cycles.use_adaptive_sampling = False", "cycles.blur_glossy = 0",
        "cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0",
        "cycles.light_sampling_threshold = 0", "cycles.pixel_filter_type = \"BOX\"",
        "scene.render.resolution_x, scene.render.resolution_y = 320, 240",
        "cycles.transmission_bounces = 7\n", "surroundings((0.5, 0.25, 1))",
        "m0 = material(\"0\", (\"BsdfDiffuse\", (0.5, 0.25, 1), {}), (\"BsdfGlossy\", "
        "(0.125, 0.125, 0.125), {}))\n",
        "m1 = material(\"1\", (\"Emission\", (4, 2, 1), {\"Strength\": 1}))\n",
        "m2 = material(\"2\", (\"BsdfGlass\", (1, 1, 1), {\"IOR\": 1.5}))\n",
        "light(\"SUN\", 3.141592653589793, (1, 2, 3), ", "light(\"POINT\", 39.47841760435743, ",
        "add(ball, m0, ((0.5, 0, 0, 1), (0, 0.5, 0, 2), (0, 0, 0.5, 3), (0, 0, 0, 1), ))\n",
        "add(disk(0.25), m0, ", "add(torus(0.25), m0, ", "cube = box()\nadd(cube, m0, ",
        "add(mesh(numbers(\"\"\"\n0 0 0\n1 0 0\n0 1 0\n\"\"\", 3), [(0, 1, 2, )]), m1)\n"}) {
    CAPTURE(line);
    CHECK(script_has(text, line));
  }
  // 90° across, from z = 5.
  CHECK(script_has(text, "camera(\"PERSP\", 1.570796326794896"));
  CHECK(script_has(text, "((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 5), (0, 0, 0, 1), ))\n"));
  // One mesh for all balls.
  CHECK(text.find("\nball = sphere()\n") == text.rfind("\nball = sphere()\n"));
}

TEST_CASE("a mesh for Cycles keeps its normals, and the environment its texels and rotation") {
  Scene scene = parse_scene(cycles_stage + "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n",
                            "scene.toml");
  CHECK(!cycles_environment(scene));
  scene.environment = test::environment(4, 2, [](const Vec3& d) { return Vec3(1 + d.x, 1 + d.y, 2); }, 0.25);
  scene.meshes.push_back({.name = "mesh",
                          .positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                          .triangles = {{0, 1, 2}},
                          .normals = {{0, 0, 1}, {0, 0.6, 0.8}, {0, 0, 1}},
                          .uv = {}});
  scene.instances.push_back({.mesh = 0, .material = 0, .position = {}});
  const std::string text = cycles_scene(scene, 8, 8);
  CHECK(script_has(text, "surroundings((0, 0, 0), 0.25)\n"));
  CHECK(script_has(
      text,
      "mesh0 = mesh(numbers(\"\"\"\n0 0 0\n1 0 0\n0 1 0\n\"\"\", 3),\ncorners(\"\"\"\n0 1 2\n\"\"\"), "
      "True,\nnumbers(\"\"\"\n0 0 1\n0 0.6 0.8\n0 0 1\n\"\"\", 3))\nadd(mesh0, m0, "));
  const image::Image picture = cycles_environment(scene).value();
  CHECK(picture.width() == 4);
  CHECK(picture.height() == 2);
  CHECK(picture.pixel(1, 0)[1] == float(scene.environment->texel(1, 0).y));
}

TEST_CASE("a scene that Blender cannot render identically is refused") {
  const std::string ball = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"n\"\n";
  const auto with = [&](const std::string& material) {
    return refused("[[material]]\nname = \"n\"\n" + material + ball);
  };
  CHECK(with("type = \"phong\"\ndiffuse = { checker = { even = 1, odd = 0, size = 1 } }\n") ==
        "material \"n\" varies, which is not written for Blender");
  CHECK(with("type = \"conductor\"\nmetal = \"gold\"\nroughness = 0.5\n") ==
        "material \"n\" has highlights, which is not written for Blender");
  CHECK(with("type = \"diffuse\"\ncolor = 0.5\nroughness = 0.5\n") ==
        "material \"n\" is rough or coated, which is not written for Blender");
  CHECK(with("type = \"dielectric\"\nior = 1.5\nabsorption = 1\n") ==
        "material \"n\" dims light, which is not written for Blender");
  CHECK(script_has(refused("[[cone]]\nfrom = [0, 0, 0]\nto = [0, 1, 0]\nradius = 1\nmaterial = \"m\"\n"),
                   "a shape that is not written for Blender"));
  CHECK(script_has(refused("[[light]]\ntype = \"point\"\nposition = [0, 1, 0]\nfalloff = \"none\"\n"),
                   "a light that is not written for Blender"));
}
