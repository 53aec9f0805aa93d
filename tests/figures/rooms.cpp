// Closed rooms of every kind: paths that bounce about within them, at random and from edge to edge, stay in.
// docs/experiments/rooms.md has the figures; EYERAY_FULL_TESTS=1 makes them.
#include <fmt/format.h>

#include <atomic>
#include <map>
#include <set>
#include <string>

#include "host/core/parallel_for.hpp"
#include "host/loader/scene_file.hpp"
#include "host/pack/pack.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::records;
using test::Random;

namespace {

// A room around the origin, about 1 in each direction, as tables of a scene file; TURNED stands for
// `transform`.
const std::map<std::string, std::string> rooms = {
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
std::map<std::string, std::string> rooms_with_cuts() {
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

// Rooms that still lose some paths (docs/experiments/rooms.md), at most 1 of 10 000.
const std::set<std::string> leaking = {"prism less a ball", "prism cut to a ball", "polygons with holes",
                                       "bilinear", "cone cut off less a ball"};

constexpr const char* cube =
    "v -1 -1 -1\nv -1 -1 1\nv -1 1 -1\nv -1 1 1\nv 1 -1 -1\nv 1 -1 1\nv 1 1 -1\nv 1 1 1\n"
    "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";
// A roof whose faces join at 22 degrees at the eaves.
constexpr const char* roof =
    "v -1 -0.1 -1\nv 1 -0.1 -1\nv 1 -0.1 1\nv -1 -0.1 1\nv -1 0.3 0\nv 1 0.3 0\n"
    "f 1 2 3 4\nf 1 5 6 2\nf 4 3 6 5\nf 1 4 5\nf 2 6 3\n";

constexpr Vec3 positions[] = {{0, 0, 0}, {1000, 0, 0}, {-300, 700, 500}};

// The room turned, stretched and at `position`, as seen from the origin.
PackedScene packed_room(std::string text, const Vec3& position) {
  const std::string turned = fmt::format(
      "transform = [{{ rotate = {{ axis = [1, 2, 3], degrees = 33 }} }}, {{ scale = [3, 2, 2.5] }}, "
      "{{ translate = [{}, {}, {}] }}]\nmaterial = 'm'\n",
      position.x, position.y, position.z);
  for (size_t at; (at = text.find("TURNED")) != std::string::npos;) text.replace(at, 6, turned);
  return pack::pack(
      loader::parse_scene("[camera]\neye = [0, 0, 0]\ntarget = [0, 0, -1]\n[[material]]\nname "
                          "= 'm'\ntype = 'diffuse'\n" +
                              text,
                          "room.toml", {}, {{"cube.obj", cube}, {"roof.obj", roof}}));
}

// The hit of a ray, and the surface there; no slot if it hits nothing.
struct Seen {
  shader::Hit hit;
  shader::Surface surface;
};
Seen look(const shader::Ray& ray) {
  uint32_t flags = 0;
  Seen seen{};
  seen.hit = shader::trace(ray, flags);
  if (seen.hit.slot != NONE) seen.surface = shader::surface_at(shader::primitive_at(seen.hit), ray, seen.hit);
  return seen;
}

bool same_face(const Seen& a, const Seen& b) {
  return a.hit.id == b.hit.id &&
         glm::dot(Vec3(a.surface.normal_geometric), Vec3(b.surface.normal_geometric)) > 0.9;
}

// A direction towards the edge between the faces that `a` and `b` see, where these differ.
glm::vec3 towards_edge(const auto& start, const Vec3& a, const Vec3& b) {
  Vec3 low = a, high = b;
  const Seen there = look(start(glm::vec3(a)));
  for (int i = 0; i < 26; ++i) {
    const Vec3 middle = glm::normalize(low + high);
    (same_face(look(start(glm::vec3(middle))), there) ? low : high) = middle;
  }
  return glm::vec3(low);
}

struct Count {
  std::atomic<int64_t> rays = 0, leaks = 0;
};

// Follows paths of eight rays from points around `position`. Directions are random; if `at_edges`, two of
// three rays go towards an edge.
void follow_paths(const PackedScene& scene, const Vec3& position, bool at_edges, int paths, Count& count) {
  constexpr int parts = 64;
  parallel_for(0, parts, [&](int part) {
    const shader::Binding binding(twin::view_of(scene));
    Random random{uint64_t(part) + 1000 * test::seed() + 7};
    for (int i = 0; i < paths / parts; ++i) {
      const glm::vec3 middle(position + random.point(0.01));
      shader::Surface from{};
      for (int bounce = 0; bounce < 8; ++bounce) {
        const auto direction = [&] {
          const Vec3 d = random.direction();
          return bounce == 0 || glm::dot(d, Vec3(from.normal_geometric)) > 0 ? d : -d;
        };
        const auto start = [&](const glm::vec3& d) {
          return bounce == 0 ? shader::make_ray(middle, d) : shader::spawn_ray(from, d);
        };
        glm::vec3 d(direction());
        if (at_edges && bounce % 3 < 2) d = towards_edge(start, Vec3(d), direction());
        const Seen seen = look(start(d));
        ++count.rays;
        // A ray along a wall may hit either side of the wall.
        const bool outside = seen.hit.slot == NONE || glm::dot(d, seen.surface.normal_geometric) < -1e-6f;
        count.leaks += outside;
        if (outside) break;
        from = shader::face_viewer(seen.surface, false);
      }
    }
  });
}

}  // namespace

// --subcase=NAME follows only the paths in one room.
TEST_CASE("paths that bounce within closed rooms stay inside, at random and from edge to edge") {
  const int paths = test::amount(500, 2'000, 1'250'000);
  for (const auto& [name, text] : rooms_with_cuts()) {
    SUBCASE(name.c_str()) {
      for (const Vec3& position : positions) {
        const PackedScene scene = packed_room(text, position);
        for (const bool at_edges : {false, true}) {
          Count count;
          follow_paths(scene, position, at_edges, at_edges ? paths / 16 : paths, count);
          MESSAGE(fmt::format("{}, {}, {:.0f} away: {} rays, {} leak", name,
                              at_edges ? "at edges" : "at random", glm::length(position), count.rays.load(),
                              count.leaks.load()));
          CHECK(count.leaks <= (leaking.contains(name) ? 1 + paths / 10'000 : 0));
        }
      }
    }
  }
}
