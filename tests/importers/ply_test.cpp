#include "bytes.hpp"
#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

const Vec2 ply_outline[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

std::string header(const std::string& format, const std::string& rest) {
  return "ply\nformat " + format + " 1.0\ncomment made by a test\n" + rest + "end_header\n";
}

void check_ply_square(const ImportedScene& scene) {
  REQUIRE(scene.meshes.size() == 1);
  CHECK(scene.meshes[0].positions.size() == 4);
  CHECK(scene.meshes[0].triangles.size() == 2);
  CHECK(signed_area(scene.meshes[0], {0, 0, 1}) == 2);
  CHECK(scene.instances[0].material == -1);
}

const char* const ply_types[] = {"char", "uchar", "short", "ushort", "int",   "uint",   "float",   "double",
                                 "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};

std::string ascii(const std::string& vertices, const std::string& faces) {
  return header("ascii",
                "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                "element face 1\nproperty list uchar int vertex_indices\n") +
         vertices + faces;
}

}  // namespace

TEST_CASE("every type of coordinate, index and list length is read, in every byte order") {
  for (const auto& pair : {std::pair("binary_little_endian", std::endian::little),
                           std::pair("binary_big_endian", std::endian::big)}) {
    const char* const format = pair.first;
    const std::endian order = pair.second;
    for (const std::string coordinate : ply_types) {
      for (const std::string index : ply_types) {
        for (const std::string length : ply_types) {
          if (length.starts_with("float") || length == "double") continue;
          CAPTURE(format);
          CAPTURE(coordinate);
          CAPTURE(index);
          CAPTURE(length);
          Bytes data(order);
          for (const Vec2& p : ply_outline)
            data.add_as(coordinate, p.x).add_as(coordinate, p.y).add_as(coordinate, 0);
          data.add_as(length, 4);
          for (int i = 0; i < 4; ++i) data.add_as(index, i);
          check_ply_square(import_sound(
              header(format, fmt::format("element vertex 4\nproperty {0} x\nproperty {0} y\nproperty {0} z\n"
                                         "element face 1\nproperty list {1} {2} vertex_indices\n",
                                         coordinate, length, index)) +
                  data.text(),
              "a.ply"));
        }
      }
    }
  }
}

TEST_CASE("text is read with any spaces and line breaks") {
  check_ply_square(import_sound(ascii("0 0 0\n1 0 0\n1 1 0\n0 1 0\n", "4 0 1 2 3\n"), "a.ply"));
  check_ply_square(import_sound(ascii("0 0 0  +1 0 0\r\n1e0 1.0 -0 0 1 0", "\t4 0 1\n2 3"), "A.PLY"));
  std::string windows = ascii("0 0 0\n1 0 0\n1 1 0\n0 1 0\n", "4 0 1 2 3\n");
  for (size_t at = 0; (at = windows.find('\n', at)) != std::string::npos; at += 2) windows.insert(at, "\r");
  check_ply_square(import_sound(windows, "a.ply"));
}

TEST_CASE("other elements and properties are skipped, wherever they are") {
  Bytes data;
  data.add(uint8_t(2)).add(1.5f).add(2.5f);
  data.add(uint8_t(3)).add(int16_t(0)).add(int16_t(1)).add(int16_t(2)).add(7.0);
  for (const Vec2& p : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}) {
    data.add(uint8_t(200)).add(float(p.y)).add(uint8_t(1)).add(9).add(p.x).add(0.0f);
    data.add(0.0f).add(0.0f).add(2.0f).add(float(5 * p.x)).add(float(-p.y));
  }
  const ImportedScene scene = import_sound(
      header("binary_little_endian",
             "obj_info x\nelement before 1\nproperty list uchar float things\n"
             "element face 1\nproperty list uchar short vertex_index\nproperty double weight\n"
             "element vertex 3\nproperty uchar red\nproperty float y\nproperty list uchar int marks\n"
             "property double x\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
             "property float s\nproperty float t\nelement nothing 5\n") +
          data.text(),
      "a.ply");
  const Mesh& mesh = scene.meshes[0];
  REQUIRE(mesh.triangles.size() == 1);
  CHECK(mesh.positions[1] == Vec3(1, 0, 0));
  CHECK(mesh.normals[1] == Vec3(0, 0, 1));
  CHECK(mesh.uv == std::vector<Vec2>{{0, 0}, {5, 0}, {0, -1}});
  CHECK(mesh.colors.empty());  // red alone is no colour
  CHECK(scene.warnings.empty());
}

TEST_CASE("vertex colours of every type are sRGB codes") {
  for (const auto& [type, one] :
       {std::pair("uchar", 255.0), std::pair("ushort", 65535.0), std::pair("float", 1.0)}) {
    for (const std::string prefix : {"", "diffuse_"}) {
      const std::string of_type = type;
      CAPTURE(of_type);
      Bytes data;
      for (const Vec2& p : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}) {
        data.add(float(p.x)).add(float(p.y)).add(0.0f);
        data.add_as(type, p.x * one).add_as(type, one).add_as(type, std::floor(0.6 * one * p.y));
      }
      data.add(uint8_t(3)).add(0).add(1).add(2);
      const ImportedScene scene = import_sound(
          header("binary_little_endian",
                 fmt::format("element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                             "property {0} {1}red\nproperty {0} {1}green\nproperty {0} {1}blue\n"
                             "element face 1\nproperty list uchar int vertex_indices\n",
                             type, prefix)) +
              data.text(),
          "a.ply");
      const std::vector<Vec3>& colors = scene.meshes[0].colors;
      REQUIRE(colors.size() == 3);
      CHECK(colors[0] == Vec3(0, 1, 0));
      CHECK(colors[1] == Vec3(1, 1, 0));
      if (one > 1) CHECK(colors[2].z == doctest::Approx(0.3185).epsilon(1e-3));
    }
  }
}

