// Closed rooms of every kind, which no light may enter.
#pragma once

#include <fmt/format.h>

#include <map>
#include <string>

#include "host/loader/scene_file.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::test {

// A room around the origin, about 1 in each direction, as tables of a scene file; TURNED stands for
// `transform`.
inline const std::map<std::string, std::string> rooms = {
    {"mesh", "[[mesh]]\nfile = 'cube.obj'\nsmooth = 0\nTURNED"},
    {"instances of a mesh", R"(
[[mesh]]
file = "cube.obj"
smooth = 0
TURNED
[[mesh]]
file = "cube.obj"
transform = [{ translate = [0, 100, 0] }]
)"},
    {"mesh of sharp edges", "[[mesh]]\nfile = 'roof.obj'\nsmooth = 0\nTURNED"},
    {"mesh with an edge into the room", "[[mesh]]\nfile = 'ell.obj'\nsmooth = 0\nTURNED"},
    {"box", "[[box]]\nmin = [-1, -1, -1]\nmax = [1, 1, 1]\nTURNED"},
    {"parallelograms", R"(
[[parallelogram]]
origin = [-1, -1, -1]
edge_u = [0, 2, 0]
edge_v = [2, 0, 0]
TURNED
[[parallelogram]]
origin = [-1, -1, 1]
edge_u = [2, 0, 0]
edge_v = [0, 2, 0]
TURNED
[[parallelogram]]
origin = [-1, -1, -1]
edge_u = [0, 0, 2]
edge_v = [0, 2, 0]
TURNED
[[parallelogram]]
origin = [1, -1, -1]
edge_u = [0, 2, 0]
edge_v = [0, 0, 2]
TURNED
[[parallelogram]]
origin = [-1, -1, -1]
edge_u = [2, 0, 0]
edge_v = [0, 0, 2]
TURNED
[[parallelogram]]
origin = [-1, 1, -1]
edge_u = [0, 0, 2]
edge_v = [2, 0, 0]
TURNED
)"},
    {"planes", R"(
[[plane]]
point = [-1, 0, 0]
normal = [-1, 0, 0]
TURNED
[[plane]]
point = [1, 0, 0]
normal = [1, 0, 0]
TURNED
[[plane]]
point = [0, -1, 0]
normal = [0, -1, 0]
TURNED
[[plane]]
point = [0, 1, 0]
normal = [0, 1, 0]
TURNED
[[plane]]
point = [0, 0, -1]
normal = [0, 0, -1]
TURNED
[[plane]]
point = [0, 0, 1]
normal = [0, 0, 1]
TURNED
)"},
    {"cylinder", "[[cylinder]]\nfrom = [0, -1, 0]\nto = [0, 1, 0]\nradius = 1\nTURNED"},
    {"open cylinder and disks", R"(
[[cylinder]]
from = [0, -1, 0]
to = [0, 1, 0]
radius = 1
open = true
TURNED
[[disk]]
center = [0, -1, 0]
normal = [0, -1, 0]
radius = 1
TURNED
[[disk]]
center = [0, 1, 0]
normal = [0, 1, 0]
radius = 1
TURNED
)"},
    {"cone", "[[cone]]\nfrom = [0, -1, 0]\nto = [0, 1, 0]\nradius = 1\nTURNED"},
    {"cone cut off", "[[cone]]\nfrom = [0, -1, 0]\nto = [0, 1, 0]\nradius = 1\nto_radius = 0.3\nTURNED"},
    {"prism", R"(
[[prism]]
vertices = [[-1, -1, -1], [1, -1, -1], [1, -1, 1], [0.5, -1, 0.2], [-1, -1, 1]]
holes = [[[-0.6, -1, -0.6], [-0.3, -1, -0.6], [-0.3, -1, -0.3]]]
extrusion = [0.2, 2, 0]
TURNED
)"},
    {"polygons with holes", R"(
[[polygon]]
vertices = [[-1, -1, -1], [1, -1, -1], [1, -1, 1], [0.5, -1, 0.2], [-1, -1, 1]]
holes = [[[-0.6, -1, -0.6], [-0.3, -1, -0.6], [-0.3, -1, -0.3]]]
TURNED
[[polygon]]
vertices = [[-0.8, 1, 1], [0.7, 1, 0.2], [1.2, 1, 1], [1.2, 1, -1], [-0.8, 1, -1]]
holes = [[[-0.4, 1, -0.6], [-0.1, 1, -0.6], [-0.1, 1, -0.3]]]
TURNED
[[polygon]]
vertices = [[-1, -1, -1], [-0.8, 1, -1], [1.2, 1, -1], [1, -1, -1]]
TURNED
[[polygon]]
vertices = [[1, -1, -1], [1.2, 1, -1], [1.2, 1, 1], [1, -1, 1]]
TURNED
[[polygon]]
vertices = [[1, -1, 1], [1.2, 1, 1], [0.7, 1, 0.2], [0.5, -1, 0.2]]
TURNED
[[polygon]]
vertices = [[0.5, -1, 0.2], [0.7, 1, 0.2], [-0.8, 1, 1], [-1, -1, 1]]
TURNED
[[polygon]]
vertices = [[-1, -1, 1], [-0.8, 1, 1], [-0.8, 1, -1], [-1, -1, -1]]
TURNED
[[polygon]]
vertices = [[-0.6, -1, -0.6], [-0.3, -1, -0.6], [-0.1, 1, -0.6], [-0.4, 1, -0.6]]
TURNED
[[polygon]]
vertices = [[-0.3, -1, -0.6], [-0.3, -1, -0.3], [-0.1, 1, -0.3], [-0.1, 1, -0.6]]
TURNED
[[polygon]]
vertices = [[-0.3, -1, -0.3], [-0.6, -1, -0.6], [-0.4, 1, -0.6], [-0.1, 1, -0.3]]
TURNED
)"},
    {"paraboloid", "[[paraboloid]]\ntip = [0, -1, 0]\nto = [0, 1, 0]\nradius = 1\nTURNED"},
    {"hyperboloid", R"(
[[hyperboloid]]
from = [0, -1, 0]
to = [0, 1, 0]
radius = 1
to_radius = 0.7
waist = 0.4
TURNED
)"},
    {"quadric", R"(
[[quadric]]
square = [1, 1, 0.5]
linear = [0.3, 0, 0]
constant = -1
min = [-0.8, -0.9, -0.8]
max = [0.8, 0.9, 0.8]
TURNED
)"},
    {"sphere", "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nTURNED"},
    {"ellipsoid", "[[ellipsoid]]\ncenter = [0, 0, 0]\nradii = [1, 0.5, 0.3]\nTURNED"},
    {"capsule", "[[capsule]]\nfrom = [-0.5, 0, 0]\nto = [0.5, 0, 0]\nradius = 0.5\nTURNED"},
    {"torus", "[[torus]]\ncenter = [-0.7, 0, 0]\nmajor_radius = 0.7\nminor_radius = 0.3\nTURNED"},
    {"superellipsoid", "[[superellipsoid]]\ncenter = [0, 0, 0]\nradii = [1, 1, 1]\ne = 0.2\nn = 0.2\nTURNED"},
    {"bilinear", R"(
[[bilinear]]
corners = [[-1.2, -1, 1], [-1, 1, 1.3], [-0.9, 1, -0.8], [-1, -0.8, -1]]
TURNED
[[bilinear]]
corners = [[1.1, -1, -1], [1, 1.1, -1.2], [1.2, 1.5, 1], [1, -1.2, 1.1]]
TURNED
[[bilinear]]
corners = [[1.1, -1, -1], [1, -1.2, 1.1], [-1.2, -1, 1], [-1, -0.8, -1]]
TURNED
[[bilinear]]
corners = [[-0.9, 1, -0.8], [-1, 1, 1.3], [1.2, 1.5, 1], [1, 1.1, -1.2]]
TURNED
[[bilinear]]
corners = [[-0.9, 1, -0.8], [1, 1.1, -1.2], [1.1, -1, -1], [-1, -0.8, -1]]
TURNED
[[bilinear]]
corners = [[-1.2, -1, 1], [1, -1.2, 1.1], [1.2, 1.5, 1], [-1, 1, 1.3]]
TURNED
)"},
    {"union", R"(
[[csg]]
TURNED
[[csg.box]]
min = [-1, -1, -1]
max = [1, 1, 0.3]
[[csg.cylinder]]
from = [0, 0, 0]
to = [0, 0, 1.5]
radius = 0.8
)"},
};

