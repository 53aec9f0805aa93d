#include <cmath>

#include "bytes.hpp"
#include "host/image/srgb.hpp"
#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

const Vec3 halves[2][3] = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}};

// The unit square of two facets as binary STL.
std::string stl_square(const std::string& header, uint32_t first, uint32_t second, double up = 1,
                       uint32_t count = 2) {
  Bytes data(std::endian::little);
  data.add_as("uint", count);
  for (int i = 0; i < 2; ++i) {
    for (const double value : {0.0, 0.0, up}) data.add_as("float", value);
    for (const Vec3& corner : halves[i])
      for (int k = 0; k < 3; ++k) data.add_as("float", corner[k]);
    data.add_as("ushort", i == 0 ? first : second);
  }
  return header + std::string(80 - header.size(), '\0') + data.text();
}

std::string stl_facet(const std::string& vertices) {
  return "facet normal 0 0 1\nouter loop\n" + vertices + "endloop\nendfacet\n";
}

const std::string one_facet = stl_facet("vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n");

}  // namespace

TEST_CASE("STL is read as text and in binary, also where a binary header begins with `solid`") {
  const std::string text =
      "solid two of them\n" + one_facet + "endsolid two of them\r\nSOLID\r\n" +
      "FACET NORMAL 0 0 1\r\nOUTER LOOP\r\nVERTEX 0 0 0\r\nVERTEX +1e0 1 0\r\nVERTEX 0 1 0\r\nENDLOOP\r\n"
      "ENDFACET\r\nENDSOLID";
  for (const std::string& bytes : {text, stl_square("", 0, 0), stl_square("solid cube", 0, 0)}) {
    const ImportedScene scene = import_sound(bytes, "square.STL");
    REQUIRE(scene.meshes.size() == 1);
    CHECK(scene.meshes[0].triangles.size() == 2);
    CHECK(signed_area(scene.meshes[0], {0, 0, 1}) == 2);
    CHECK(scene.meshes[0].colors.empty());
    CHECK(scene.instances[0].material == -1);
    CHECK(scene.warnings.empty());
  }
}

TEST_CASE("facets of STL that share corners are shaded as one surface") {
  // Two faces at an angle of 20 degrees, each with corners of its own.
  const std::string ridge = "solid\n" + stl_facet("vertex 0 0 0\nvertex 0 1 0\nvertex -1 0 -0.176\n") +
                            stl_facet("vertex 0 1 0\nvertex 0 0 0\nvertex 1 0 -0.176\n") + "endsolid\n";
  const ImportedScene smooth = import_sound(ridge, "a.stl");
  REQUIRE(smooth.meshes[0].normals.size() == smooth.meshes[0].positions.size());
  for (size_t i = 0; i < smooth.meshes[0].positions.size(); ++i)
    if (smooth.meshes[0].positions[i].x == 0) CHECK(std::abs(smooth.meshes[0].normals[i].x) < 1e-12);
  CHECK(import_sound(ridge, "a.stl", {.smooth = 0}).meshes[0].normals.empty());
}

TEST_CASE("colours of facets are read, as VisCAM and as Magics write them") {
  const auto colors = [](const std::string& bytes) {
    const ImportedScene scene = import_sound(bytes, "a.stl");
    std::vector<Vec3> found;
    for (const auto& triangle : scene.meshes[0].triangles)
      found.push_back(scene.meshes[0].colors.empty() ? Vec3(-1) : scene.meshes[0].colors[triangle[0]]);
    return found;
  };
  using Colors = std::vector<Vec3>;
  constexpr uint32_t bit = 0x8000;
  // Five bits each: blue lowest in VisCAM's files, red lowest in those of Magics.
  CHECK(colors(stl_square("", bit | 31 << 10, bit | 31)) == Colors{{1, 0, 0}, {0, 0, 1}});
  CHECK(colors(stl_square("", bit | 31 << 5, 0)) == Colors{{0, 1, 0}, Vec3(0.75)});
  CHECK(colors(stl_square("", 31, 7)) == Colors{Vec3(-1), Vec3(-1)});
  const std::string orange = "made by a test COLOR=\xff\x80\x01\xff";
  const Vec3 all(1, image::linear_from_srgb(128 / 255.0), image::linear_from_srgb(1 / 255.0));
  CHECK(colors(stl_square(orange, bit, 31)) == Colors{all, {1, 0, 0}});
  CHECK(colors(stl_square(orange, bit | 31, bit)) == Colors{all, all});
  CHECK(import_sound(stl_square(orange, bit, bit), "a.stl").warnings.empty());
  // Too near to the header's end to have a colour.
  CHECK(colors(stl_square(std::string(72, 'x') + "COLOR=\x01\x01", 0, 0)) == Colors{Vec3(-1), Vec3(-1)});
}

TEST_CASE("a warning states what of an STL is not shown") {
  CHECK(warns(import_sound(stl_square("COLOR=\xff\xff\xff\x80", 0, 0), "a.stl"),
              "transparency of its colours"));
  CHECK(warns(import_sound(stl_square("COLOR=\xff\xff\xff\xff,MATERIAL=abcdefghijkl", 0, 0), "a.stl"),
              "its material (MATERIAL=)"));
  CHECK(warns(import_sound(stl_square("", 0, 0) + "tail", "a.stl"), "4 bytes after its last triangle"));
  CHECK(warns(import_sound(stl_square("", 0, 0, -1), "a.stl"), "the normals of 2 of 2 facets point against"));
  CHECK(import_sound(stl_square("", 0, 0, 0), "a.stl").warnings.empty());
}

TEST_CASE("a wrong STL is refused where it is wrong") {
  CHECK(refusal("", "a.stl") ==
        "a.stl: error: it is no STL: it neither begins with `solid` nor has a header of 84 bytes");
  CHECK(refusal(stl_square("", 0, 0, 1, 4000000000u), "a.stl") ==
        "a.stl: error: its header declares 4000000000 triangles of 50 bytes, but 100 bytes follow");
  CHECK(contains(refusal("solid\nendsolid\n", "a.stl"), "it has no visible triangles"));
  CHECK(refusal("solid\n" + stl_facet("vertex 0 0 0\nvertex 1 x 0\n"), "a.stl")
            .starts_with("a.stl:5:10: error: this is not a number"));
  CHECK(refusal("solid\n" + stl_facet("vertex 0 0 0\nvertex 1 0 0\n"), "a.stl")
            .starts_with("a.stl:6:1: error: `vertex` is missing here"));
  CHECK(contains(refusal("solid\n" + one_facet + one_facet.substr(0, one_facet.find("vertex 1 1")), "a.stl"),
                 "`vertex` is missing here"));
  CHECK(contains(refusal(stl_square("solid", 0, 0).substr(0, 150), "a.stl"),
                 "2 triangles of 50 bytes, but 66 bytes"));
  CHECK(contains(refusal("solid\n" + one_facet + "color 1 0 0\n", "a.stl"), "`facet` is missing here"));
}