TEST_CASE("every name of uv is read") {
  for (const auto& [u, v] : {std::pair("s", "t"), std::pair("u", "v"), std::pair("texture_u", "texture_v"),
                             std::pair("texture_s", "texture_t")}) {
    const ImportedScene scene = import_sound(
        header("ascii", fmt::format("element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                    "property float {}\nproperty float {}\nelement face 1\n"
                                    "property list uchar int vertex_indices\n",
                                    u, v)) +
            "0 0 0 5 6 1 0 0 7 8 0 1 0 9 10 3 0 1 2",
        "a.ply");
    CHECK(scene.meshes[0].uv == std::vector<Vec2>{{5, 6}, {7, 8}, {9, 10}});
  }
}

TEST_CASE("strips of triangles flip every other triangle") {
  const ImportedScene scene =
      import_sound(header("ascii",
                          "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
                          "element tristrips 1\nproperty list int int vertex_indices\n") +
                       "0 0 0 1 0 0 0 1 0 1 1 0 0 2 0 1 2 0\n11 0 1 2 3 4 -1 2 3 4 5 -1\n",
                   "a.ply");
  CHECK(scene.meshes[0].triangles.size() == 5);
  CHECK(signed_area(scene.meshes[0], {0, 0, 1}) == 5);
}

TEST_CASE("lines of PLY may end with CR alone, or with CR LF") {
  const std::string text = ascii("0 0 0\n1 0 0\n1 1 0\n0 1 0\n", "4 0 1 2 3\n");
  const auto ending = [](const std::string& lines, const std::string& end) {
    std::string ended;
    for (const char c : lines) ended += c == '\n' ? end : std::string(1, c);
    return ended;
  };
  // The first byte of the data, 10, is also that of a line break.
  Bytes data;
  data.add(uint8_t(10)).add(uint8_t(0)).add(uint8_t(0));
  data.add(uint8_t(11)).add(uint8_t(0)).add(uint8_t(0));
  data.add(uint8_t(10)).add(uint8_t(2)).add(uint8_t(0));
  data.add(uint8_t(3)).add(uint8_t(0)).add(uint8_t(1)).add(uint8_t(2));
  const std::string binary = header("binary_little_endian",
                                    "element vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
                                    "element face 1\nproperty list uchar uchar vertex_indices\n");
  for (const std::string end : {"\n", "\r", "\r\n"}) {
    CAPTURE(end.size());
    check_ply_square(import_sound(ending(text, end), "a.ply"));
    const ImportedScene scene = import_sound(ending(binary, end) + data.text(), "a.ply");
    CHECK(scene.meshes[0].triangles.size() == 1);
    CHECK(signed_area(scene.meshes[0], {0, 0, 1}) == 2);
    CHECK(refusal(ending("ply\nelement vertex -1\n", end), "a.ply") ==
          "a.ply:2:1: error: `-1` is not a number of elements");
    CHECK(refusal(ending(ascii("0 0 0\n1 0 0\n1 1 0\n0 1 0\n", "4 0 1 x 3"), end), "a.ply") ==
          "a.ply:15:7: error: this is not a number");
  }
}

