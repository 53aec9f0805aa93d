// Points without faces: PLY, XYZ and PCD.
#include <cmath>

#include "bytes.hpp"
#include "host/image/srgb.hpp"
#include "host/importers/cloud_builder.hpp"
#include "host/importers/lzf.hpp"
#include "support.hpp"
#include "tests/support/random.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

const PointCloud& only_cloud(const ImportedScene& scene) {
  CHECK(scene.meshes.empty());
  CHECK(scene.instances.empty());
  REQUIRE(scene.clouds.size() == 1);
  return *scene.clouds[0].cloud;
}

glm::vec3 linear(int red, int green, int blue) {
  return glm::vec3(Vec3(image::linear_from_srgb(red / 255.0), image::linear_from_srgb(green / 255.0),
                        image::linear_from_srgb(blue / 255.0)));
}

using Positions = std::vector<Vec3>;
using PointColors = std::vector<glm::vec3>;

const Positions three_points{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
const PointColors three_colors{linear(255, 0, 128), linear(0, 255, 1), linear(7, 8, 9)};
const std::string colored_lines = "0 0 0 255 0 128\n1 0 0 0 255 1\n0 2 0 7 8 9\n";

std::string pcd_header(const std::string& fields, const std::string& sizes, const std::string& type_letters,
                       const std::string& counts, int points, const std::string& data) {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " + sizes +
         "\nTYPE " + type_letters + "\nCOUNT " + counts + "\nWIDTH " + std::to_string(points) +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + std::to_string(points) + "\nDATA " + data + "\n";
}

std::string xyz_rgb_header(const std::string& data) {
  return pcd_header("x y z rgb", "4 4 4 4", "F F F U", "1 1 1 1", 3, data);
}

constexpr uint32_t three_bits[] = {0xff0080, 0x00ff01, 0x070809};

// The three points as PCD, in binary and compressed. The compressed data has literal bytes alone.
std::string pcd_binary() {
  Bytes data;
  for (size_t i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) data.add(float(three_points[i][k]));
    data.add(three_bits[i]);
  }
  return xyz_rgb_header("binary") + data.text();
}

std::string pcd_compressed() {
  Bytes fields;
  for (int k = 0; k < 3; ++k)
    for (size_t i = 0; i < 3; ++i) fields.add(float(three_points[i][k]));
  for (const uint32_t bits : three_bits) fields.add(bits);
  const std::string& whole = fields.text();  // 48 bytes
  std::string packed = std::string(1, '\x1f') + whole.substr(0, 32) + '\x0f' + whole.substr(32);
  Bytes sizes;
  sizes.add(uint32_t(packed.size())).add(uint32_t(whole.size()));
  return xyz_rgb_header("binary_compressed") + sizes.text() + packed;
}

}  // namespace

TEST_CASE("a PLY without faces is a cloud of points, with its colours, and one with faces is a mesh") {
  const std::string vertices = "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n";
  const std::string colors =
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
  const auto text = [](const std::string& header, const std::string& data) {
    return "ply\nformat ascii 1.0\n" + header + "end_header\n" + data;
  };
  const PointCloud plain = only_cloud(import_sound(text(vertices, "0 0 0\n1 0 0\n0 2 0\n"), "a.ply"));
  CHECK(plain.positions == three_points);
  CHECK(plain.colors.empty());

  const std::string lines = "0 0 0 255 0 128 255\n1 0 0 0 255 1 20\n0 2 0 7 8 9 255\n";
  const ImportedScene colored = import_sound(text(vertices + colors, lines), "a.ply");
  CHECK(only_cloud(colored).positions == three_points);
  CHECK(only_cloud(colored).colors == three_colors);
  CHECK(warns(colored, "transparency (alpha) of 1 of its points"));

  const std::string more = "property float nx\nproperty list uchar int x\nproperty float intensity\n";
  CHECK(warns(import_sound(text(vertices + more, "0 0 0 1 0 9\n1 0 0 1 1 5 9\n0 2 0 1 0 9\n"), "a.ply"),
              "3 of its properties were left out: nx, x, intensity"));

  const std::string no_faces = "element face 0\nproperty list uchar int vertex_indices\n";
  CHECK(only_cloud(import_sound(text(vertices + no_faces, "0 0 0\n1 0 0\n0 2 0\n"), "a.ply")).positions ==
        three_points);
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
  const ImportedScene mesh = import_sound(text(vertices + face, "0 0 0\n1 0 0\n0 2 0\n3 0 1 2\n"), "a.ply");
  CHECK(mesh.clouds.empty());
  CHECK(mesh.meshes.size() == 1);
}

