#include "bench/standard_scenes.hpp"
#include "generate/octasphere.hpp"
#include "loader/scene_file.hpp"
#include "rivals/povray_scene.hpp"
//
#include "support/doctest.hpp"

using namespace eyeray;

namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a scene in POV-Ray's words: camera by its three vectors, light, material, shapes") {
  Scene scene = parse_scene(R"([camera]
eye = [0, 0, 5]
target = [0, 0, 0]
fov = 90
[render]
max_depth = 3
min_weight = 0.01
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