TEST_CASE("wrong PLY is refused, with the position in a text") {
  const auto message = [](const std::string& bytes) { return refusal(bytes, "a.ply"); };
  const std::string good = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  CHECK(message("") == "a.ply:1:1: error: the header ends without `end_header`");
  CHECK(message("plx\n") == "a.ply:1:1: error: this is not a PLY file: it does not start with `ply`");
  CHECK(message("ply\nformat ascii 2.0\n") ==
        "a.ply:2:1: error: write format ascii, binary_little_endian or binary_big_endian, and 1.0");
  CHECK(message("ply\nend_header\n") == "a.ply:2:1: error: the header has no `format`");
  CHECK(message("ply\nproperty int x\n") == "a.ply:2:1: error: a property must come after an element");
  CHECK(message("ply\nelement vertex -1\n") == "a.ply:2:1: error: `-1` is not a number of elements");
  CHECK(message("ply\nelement vertex 1\nproperty quad x\n") ==
        "a.ply:3:1: error: `quad` is not a type of PLY");
  CHECK(contains(message(header("ascii", "element vertex 1\nproperty int x\n") + "1\n"), "x, y and z"));
  CHECK(contains(message(header("ascii", "element face 1\nproperty int x\n") + "1\n"),
                 "no list of vertex_indices"));
  CHECK(message(ascii(good, "4 0 1 2 9")) ==
        "a.ply: error: a face refers to vertex 9, but there are 4, counted from 0");
  CHECK(message(ascii(good, "4 0 1 2 -1")) ==
        "a.ply: error: a face refers to vertex -1, but there are 4, counted from 0");
  CHECK(message(ascii(good, "4 0 1 2 1.5")) == "a.ply:15:12: error: 1.5 is not an index of a vertex");
  CHECK(message(ascii(good, "4 0 1 x 3")) == "a.ply:15:7: error: this is not a number");
  CHECK(message(ascii(good, "4 0 1 2")) ==
        "a.ply:15:2: error: a list of 4 is longer than the rest of the file");
  CHECK(message(ascii(good, "9 0 1 2 3")) ==
        "a.ply:15:2: error: a list of 9 is longer than the rest of the file");
  CHECK(message(ascii(good, "-4 0 1 2 3")) == "a.ply:15:3: error: the length of a list must be an integer");
}

TEST_CASE("a header that claims absurd counts is refused") {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const char* count : {"1000000000", "18446744073709551615"}) {
      const std::string xyz = "\nproperty float x\nproperty float y\nproperty float z\n";
      CHECK(contains(refusal(header(format, "element vertex " + std::string(count) + xyz) + "0 0 0", "a.ply"),
                     "more than the file's"));
      const std::string face =
          "element vertex 0" + xyz + "element face " + count + "\nproperty list uchar int vertex_indices\n";
      CHECK(contains(refusal(header(format, face) + "0 0 0", "a.ply"), "more than the file's"));
      // Elements without properties take no bytes, and no time.
      CHECK(contains(
          refusal(header(format, "element vertex 0" + xyz + "element nothing " + count + "\n"), "a.ply"),
          "no visible triangles, points or lines"));
      CHECK(contains(
          refusal(header(format, "element vertex 0" + xyz + "element face " + count + "\n"), "a.ply"),
          "no list of vertex_indices"));
    }
  }
  Bytes data;
  data.add(uint32_t(4000000000u)).add(0).add(0);
  CHECK(contains(refusal(header("binary_little_endian",
                                "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
                                "element face 1\nproperty list uint int vertex_indices\n") +
                             data.text(),
                         "a.ply"),
                 "a list of 4000000000 is longer than the rest of the file"));
}