TEST_CASE("an OBJ without faces shows all its vertices, one with faces only these") {
  const std::string vertices = "v 0 0 0 1 0 0.5\nv 1 0 0\nv 0 2 0\n";
  const ImportedScene points = import_sound(vertices + "p 1 2\nvn 0 0 1\n", "a.obj");
  CHECK(only_cloud(points).positions == three_points);
  CHECK(only_cloud(points).colors.size() == 3);
  CHECK(only_cloud(points).colors[0].x == 1);
  CHECK(only_cloud(points).colors[1] == glm::vec3(1));
  CHECK(points.warnings.empty());
  CHECK(warns(import_sound(vertices + "l 1 2\n", "a.obj"),
              "1 lines were left out: `line_width` or --line-width shows them"));
  const ImportedScene mesh = import_sound(vertices + "f 1 2 3\np 1\np 2\n", "a.obj");
  CHECK(mesh.clouds.empty());
  CHECK(warns(mesh, "2 points were left out"));
}

TEST_CASE("XYZ: comments, a heading, a count, and line ends of every kind are no points") {
  for (const std::string& text :
       std::vector<std::string>{"0 0 0\n1 0 0\n0 2 0\n", "# x y z\r\n\r\n0 0 0\r\n//1 2 3\r\n1 0 0\r\n0 2 0",
                                "3\r0 0 0\r+1 0 0\r0 2e0 0\r", "  0\t0 0 \n 1 0 0\n\n\n0 2 0  "}) {
    const ImportedScene scene = import_sound(text, "a.XYZ");
    CHECK(only_cloud(scene).positions == three_points);
    CHECK(scene.warnings.empty());
  }
  const ImportedScene headed = import_sound("X Y Z\n0 0 0\n1 0 0\n0 2 0\n", "a.xyz");
  CHECK(only_cloud(headed).positions == three_points);
  CHECK(warns(headed, "its first line was taken as a heading: X Y Z"));
  CHECK(warns(import_sound("4\n0 0 0\n1 0 0\n", "a.xyz"), "its first line states 4 points, but there are 2"));
}

TEST_CASE("XYZ: columns are colours if all are integers to 255, or shares that are no unit vectors") {
  const auto colors = [](const std::string& text) { return only_cloud(import_sound(text, "a.xyz")).colors; };
  CHECK(colors(colored_lines) == three_colors);
  CHECK(import_sound(colored_lines, "a.xyz").warnings.empty());
  // Behind an intensity, and behind normals.
  CHECK(colors("0 0 0 0.5 255 0 128\n1 0 0 -9 0 255 1\n0 2 0 1e3 7 8 9\n") == three_colors);
  CHECK(colors("0 0 0 0 0 1 255 0 128\n1 0 0 0 1 0 0 255 1\n0 2 0 0 0 -1 7 8 9\n") == three_colors);
  CHECK(colors("0 0 0 1 0 0.25\n1 0 0 0 0.5 0\n0 2 0 0 0 0\n").size() == 3);
  // Normals, intensities, and integers that are too great.
  CHECK(colors("0 0 0 0 0 1\n1 0 0 0.6 0.8 0\n").empty());
  CHECK(colors("0 0 0 0 0 1\n1 0 0 0 -1 0\n").empty());
  CHECK(colors("0 0 0 0 0 0\n1 0 0 0 0 0\n").empty());
  CHECK(colors("0 0 0 256 0 1\n1 0 0 3 1 0\n").empty());
  CHECK(warns(import_sound("0 0 0 7\n1 0 0 8\n", "a.xyz"), "1 of its 4 columns were left out: only x y z"));
  CHECK(warns(import_sound("0 0 0 9 9 9 0\n1 0 0 9 9 9 0.5\n", "a.xyz"), "1 of its 7 columns were left out"));
}

TEST_CASE("PCD is read as text, in binary and compressed") {
  const std::string text = xyz_rgb_header("ascii") + "0 0 0 16711808\n1 0 0 65281\n0 2 0 460809\n";
  for (const std::string& bytes : {text, pcd_binary(), pcd_compressed()}) {
    const ImportedScene scene = import_sound(bytes, "a.pcd");
    CHECK(only_cloud(scene).positions == three_points);
    CHECK(only_cloud(scene).colors == three_colors);
    CHECK(scene.warnings.empty());
  }
}

