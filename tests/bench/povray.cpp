#include "benchmarks/bench/standard_scenes.hpp"
#include "benchmarks/contenders/povray_scene.hpp"
#include "host/generate/octasphere.hpp"
#include "host/loader/scene_file.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::generate;
using namespace eyeray::engine::contenders;
using namespace eyeray::engine::bench;

namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a scene for POV-Ray has the camera's three vectors, light, material and shapes") {
  Scene scene = parse_scene(R"([camera]
eye = [0, 0, 5]
target = [0, 0, 0]
fov = 90
[render]
max_depth = 3
min_throughput = 0.01
background = [0.1, 0.2, 0.3]
ambient = 0.5
[[light]]
type = "point"
position = [1, 2, 3]
falloff = "none"
intensity = 2
[[material]]
name = "m"
type = "phong"
diffuse = [0.5, 0.25, 1]
ambient = [0.5, 0.5, 0.5]
reflectance = 0.25
specular = 0.75
shininess = 20
[[material]]
name = "g"
type = "dielectric"
ior = 1.5
[[sphere]]
center = [1, 2, 3]
radius = 0.5
material = "m"
[[plane]]
point = [0, -2, 0]
normal = [0, 3, 0]
material = "m"
[[triangle]]
vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
material = "g"
)",
                            "a");
  scene.meshes.push_back(octasphere(1));
  Mat4 transform(1.0);
  transform[3] = Vec4(7, 8, 9, 1);
  scene.instances.push_back({.mesh = 0, .transform = transform, .material = 0, .position = {}});
  const std::string text = povray_scene(scene, 200, 100);
  CHECK(has(text, "max_trace_level 4 adc_bailout 0.01"));
  CHECK(has(text, "background { rgb <0.1,0.2,0.3> }"));
  CHECK(has(text, "location <0,0,5>"));
  CHECK(has(text, "right <2,0,0> up <0,1,0>"));
  CHECK(has(text, "light_source { <1,2,3> color rgb <2,2,2> }"));
  CHECK(has(text,
            "pigment { rgb <0.5,0.25,1> } finish { diffuse 1 ambient rgb <0.5,1,0.25> phong 0.75 "
            "phong_size 20 reflection rgb <0.25,0.25,0.25> }"));
  CHECK(has(text, "sphere {<1,2,3>,0.5 texture {M0}}"));
  CHECK(has(text, "plane {<0,1,0>,-2 texture {M0}}"));
  CHECK(has(text, "triangle {<0,0,0>,<1,0,0>,<0,1,0> texture {M1} interior { ior 1.5 }}"));
  CHECK(has(text, "vertex_vectors {6,"));
  CHECK(has(text, "face_indices {8,"));
  CHECK(has(text, "object { Mesh0 matrix <1,0,0,0,1,0,0,0,1,7,8,9> texture {M0} }"));
}

TEST_CASE("an instanced group is one union for POV-Ray, and each instance refers to it") {
  const std::string text = povray_scene(parse_scene(R"([render]
groups = "instanced"
[[material]]
name = "m"
type = "phong"
[[group]]
batch = { transform = [[{ translate = [1, 2, 3] }], [{ scale = 2 }]] }
[[group.sphere]]
center = [0, 0, 0]
radius = 1
material = "m"
)",
                                                    "a"),
                                        200, 100);
  CHECK(has(text, "#declare Group0 = union {\nsphere {<0,0,0>,1 texture {M0}}\n}\n"));
  CHECK(has(text, "object { Group0 matrix <1,0,0,0,1,0,0,0,1,1,2,3> }"));
  CHECK(has(text, "object { Group0 matrix <2,0,0,0,2,0,0,0,2,0,0,0> }"));
}