namespace {

// A square of four vertices and two faces that have the properties in `properties`.
std::string two_faces(const std::string& comments, const std::string& properties, const std::string& first,
                      const std::string& second) {
  return "ply\nformat ascii 1.0\n" + comments +
         "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n" +
         properties + "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + first + "\n" + second + "\n";
}

const std::string face_corners = "property list uchar int vertex_indices\n";
const std::string face_colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
const std::string face_uv = "property list uchar float texcoord\n";

}  // namespace

TEST_CASE("colours of faces are shown, but colours of vertices take precedence") {
  const ImportedScene scene =
      import_sound(two_faces("", face_corners + face_colors, "3 0 1 2 255 0 0", "3 0 2 3 0 0 255"), "a.ply");
  CHECK(scene.warnings.empty());
  const Mesh& mesh = scene.meshes[0];
  REQUIRE(mesh.triangles.size() == 2);
  CHECK(mesh.positions.size() == 6);
  for (const uint32_t corner : mesh.triangles[0]) CHECK(mesh.colors[corner] == Vec3(1, 0, 0));
  for (const uint32_t corner : mesh.triangles[1]) CHECK(mesh.colors[corner] == Vec3(0, 0, 1));
  CHECK(glm::length(mesh.normals[0] - Vec3(0, 0, 1)) < 1e-12);

  // Faces of the same colour share vertices; the polygon's colour is that of all its triangles.
  const ImportedScene grey = import_sound(
      two_faces("", face_colors + face_corners, "0 0 255 4 0 1 2 3", "0 0 255 3 0 2 3"), "a.ply");
  CHECK(grey.meshes[0].positions.size() == 4);
  CHECK(grey.meshes[0].triangles.size() == 3);

  const ImportedScene both = import_sound(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
          face_colors + "element face 1\n" + face_corners + face_colors +
          "end_header\n0 0 0 0 255 0\n1 0 0 0 255 0\n0 1 0 0 255 0\n3 0 1 2 255 0 0\n",
      "a.ply");
  CHECK(both.meshes[0].colors[0] == Vec3(0, 1, 0));
  CHECK(both.warnings ==
        std::vector<std::string>{"the colours of faces were left out: those of vertices are shown"});
}

TEST_CASE("alpha of colours and numbers of materials get a warning") {
  const auto scene_of = [](const std::string& alpha) {
    return import_sound(two_faces("", face_corners + face_colors + "property uchar alpha\n",
                                  "3 0 1 2 255 0 0 " + alpha, "3 0 2 3 0 0 255 255"),
                        "a.ply");
  };
  CHECK(scene_of("255").warnings.empty());
  CHECK(warns(scene_of("0"), "the transparency of colours (alpha) was left out"));
  const ImportedScene numbered = import_sound(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
          face_colors + "property uchar a\nelement face 1\n" + face_corners +
          "property int material_index\nend_header\n"
          "0 0 0 0 255 0 0\n1 0 0 0 255 0 9\n0 1 0 0 255 0 255\n3 0 1 2 5\n",
      "a.ply");
  CHECK(numbered.warnings.size() == 2);
  CHECK(warns(numbered, "the transparency of colours (alpha) was left out"));
  CHECK(warns(numbered, "its materials (material_index) were left out"));
}