TEST_CASE("PCD: packed floats are colours, padding is nothing, and other fields are counted") {
  Bytes data;
  for (size_t i = 0; i < 3; ++i) {
    data.add(uint16_t(7));
    for (int k = 0; k < 3; ++k) data.add(three_points[i][k]);
    data.add(float(1)).add(float(2)).add(uint8_t(0)).add(uint8_t(0)).add(std::bit_cast<float>(three_bits[i]));
  }
  const std::string header = pcd_header("ring x y z normal_x intensity _ rgb", "2 8 8 8 4 4 1 4",
                                        "U F F F F F U F", "1 1 1 1 1 1 2 1", 3, "binary");
  const ImportedScene scene = import_sound(header + data.text(), "a.pcd");
  CHECK(only_cloud(scene).positions == three_points);
  CHECK(only_cloud(scene).colors == three_colors);
  REQUIRE(scene.warnings.size() == 1);
  CHECK(warns(scene, "3 of its fields were left out: ring, normal_x, intensity"));

  std::string moved = pcd_binary();
  moved.replace(moved.find("VIEWPOINT 0 0 0"), 15, "VIEWPOINT 5 0 0");
  CHECK(warns(import_sound(moved, "a.pcd"), "its VIEWPOINT was left out"));
}

TEST_CASE("points that are not finite are left out and counted") {
  const ImportedScene scene = import_sound("0 0 0\nnan nan nan\n1 0 0\n0 inf 0\n0 2 0\n0 0 1e13\n", "a.xyz");
  CHECK(only_cloud(scene).positions == three_points);
  CHECK(warns(scene, "3 of its 6 points were left out: their coordinates are not finite or beyond 1e12"));
  CHECK(contains(refusal("nan nan nan\n", "a.xyz"),
                 "no visible triangles, points or lines; 1 of its 1 points"));
}

TEST_CASE("the radius follows from the spacing, unless a size is given") {
  std::string grid;
  for (int i = 0; i < 30; ++i)
    for (int k = 0; k < 30; ++k)
      grid += std::to_string(i * 0.5 + 1e6) + " 0 " + std::to_string(k * 0.5) + "\n";
  CHECK(only_cloud(import_sound(grid, "a.xyz")).radius == doctest::Approx(0.5 * 0.75));
  // A second scan of the same points changes nothing.
  CHECK(only_cloud(import_sound(grid + grid, "a.xyz")).radius == doctest::Approx(0.5 * 0.75));
  CHECK(only_cloud(import_sound(grid, "a.xyz", {.point_size = 3})).radius == 1.5);
  // Spheres around points at random are larger, so that few gaps are left.
  Random random{1};
  std::string scattered;
  for (int i = 0; i < 900; ++i)
    scattered += fmt::format("{} 0 {}\n", random.uniform(0, 15), random.uniform(0, 15));
  const double radius = only_cloud(import_sound(scattered, "a.xyz")).radius;
  CHECK(radius > 1.5 * 0.5 * 0.75);
  CHECK(radius < 2 * 0.5 * 0.75);
  CHECK(closing_radius(three_points) > 1);
  CHECK(closing_radius(three_points) < 3);
  CHECK(only_cloud(import_sound("100 0 0\n100 0 0\n", "a.xyz")).radius == 1);
  CHECK(only_cloud(import_sound("0 0 0\n", "a.xyz")).radius == 1);
}

TEST_CASE("LZF: literal bytes, copies that overlap, and damaged data") {
  using namespace std::string_literals;
  const auto plain = [](const std::string& packed, size_t size) {
    return decompress_lzf(packed, size).value_or("damaged");
  };
  CHECK(plain("", 0) == "");
  CHECK(plain("\2"s + "abc", 3) == "abc");
  CHECK(plain("\0"s + "a" + "\x20\0"s, 4) == "aaaa");
  CHECK(plain("\1"s + "ab" + "\xe0\3\1"s, 14) == "ababababababab");
  CHECK(plain("\5"s + "abc", 6) == "damaged");  // ends too early
  CHECK(plain("\0"s + "a" + "\x20"s, 4) == "damaged");
  CHECK(plain("\0"s + "a" + "\xe0"s, 4) == "damaged");
  CHECK(plain("\0"s + "a" + "\x20\1"s, 4) == "damaged");  // refers to bytes before the first
  CHECK(plain("\0"s + "a" + "\x20\0"s, 3) == "damaged");  // becomes more than it should
  CHECK(plain("\2"s + "abc", 2) == "damaged");
  CHECK(plain("\0"s + "a", 2) == "damaged");  // becomes less
}