// The rooms, and some closed shapes also as parts of CSG objects: cut to a ball, and with a ball cut out.
inline std::map<std::string, std::string> rooms_with_cuts() {
  std::map<std::string, std::string> all = rooms;
  for (const char* name : {"box", "cylinder", "cone", "cone cut off", "prism", "paraboloid", "hyperboloid",
                           "quadric", "sphere", "ellipsoid", "capsule", "torus", "superellipsoid"}) {
    std::string leaf = rooms.at(name);
    leaf.replace(leaf.find("[["), 2, "[[csg.").erase(leaf.find("TURNED"), 6);
    all[fmt::format("{} cut to a ball", name)] = "[[csg]]\noperation = 'intersection'\nTURNED\n" + leaf +
                                                 "[[csg.sphere]]\ncenter = [0.2, 0.1, -0.1]\nradius = 0.7\n";
    all[fmt::format("{} less a ball", name)] =
        "[[csg]]\nTURNED\n" + leaf + "[[csg.minus.sphere]]\ncenter = [0.5, 0.4, 0.4]\nradius = 0.7\n";
  }
  return all;
}

inline constexpr Vec3 room_positions[] = {{0, 0, 0}, {1000, 0, 0}, {-300, 700, 500}};

// `text` with the room turned, stretched and moved to `position`, after `head`, which has a camera and
// material 'm'.
inline Scene scene_of_room(const std::string& head, std::string text, const Vec3& position) {
  constexpr const char* cube =
      "v -1 -1 -1\nv -1 -1 1\nv -1 1 -1\nv -1 1 1\nv 1 -1 -1\nv 1 -1 1\nv 1 1 -1\nv 1 1 1\n"
      "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";
  // A roof whose faces join at 22 degrees at the eaves.
  constexpr const char* roof =
      "v -1 -0.1 -1\nv 1 -0.1 -1\nv 1 -0.1 1\nv -1 -0.1 1\nv -1 0.3 0\nv 1 0.3 0\n"
      "f 1 2 3 4\nf 1 5 6 2\nf 4 3 6 5\nf 1 4 5\nf 2 6 3\n";
  // A prism over an L.
  constexpr const char* ell =
      "v -1 -1 -1\nv 1 -1 -1\nv 1 -1 0.2\nv 0.1 -1 0.3\nv 0.2 -1 1\nv -1 -1 1\n"
      "v -1 1 -1\nv 1 1 -1\nv 1 1 0.2\nv 0.1 1 0.3\nv 0.2 1 1\nv -1 1 1\n"
      "f 4 5 6\nf 4 6 1\nf 4 1 2\nf 4 2 3\nf 10 12 11\nf 10 7 12\nf 10 8 7\nf 10 9 8\n"
      "f 1 7 8 2\nf 2 8 9 3\nf 3 9 10 4\nf 4 10 11 5\nf 5 11 12 6\nf 6 12 7 1\n";
  const std::string turned = fmt::format(
      "transform = [{{ rotate = {{ axis = [1, 2, 3], degrees = 33 }} }}, {{ scale = [3, 2, 2.5] }}, "
      "{{ translate = [{}, {}, {}] }}]\nmaterial = 'm'\n",
      position.x, position.y, position.z);
  for (size_t at; (at = text.find("TURNED")) != std::string::npos;) text.replace(at, 6, turned);
  return loader::parse_scene(head + text, "room.toml", {},
                             {{"cube.obj", cube}, {"roof.obj", roof}, {"ell.obj", ell}});
}

}  // namespace eyeray::engine::test