TEST_CASE("faces' uv map one picture, or several by their number") {
  const Folder folder;
  for (const char* name : {"a.png", "b.png"})
    std::filesystem::copy_file("tests/image/pictures/rgb.png", folder / name);
  const auto scene_of = [&](const std::string& text) { return import_file(folder.write("a.ply", text)); };
  const ImportedScene one = scene_of(two_faces("comment TextureFile a.png\n", face_corners + face_uv,
                                               "3 0 1 2 6 0 0 0.5 0 0.5 1", "3 0 2 3 6 0 0 0.5 1 0.25 1"));
  CHECK(one.warnings.empty());
  REQUIRE(one.materials.size() == 1);
  CHECK(one.instances[0].material == 0);
  const Mesh& mesh = one.meshes[0];
  CHECK(mesh.positions.size() == 4);  // at 0 and at 2 both faces have the same uv
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    CHECK(mesh.uv[i] == Vec2(mesh.positions[i].x / 2 + (mesh.positions[i] == Vec3(0, 1, 0) ? 0.25 : 0),
                             mesh.positions[i].y));

  const std::string numbered = face_corners + face_uv + "property int texnumber\n";
  const std::string comments = "comment TextureFile a.png\ncomment TextureFile b.png\n";
  const ImportedScene two = scene_of(two_faces(comments, numbered, "3 0 1 2 6 0 0 1 0 1 1 1", "3 0 2 3 0 0"));
  REQUIRE(two.materials.size() == 2);
  REQUIRE(two.instances.size() == 2);
  for (int i = 0; i < 2; ++i) {
    CHECK(two.instances[size_t(i)].material == i);
    CHECK(two.meshes[size_t(i)].triangles.size() == 1);
  }
  CHECK(two.meshes[1].positions[two.meshes[1].triangles[0][1]] == Vec3(1, 0, 0));
  CHECK(two.warnings ==
        std::vector<std::string>{"3 corners whose uv are not finite or beyond 1e12 got uv 0"});

  const auto refused = [&](const std::string& face) {
    return refusal(two_faces(comments, numbered, face, "3 0 2 3 0 0"), "a.ply");
  };
  CHECK(contains(refused("3 0 1 2 4 0 0 1 0 0"), "a face of 3 corners has 2 pairs of texcoord"));
  CHECK(contains(refused("3 0 1 2 5 0 0 1 0 1 0"), "a texcoord of 5 numbers has no pair for each corner"));
  CHECK(contains(refused("3 0 1 2 0 2"),
                 "a face has the texnumber 2, but there are 2 pictures, counted from 0"));
  CHECK(warns(scene_of(two_faces("comment TextureFile a.png\n", face_corners, "3 0 1 2", "3 0 2 3")),
              "its picture (comment TextureFile) was left out: it has no uv"));
  for (const std::string start : {"comment texturefile", "obj_info TextureFile"}) {
    const ImportedScene other = scene_of(
        two_faces(start + " a.png\n", numbered, "3 0 1 2 6 0 0 1 0 1 1 7", "3 0 2 3 6 0 0 1 0 1 1 0"));
    CHECK(other.materials.size() == 1);
    CHECK(other.warnings ==
          std::vector<std::string>{
              "faces have a texnumber other than 0, but there is one picture: they show it"});
  }
}

TEST_CASE("a comment's picture is shown if vertices have uv") {
  const Folder folder;
  std::filesystem::copy_file("tests/image/pictures/rgb.png", folder / "my picture.png");
  const auto scene_of = [&](const std::string& comments) {
    return import_file(folder.write(
        "a.ply",
        "ply\nformat ascii 1.0\n" + comments +
            "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float s\n"
            "property float t\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
            "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n"));
  };
  const ImportedScene scene = scene_of("comment TextureFile my picture.png\n");
  CHECK(scene.warnings.empty());
  REQUIRE(scene.materials.size() == 1);
  CHECK(scene.instances[0].material == 0);
  CHECK(scene.files.size() == 2);
  // The picture's lower left corner is at the uv of 0, black; its upper row is red, green, blue.
  const auto color_at = [&](double u, double v) { return scene.materials[0]->base_color(Vec2(u, v)); };
  CHECK(color_at(1.0 / 6, 1.0 / 4) == Vec3(0));
  CHECK(color_at(1.0 / 6, 3.0 / 4) == Vec3(1, 0, 0));
  CHECK(color_at(5.0 / 6, 3.0 / 4) == Vec3(0, 0, 1));
  CHECK(scene.meshes[0].uv[2] == Vec2(0, 1));

  CHECK(warns(scene_of("comment TextureFile none.png\n"), "a picture was left out"));
  CHECK(scene_of("comment TextureFile none.png\n").materials.empty());
  CHECK(warns(scene_of("comment TextureFile a.png\ncomment TextureFile b.png\n"),
              "no texnumber of its faces selects one"));
}