TEST_CASE("a wrong file of points is refused where it is wrong") {
  CHECK(refusal("0 0 0\n1 0 x\n", "a.xyz").starts_with("a.xyz:2:5: error: this is not a number"));
  CHECK(refusal("0 0 0\n1 0\n", "a.xyz").starts_with("a.xyz:2:1: error: a point needs three numbers, x y z"));
  CHECK(refusal("0 0 0\n1 0 0 7\n", "a.xyz")
            .starts_with("a.xyz:2:1: error: this line has 4 numbers, but the first point has 3"));
  CHECK(contains(refusal("x y z\nsecond heading\n", "a.xyz"), "a.xyz:2:1: error: this is not a number"));
  CHECK(contains(refusal("", "a.xyz"), "no visible triangles, points or lines"));
  CHECK(contains(refusal("1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17\n", "a.xyz"), "at most 16 numbers"));

  const auto pcd = [](const std::string& from, const std::string& to) {
    std::string bytes = pcd_binary();
    bytes.replace(bytes.find(from), from.size(), to);
    return refusal(bytes, "a.pcd");
  };
  CHECK(contains(refusal("", "a.pcd"), "this is not a PCD file: it has no header"));
  CHECK(pcd("FIELDS x", "FIELDS w")
            .starts_with("a.pcd: error: the points must have the fields x, y and z, each of TYPE F"));
  CHECK(contains(pcd("TYPE F F", "TYPE F I"), "each of TYPE F and COUNT 1"));
  CHECK(contains(pcd("SIZE 4 4 4 4", "SIZE 4 4 4"), "there are 4 FIELDS, but 3 values of SIZE"));
  CHECK(contains(pcd("TYPE F", "TYPE Q"), "a field of type Q and of 4 bytes is not supported"));
  CHECK(contains(pcd("COUNT 1", "COUNT 9999999"), "a field of 9999999 values"));
  CHECK(pcd("HEIGHT 1", "HEIGHT -1").starts_with("a.pcd:8:1: error: `-1` is not a whole number"));
  CHECK(pcd("VERSION", "REVISION").starts_with("a.pcd:2:1: error: `REVISION` is not a statement"));
  CHECK(contains(pcd("DATA binary", "DATA zip"), "write DATA ascii, binary or binary_compressed"));
  CHECK(contains(pcd("POINTS 3", "POINTS 4"), "4 POINTS differ from WIDTH 3 times HEIGHT 1"));
  CHECK(contains(refusal(xyz_rgb_header("binary"), "a.pcd"), "states 3 points, more than the file's"));
}

TEST_CASE("a header that states absurd numbers of points is refused") {
  const auto huge = [](const std::string& data, const std::string& rest) {
    std::string bytes = xyz_rgb_header(data);
    for (const std::string& word : std::vector<std::string>{"WIDTH 3", "POINTS 3"})
      bytes.replace(bytes.find(word), word.size(), word.substr(0, word.size() - 1) + "18446744073709551615");
    return refusal(bytes + rest, "a.pcd");
  };
  CHECK(contains(huge("ascii", "0 0 0 0\n"), "18446744073709551615 points, more than the file's"));
  CHECK(contains(huge("binary", "0123456789abcdef"), "18446744073709551615 points, more than the file's"));
  CHECK(contains(huge("binary_compressed", std::string("\x02\0\0\0\x10\0\0\0\0a", 10)),
                 "18446744073709551615 points, more than the file's"));
  std::string bytes = pcd_compressed();
  const size_t sizes = bytes.find("compressed\n") + 11;
  bytes.replace(sizes + 4, 4, "\xff\xff\xff\xff");
  CHECK(contains(refusal(bytes, "a.pcd"), "cannot be decompressed to 4294967295"));
  bytes.replace(sizes, 4, "\xff\xff\xff\xff");
  CHECK(contains(refusal(bytes, "a.pcd"), "its data has 4294967295 bytes, but"));
}

