#include "host/image/srgb.hpp"
#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

// The unit square as two triangles, then the same as one polygon.
const std::string off_corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
const std::string off_halves = "OFF\n4 2 0\n" + off_corners + "3 0 1 2\n3 0 2 3\n";

Vec3 off_color(int red, int green, int blue) {
  return {image::linear_from_srgb(red / 255.0), image::linear_from_srgb(green / 255.0),
          image::linear_from_srgb(blue / 255.0)};
}

const Mesh& only_mesh(const ImportedScene& scene) {
  REQUIRE(scene.meshes.size() == 1);
  CHECK(scene.clouds.empty());
  return scene.meshes[0];
}

}  // namespace

TEST_CASE("OFF: comments, line ends of every kind, a missing keyword and missing edges change nothing") {
  for (const std::string& text :
       std::vector<std::string>{off_halves, "OFF 4 2 0\n" + off_corners + "3 0 1 2\n3 0 2 3",
                                "4 2\n" + off_corners + "3 0 1 2\n3 0 2 3\n",
                                "# by hand\r\nOFF # a square\r\n\r\n4 2 5 # and no edges\r\n0 0 0\r\n+1 0 0 "
                                "# x\r\n1e0 1 0\r\n0 1 0\r\n"
                                "# faces\r\n3 0 1 2\r\n  3\t0 2 3 \r\n",
                                "OFF ASCII\r4 2 0\r0 0 0\r1 0 0\r1 1 0\r0 1 0\r3 0 1 2\r3 0 2 3\r"}) {
    const ImportedScene scene = import_sound(text, "a.OFF");
    CHECK(only_mesh(scene).triangles.size() == 2);
    CHECK(signed_area(only_mesh(scene), {0, 0, 1}) == 2);
    CHECK(scene.meshes[0].colors.empty());
    CHECK(scene.instances[0].material == -1);
    CHECK(scene.warnings.empty());
  }
  const ImportedScene polygon = import_sound("OFF\n4 1 0\n" + off_corners + "4 0 1 2 3\n", "a.off");
  CHECK(only_mesh(polygon).triangles.size() == 2);
}

TEST_CASE("OFF: prefixes announce normals, colours and uv of vertices") {
  const ImportedScene scene = import_sound(
      "STCNOFF\n3 1 0\n0 0 0  0 0 2  255 0 0 255  0 0\n1 0 0  0 0 2  0 255 0 255  1 0\n0 1 0  0 0 2  0 0 255 "
      "255  0 1\n"
      "3 0 1 2\n",
      "a.off");
  const Mesh& mesh = only_mesh(scene);
  CHECK(mesh.colors == std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  CHECK(mesh.normals == std::vector<Vec3>(3, Vec3(0, 0, 1)));
  CHECK(mesh.uv == std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}});
  CHECK(scene.warnings.empty());

  // Three numbers and shares are colours, too.
  const ImportedScene shares =
      import_sound("COFF\n3 1 0\n0 0 0 1 0 0\n1 0 0 0 0.5 0\n0 1 0 0 0 1 1\n3 0 1 2\n", "a.off");
  CHECK(only_mesh(shares).colors[0] == Vec3(1, 0, 0));
  CHECK(only_mesh(shares).colors[1].y == doctest::Approx(image::linear_from_srgb(0.5)));
  CHECK(warns(import_sound("COFF\n3 1 0\n0 0 0 9 9 9 7\n1 0 0 9 9 9 255\n0 1 0 9 9 9 3\n3 0 1 2\n", "a.off"),
              "2 of its colors are transparent"));
  CHECK(warns(import_sound("OFF\n3 1 0\n0 0 0 9 9\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off"),
              "2 numbers of its vertices were left out"));
}

TEST_CASE("OFF: faces have colours, grey where others have one, and those of vertices count more") {
  const std::string start = "OFF\n4 2 0\n" + off_corners;
  const ImportedScene scene = import_sound(start + "3 0 1 2  255 0 128\n3 0 2 3\n", "a.off");
  const Mesh& mesh = only_mesh(scene);
  CHECK(mesh.colors[mesh.triangles[0][0]] == off_color(255, 0, 128));
  CHECK(mesh.colors[mesh.triangles[1][0]].x == doctest::Approx(0.75));
  CHECK(scene.warnings.empty());
  CHECK(warns(import_sound(start + "3 0 1 2 1\n3 0 2 3 0.1 0.2 0.3 0.5\n", "a.off"),
              "1 of its faces have a color of neither three nor four numbers"));
  CHECK(warns(import_sound("COFF\n3 1 0\n0 0 0 1 0 0\n1 0 0 0 1 0\n0 1 0 0 0 1\n3 0 1 2 1 1 1\n", "a.off"),
              "the colours of faces were left out: those of vertices are shown"));
}

TEST_CASE("an OFF without faces is a cloud of points") {
  const ImportedScene scene = import_sound("COFF\n2 0 0\n0 0 0 255 0 0\n1 2 3 0 255 0\n", "a.off");
  REQUIRE(scene.clouds.size() == 1);
  CHECK(scene.clouds[0].cloud->positions == std::vector<Vec3>{{0, 0, 0}, {1, 2, 3}});
  CHECK(scene.clouds[0].cloud->colors.size() == 2);
  CHECK(scene.meshes.empty());
}

TEST_CASE("OFF that is faulty is refused at its line") {
  const auto refused = [](const std::string& text, const std::string& at, const std::string& why) {
    CAPTURE(text);
    const std::string message = refusal(text, "a.off");
    CHECK(contains(message, "a.off:" + at));
    CHECK(contains(message, why));
  };
  refused("", "1:1", "the file is empty");
  refused("OFF BINARY\n\1\2\3", "1:1",
          "it is a binary OFF: save it as text, the only form that eyeray reads");
  refused("4OFF\n1 1 1\n", "1:1", "more than three coordinates");
  refused("solid\n", "1:1", "this is not an OFF file");
  refused("CCOFF\n", "1:1", "this is not an OFF file");
  refused("OFF\n", "2:1", "the file ends before the numbers of its vertices and faces");
  refused("OFF\n3\n", "2:1", "here must be the numbers of vertices, faces and edges");
  refused("OFF\n3 1 0 7\n", "2:7", "a line has at most 3 numbers");
  refused("OFF\n-3 1 0\n", "2:1", "the number of vertices is a whole number");
  refused("OFF\n4294967294 4294967294 0\n0 0 0\n", "4:1", "it states 4294967294 vertices, but has 1");
  refused("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "7:1", "it states 2 faces, but has 1");
  refused("OFF\n1 0 0\n0 0\n", "3:1", "a vertex of this file has 3 numbers at least, and this line has 2");
  refused("OFF\n1 0 0\n0 0 x\n", "3:5", "this is not a number");
  refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "6:1", "there is no vertex 3: the file has 3");
  refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 0.5\n", "6:1", "the number of a vertex is a whole number");
  refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4294967294 0 1 2\n", "6:1", "needs as many vertices");
}