TEST_CASE("shapes that are a transformed simple shape are written for POV-Ray with a matrix") {
  const std::string text = povray_scene(parse_scene(R"([camera]
eye = [0, 0, 5]
target = [0, 0, 0]
[[material]]
name = "m"
type = "phong"
[[box]]
min = [-1, -2, -3]
max = [1, 2, 3]
material = "m"
[[cylinder]]
from = [0, -1, 0]
to = [0, 1, 0]
radius = 1
open = true
material = "m"
[[disk]]
center = [4, 5, 6]
normal = [0, 1, 0]
radius = 2
inner_radius = 1
material = "m"
[[paraboloid]]
tip = [0, 0, 0]
to = [0, 1, 0]
radius = 1
material = "m"
[[capsule]]
from = [0, -3, 0]
to = [0, 3, 0]
radius = 2
material = "m"
[[capsule]]
from = [0, -3, 0]
to = [0, 3, 0]
radius = 2
to_radius = 1
material = "m"
[[torus]]
center = [1, 2, 3]
axis = [0, 1, 0]
major_radius = 2
minor_radius = 0.5
material = "m"
[[superellipsoid]]
center = [0, 0, 0]
radii = [1, 2, 3]
e = 0.5
n = 2
material = "m"
[[polygon]]
vertices = [[0, 0, 0], [4, 0, 0], [0, 4, 0]]
holes = [[[1, 1, 0], [1.5, 1, 0], [1.5, 1.5, 0], [1, 1.5, 0]]]
material = "m"
[[parallelogram]]
origin = [0, 0, 0]
edge_u = [1, 0, 0]
edge_v = [0, 1, 0]
material = "m"
[[prism]]
vertices = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
extrusion = [0, 0, 1]
material = "m"
[[quadric]]
square = [4, 0, -1]
product = [0, 2, 0]
linear = [0, -1, 0]
constant = -0.5
min = [-1, -1, -1]
max = [1, 1, 1]
material = "m"
)",
                                                    "a"),
                                        200, 100);
  CHECK(has(text, "box {-1,1 matrix <1,0,0,0,2,0,0,0,3,0,0,0> texture {M0}}"));
  CHECK(has(text,
            "quadric {<1,0,1>,<0,0,0>,<0,0,0>,-1 clipped_by {box {<-2,-1,-2>,<2,1,2>}} matrix "
            "<1,0,0,0,1,0,0,0,1,0,0,0> texture {M0}}"));
  CHECK(has(text, "torus {1,0.25 matrix <2,0,0,0,2,0,0,0,2,1,2,3> texture {M0}}"));
  CHECK(
      has(text,
          "superellipsoid {<0.5,2> matrix <1,0,0,0,0,1,0,1,0,0,0,0> matrix <1,0,0,0,2,0,0,0,3,0,0,0> texture "
          "{M0}}"));
  CHECK(has(text, "polygon {9,<0,0,0>,<4,0,0>,<0,4,0>,<0,0,0>,<1,1,0>,"));
  CHECK(has(text, "polygon {5,<0,0,0>,<1,0,0>,<1,1,0>,<0,1,0>,<0,0,0> texture {M0}}"));
  CHECK(has(text, "prism {linear_sweep linear_spline -1,1,5,<"));
  CHECK(has(text, "disc {0,y,1,0.5 matrix <2,0,0,0,2,0,0,0,2,4,5,6> texture {M0}}"));
  CHECK(has(text,
            "intersection {quadric {<1,0,1>,<0,0,0>,<0,-1,0>,0} box {<-2,0,-2>,<2,1,2>} matrix "
            "<1,0,0,0,1,0,0,0,1,0,0,0> texture {M0}}"));
  CHECK(has(text,
            "merge {cylinder {-y*1.5,y*1.5,1} sphere {-y*1.5,1} sphere {y*1.5,1} matrix "
            "<2,0,0,0,2,0,0,0,2,0,0,0> texture {M0}}"));
  CHECK(has(text, "sphere_sweep {linear_spline 2,-y*1.5,1,y*1.5,0.5 matrix <2,0,0,0,2,0,0,0,2,0,0,0>"));
  CHECK(
      has(text,
          "intersection {quadric {<1,0,-0.25>,<0,0.5,0>,<0,-0.25,0>,-0.125} box {<-1,-1,-1>,<1,1,1>} matrix "
          "<1,0,0,0,1,0,0,0,1,0,0,0> texture {M0}}"));
}

TEST_CASE("a CSG object for POV-Ray is its parts, each with its texture, minus the subtracted parts") {
  const std::string text = povray_scene(parse_scene(R"([camera]
eye = [0, 0, 5]
target = [0, 0, 0]
[[material]]
name = "m"
type = "phong"
[[material]]
name = "n"
type = "phong"
[[csg]]
operation = "intersection"
material = "m"
[[csg.sphere]]
center = [0, 0, 0]
radius = 1
[[csg.box]]
min = [-1, -1, -1]
max = [1, 1, 1]
[[csg.minus.csg]]
[[csg.minus.csg.sphere]]
material = "n"
radius = 0.5
batch = { center = [[1, 0, 0], [-1, 0, 0]] }
)",
                                                    "a"),
                                        200, 100);
  CHECK(has(text,
            "difference {\nintersection {\nsphere {<0,0,0>,1 texture {M0}}\n"
            "box {-1,1 matrix <1,0,0,0,1,0,0,0,1,0,0,0> texture {M0}}\n}\n"
            "merge {\nsphere {<1,0,0>,0.5 texture {M1}}\nsphere {<-1,0,0>,0.5 texture {M1}}\n}\n}\n"));
}