TEST_CASE("points become disks by the normals of every format") {
  const ImportOptions disks{.point_shape = PointShape::disk};
  const std::vector<glm::vec3> expected{{0, 0, 1}, {0, -1, 0}, {0.6f, 0.8f, 0}};
  const auto check = [&](const std::string& bytes, const std::string& name, bool colors = false) {
    CAPTURE(name);
    const ImportedScene scene = import_sound(bytes, name, disks);
    CHECK(scene.warnings.empty());
    const PointCloud& cloud = only_cloud(scene);
    CHECK(cloud.positions == three_points);
    CHECK(cloud.colors.size() == (colors ? 3 : 0));
    REQUIRE(cloud.normals.size() == 3);
    for (size_t i = 0; i < 3; ++i) CHECK(glm::length(cloud.normals[i] - expected[i]) < 1e-6f);
    CHECK(only_cloud(import_sound(bytes, name)).normals.empty());
  };
  const std::string rows = "0 0 0 0 0 1\n1 0 0 0 -2 0\n0 2 0 0.6 0.8 0\n";
  const std::string unit_rows = "0 0 0 0 0 1\n1 0 0 0 -1 0\n0 2 0 0.6 0.8 0\n";
  std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\n";
  for (const char* property : {"x", "y", "z", "nx", "ny", "nz"})
    ply += std::string("property float ") + property + "\n";
  check(ply + "end_header\n" + rows, "a.ply");
  check("NOFF\n3 0 0\n" + rows, "a.off");
  check("v 0 0 0\nvn 0 0 1\nv 1 0 0\nvn 0 -2 0\nv 0 2 0\nvn 0.6 0.8 0\n", "a.obj");
  check(unit_rows, "a.xyz");
  check("0 0 0 0 0 1 9 0 255\n1 0 0 0 -1 0 9 0 255\n0 2 0 0.6 0.8 0 9 0 255\n", "a.xyz", true);
  check("0 0 0 9 0 255 0 0 1\n1 0 0 9 0 255 0 -1 0\n0 2 0 9 0 255 0.6 0.8 0\n", "a.xyz", true);

  const std::string fields = "x y z normal_x normal_y normal_z", sizes = "4 4 4 4 4 4",
                    letters = "F F F F F F", counts = "1 1 1 1 1 1";
  check(pcd_header(fields, sizes, letters, counts, 3, "ascii") + rows, "a.pcd");
  Bytes data;
  for (size_t i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) data.add(float(three_points[i][k]));
    for (int k = 0; k < 3; ++k) data.add(3 * expected[i][k]);
  }
  check(pcd_header(fields, sizes, letters, counts, 3, "binary") + data.text(), "a.pcd");
}

TEST_CASE("disks turn upright with their file, and a point whose normal has no direction is a sphere") {
  const ImportOptions upright{.point_shape = PointShape::disk, .up = UpAxis::z};
  CHECK(only_cloud(import_sound("0 0 0 0 0 1\n1 0 0 0 1 0\n", "a.xyz", upright)).normals ==
        std::vector<glm::vec3>{{0, 1, 0}, {0, 0, -1}});
  const std::string off = "NOFF\n4 0 0\n0 0 0 0 0 1\n1 0 0 0 0 0\nnan 0 0 1 0 0\n2 0 0 0 nan 1\n";
  const ImportedScene scene = import_sound(off, "a.off", {.point_shape = PointShape::disk});
  CHECK(warns(scene, "2 of its points have no normal, and are shown as spheres"));
  CHECK(only_cloud(scene).normals == std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 0}, {0, 0, 0}});
}

TEST_CASE("a file without normals is not shown as disks") {
  const ImportOptions disks{.point_shape = PointShape::disk};
  const std::string why = "error: its points have no normals, which disks need: show them as spheres";
  for (const auto& [bytes, name] :
       std::vector<std::pair<std::string, std::string>>{{"0 0 0\n1 0 0\n", "a.xyz"},
                                                        {colored_lines, "a.xyz"},
                                                        {"v 0 0 0\nv 1 0 0\nvn 0 0 1\n", "a.obj"},
                                                        {"OFF\n1 0 0\n0 0 0\n", "a.off"},
                                                        {pcd_binary(), "a.pcd"}}) {
    CHECK(contains(refusal(bytes, name, disks), name + ": " + why));
  }
}
