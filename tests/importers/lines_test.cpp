// Lines of OBJ and glTF, which are shown as capsules, and points of glTF.
#include "gltf_files.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

// The ends of all segments, one after the other.
std::vector<Vec3> ends_of_lines(const ImportedScene& scene) {
  std::vector<Vec3> all;
  for (const ImportedLines& lines : scene.lines)
    for (const auto& [from, to] : lines.segments) all.insert(all.end(), {from, to});
  return all;
}

const Vec3 end_a(0, 0, 0), end_b(1, 0, 0), end_c(0, 1, 0), end_d(0, 0, 1);

// A glTF file of one primitive without faces.
GltfFile file_without_faces(int mode) {
  GltfFile file;
  file.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  file.primitive()["mode"] = mode;
  return file;
}

const ImportOptions wide_lines{.line_width = 0.5};

}  // namespace

TEST_CASE("lines of OBJ are capsules if they have a width, with the material of their faces") {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const std::string text = vertices + "l 1 2 3\nusemtl red\nl -1 -4 # back\nl 2/1 4/2\nvt 0 0\nvt 1 0\n";
  const ImportedScene scene = import_sound(text, "a.obj", wide_lines);
  CHECK(ends_of_lines(scene) == std::vector<Vec3>{end_a, end_b, end_b, end_c, end_d, end_a, end_b, end_d});
  REQUIRE(scene.lines.size() == 2);
  CHECK(scene.lines[0].radius == 0.25);
  CHECK(scene.clouds.empty());
  CHECK(scene.instances.empty());

  const ImportedScene without = import_sound(vertices + "f 1 2 3\nl 1 2\nl 2 3\n", "a.obj");
  CHECK(without.lines.empty());
  CHECK(warns(without, "2 lines were left out: `line_width` or --line-width shows them"));
  const ImportedScene both = import_sound(vertices + "f 1 2 3\nl 1 4\n", "a.obj", wide_lines);
  CHECK(both.instances.size() == 1);
  CHECK(ends_of_lines(both) == std::vector<Vec3>{end_a, end_d});

  CHECK(contains(refusal(vertices + "l 1 5\n", "a.obj", wide_lines), "there is no vertex 5"));
  CHECK(contains(refusal(vertices + "l 1 x\n", "a.obj", wide_lines), "a.obj:5:5"));
  const ImportedScene odd = import_sound(
      "v 0 0 0\nv 1e9 0 0\nv 1 nan 0\nv 1 0 0\nl 1 1\nl 1 2\nl 1 3\nl 1 4\n", "a.obj", wide_lines);
  CHECK(ends_of_lines(odd) == std::vector<Vec3>{end_a, end_b});
  CHECK(warns(odd, "3 segments of lines were left out: they have no length"));
  std::string many = vertices;
  for (int i = 0; i < 1 << 10; ++i) {
    many += "l";
    for (int k = 0; k < 1 << 10; ++k) many += " 1 2";
    many += "\n";
  }
  CHECK(contains(refusal(many, "a.obj", wide_lines), "its lines have more than 1048576 segments"));
}

TEST_CASE("lines of glTF: lists, loops and strips, moved by their node, of the same width everywhere") {
  GltfFile file = file_without_faces(1);
  file.json["nodes"][0]["scale"] = {2, 2, 2};
  const ImportedScene list = import_sound(file.gltf(), "a.gltf", wide_lines);
  CHECK(ends_of_lines(list) == std::vector<Vec3>{end_a, 2.0 * end_b, 2.0 * end_c, 2.0 * end_d});
  CHECK(list.lines.at(0).radius == 0.25);
  CHECK(ends_of_lines(import_sound(file_without_faces(2).gltf(), "a.gltf", wide_lines)) ==
        std::vector<Vec3>{end_a, end_b, end_b, end_c, end_c, end_d, end_d, end_a});
  CHECK(ends_of_lines(import_sound(file_without_faces(3).gltf(), "a.gltf", wide_lines)) ==
        std::vector<Vec3>{end_a, end_b, end_b, end_c, end_c, end_d});

  file.primitive()["indices"] = file.add({3, 0, 1}, 5121, "SCALAR", 1);
  const ImportedScene odd = import_sound(file.gltf(), "a.gltf", wide_lines);
  CHECK(ends_of_lines(odd) == std::vector<Vec3>{2.0 * end_d, end_a});
  CHECK(warns(odd, "primitives whose last corners make no line: 1"));
  CHECK(contains(refusal(file_without_faces(1).gltf(), "a.gltf"),
                 "no visible triangles, points or lines; left out: lines, which `line_width` or --line-width "
                 "shows (1)"));
}

TEST_CASE("points of glTF are a cloud, with colours and a material, moved by their node") {
  GltfFile file = file_without_faces(0);
  file.primitive()["attributes"]["COLOR_0"] =
      file.add({1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5, 0.5, 0.5}, 5126, "VEC3", 3);
  file.json["materials"] = {{{"name", "own"}}, {{"name", "veil"}, {"alphaMode", "BLEND"}}};
  file.primitive()["material"] = 0;
  file.json["nodes"][0]["translation"] = {0, 0, 7};
  const auto cloud_of = [&](const ImportOptions& options) {
    const ImportedScene scene = import_sound(file.gltf(), "a.gltf", options);
    REQUIRE(scene.clouds.size() == 1);
    CHECK(scene.meshes.empty());
    return scene.clouds[0];
  };
  const ImportedPoints points = cloud_of({.point_size = 0.5});
  CHECK(points.cloud->positions ==
        std::vector<Vec3>{end_a + 7.0 * end_d, end_b + 7.0 * end_d, end_c + 7.0 * end_d, 8.0 * end_d});
  CHECK(points.cloud->colors[3] == glm::vec3(0.5f));
  CHECK(points.cloud->radius == 0.25);
  CHECK(points.material == 0);
  CHECK(import_sound(file.gltf(), "a.gltf").warnings.empty());

  // Normals turn with their node, against its scale.
  file.primitive()["attributes"]["NORMAL"] =
      file.add({0, 1, 0, 1, 0, 0, 0, 0, 1, 0.6, 0.8, 0}, 5126, "VEC3", 3);
  file.json["nodes"][0]["scale"] = {1, 2, 1};
  const auto disks = cloud_of({.point_shape = PointShape::disk}).cloud;
  REQUIRE(disks->normals.size() == 4);
  CHECK(glm::length(disks->normals[0] - glm::vec3(0, 1, 0)) < 1e-6f);
  CHECK(glm::length(disks->normals[3] - glm::normalize(glm::vec3(0.6f, 0.4f, 0))) < 1e-6f);
  CHECK(cloud_of({}).cloud->normals.empty());
  file.json["nodes"][0].erase("scale");

  file.primitive()["material"] = 1;
  CHECK(cloud_of({}).material == -1);
  CHECK(warns(import_sound(file.gltf(), "a.gltf"), "transparent materials of points and lines (1)"));
  file.primitive()["indices"] = file.add({3, 0}, 5121, "SCALAR", 1);
  CHECK(cloud_of({}).cloud->positions == std::vector<Vec3>{8.0 * end_d, end_a + 7.0 * end_d});
}

TEST_CASE("points that very many instances of glTF repeat are refused") {
  GltfFile file = file_without_faces(0);
  std::vector<double> corners(3 * 4096, 0.0), places(3 * 4098, 1.0);
  file.add_positions(corners);
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      file.add(places, 5126, "VEC3", 3);
  CHECK(contains(refusal(file.gltf(), "a.gltf", {.point_size = 1}), "16777216 points may be added so"));
}
