// KHR_draco_mesh_compression: meshes from the library's encoder are read back; all else is refused.
#include <ctime>

#include "coded_grid.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

Json& draco_of(GltfFile& file) {
  return file.primitive()["extensions"]["KHR_draco_mesh_compression"];
}

// Puts other data in place of the primitive's.
void replace_data(GltfFile& file, const std::string& data) {
  draco_of(file)["bufferView"] = file.add_view(data);
}

std::string refusal_of_data(const std::string& data) {
  GltfFile file = draco_grid();
  replace_data(file, data);
  return refusal(file.glb(), "a.glb");
}

// The whole number as Draco writes it.
std::string varint(uint32_t value) {
  std::string bytes;
  for (; value > 127; value >>= 7) bytes += char((value & 127) | 128);
  return bytes + char(value);
}

// The beginning of an edgebreaker mesh, up to the mesh's size.
const std::string edgebreaker_head("DRACO\x02\x02\x01\x01\x00\x00\x00", 12);

}  // namespace

TEST_CASE("draco: positions, normals, uv and corners survive both methods, every speed and every container") {
  for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    for (const int speed : {0, 3, 5, 10}) {
      for (const bool quantized : {false, true}) {
        CAPTURE(method);
        CAPTURE(speed);
        const GltfFile file = draco_grid({method, speed, quantized, speed == 5});
        check_grid(import_sound(file.gltf(), "a.gltf"), quantized ? 2e-3 : 1e-6);
        check_grid(import_sound(file.glb(), "a.glb"), quantized ? 2e-3 : 1e-6);
      }
    }
  }
  const GltfFile file = draco_grid();
  CHECK(file.data().size() < 1200);  // 144 vertices and 242 triangles
  const Folder folder;
  folder.write("coded.bin", file.data());
  check_grid(import_file(folder.write("a.gltf", file.gltf("coded.bin"))), 2e-3);
}

// Edgebreaker has separate tables for vertices of one position and several normals.
TEST_CASE("draco: corners may share only their position") {
  const std::vector<double> roof = {0, 0, 0, 0, 1, 0, 1, 1, 1, 1, 0, 1, 1, 0, 1, 1, 1, 1, 2, 1, 0, 2, 0, 0};
  const std::vector<double> normals = {-1, 0, 1, -1, 0, 1, -1, 0, 1, -1, 0, 1,
                                       1,  0, 1, 1,  0, 1, 1,  0, 1, 1,  0, 1};
  Grid grid{roof, normals, {}, {0, 3, 2, 0, 2, 1, 4, 7, 6, 4, 6, 5}};
  for (double& number : grid.normals) number *= std::sqrt(0.5);
  for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    DracoMesh mesh(grid);
    mesh.add<float>(draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, grid.positions);
    mesh.add<float>(draco::GeometryAttribute::NORMAL, draco::DT_FLOAT32, grid.normals);
    GltfFile file;
    file.add_positions(grid.positions);
    file.primitive()["attributes"]["NORMAL"] = file.add(grid.normals, 5126, "VEC3", 3);
    file.primitive()["indices"] = file.add(grid.indices, 5123, "SCALAR", 1);
    code_primitive(file, mesh.code({method}), {{"POSITION", 0}, {"NORMAL", 1}});
    const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
    const Mesh& made = scene.meshes[0];
    CHECK(made.positions.size() == 8);
    CHECK(signed_area(made, {0, 0, 1}) == doctest::Approx(4).epsilon(1e-3));
    for (const auto& t : made.triangles) {
      const double middle = (made.positions[t[0]].x + made.positions[t[1]].x + made.positions[t[2]].x) / 3;
      for (const uint32_t corner : t) CHECK((made.normals[corner].x > 0.7) == (middle > 1));
    }
  }
}

TEST_CASE("draco: a strip is coded as separate triangles, and fans are refused") {
  GltfFile file = draco_grid();
  file.primitive()["mode"] = 5;
  file.json["accessors"][3]["count"] = 300;  // vertices of the strip
  check_grid(import_sound(file.gltf(), "a.gltf"), 2e-3);
  file.primitive()["mode"] = 6;
  CHECK(
      contains(refusal(file.gltf(), "a.gltf"),
               "meshes[0].primitives[0] has a mode other than triangles and strips of them, and Draco data"));
}

TEST_CASE("draco: attributes that its data lack come from accessors, and colours may be bytes") {
  const Grid grid = hilly_grid();
  const auto redness = [](double x, double y) { return std::round(255 * (x + y) / 2); };
  std::vector<double> colors, plain;
  for (size_t i = 0; i < grid.positions.size(); i += 3) {
    const double red = redness(grid.positions[i], grid.positions[i + 1]);
    colors.insert(colors.end(), {red, 0, 255, 255});
    plain.insert(plain.end(), {red / 255, 0, 1});
  }
  for (const bool coded : {false, true}) {
    DracoMesh mesh(grid);
    mesh.add<float>(draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, grid.positions);
    mesh.add<float>(draco::GeometryAttribute::NORMAL, draco::DT_FLOAT32, grid.normals);
    mesh.add<float>(draco::GeometryAttribute::TEX_COORD, draco::DT_FLOAT32, grid.uv);
    const unsigned color = mesh.add<uint8_t>(draco::GeometryAttribute::COLOR, draco::DT_UINT8, colors, true);
    GltfFile file = grid_file();
    file.primitive()["attributes"]["COLOR_0"] =
        coded ? file.add(colors, 5121, "VEC4", 4, true) : file.add(plain, 5126, "VEC3", 3);
    Json attributes = {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}};
    if (coded) attributes["COLOR_0"] = color;
    code_primitive(file, mesh.code({draco::MESH_SEQUENTIAL_ENCODING}), attributes);
    const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
    check_grid(scene, 2e-3);
    const Mesh& made = scene.meshes[0];
    REQUIRE(made.colors.size() == made.positions.size());
    for (size_t i = 0; i < made.colors.size(); ++i)
      CHECK(std::abs(255 * made.colors[i].x - redness(made.positions[i].x, made.positions[i].y)) < 1.2);
  }
}

TEST_CASE("draco: a skin's joints and weights are decoded") {
  // A square with two joints, each of which holds two corners; the second joint stands 3 above the first.
  GltfFile file = square_file();
  Grid grid{square_positions, {}, {}, {0, 1, 2, 0, 2, 3}};
  const std::vector<double> joints = {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  const std::vector<double> weights = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  DracoMesh mesh(grid);
  mesh.add<float>(draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, grid.positions);
  mesh.add<uint8_t>(draco::GeometryAttribute::GENERIC, draco::DT_UINT8, joints);
  mesh.add<float>(draco::GeometryAttribute::GENERIC, draco::DT_FLOAT32, weights);
  file.primitive()["attributes"]["JOINTS_0"] = file.add(joints, 5121, "VEC4", 4);
  file.primitive()["attributes"]["WEIGHTS_0"] = file.add(weights, 5126, "VEC4", 4);
  code_primitive(file, mesh.code({}), {{"POSITION", 0}, {"JOINTS_0", 1}, {"WEIGHTS_0", 2}});
  file.json["nodes"] = {
      {{"mesh", 0}, {"skin", 0}}, {{"translation", {5, 0, 0}}}, {{"translation", {5, 3, 0}}}};
  file.json["scenes"] = {{{"nodes", {0, 1, 2}}}};
  file.json["skins"] = {{{"joints", {1, 2}}}};
  const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  CHECK(signed_area(scene.meshes[0], {0, 0, 1}) == doctest::Approx(8));
  for (const Vec3& position : scene.meshes[0].positions) {
    CHECK(position.x > 4.99);
    CHECK((position.y < 0.01 || position.y > 3.99));
  }
}

TEST_CASE("draco: two primitives may share coded data, or accessors with an uncoded primitive") {
  GltfFile file = draco_grid();
  const Json coded = file.primitive();
  file.json["meshes"][0]["primitives"].push_back(coded);
  CHECK(import_sound(file.gltf(), "a.gltf").meshes.size() == 2);

  // The accessors have separate views with other numbers, which are used if nothing is coded.
  GltfFile both = grid_file();
  code_primitive(both, draco_grid_data({}, hilly_grid()),
                 {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}});
  Grid high = hilly_grid();
  for (double& number : high.positions) number += 10;
  const int view = both.add_view(high.positions, 5126);
  for (size_t i = 0; i < 4; ++i) both.json["accessors"][i]["bufferView"] = i == 0 ? view : int(i);
  Json plain = both.primitive();
  plain.erase("extensions");
  both.json["meshes"][0]["primitives"].push_back(plain);
  both.json.erase("extensionsRequired");
  const ImportedScene scene = import_sound(both.gltf(), "a.gltf");
  REQUIRE(scene.meshes.size() == 2);
  CHECK(scene.meshes[0].positions[0].y < 1.1);
  CHECK(scene.meshes[1].positions[0].y > 9.9);
}

TEST_CASE("draco: properties that disagree with the data are refused, with their position") {
  const struct {
    const char* at;
    Json value;
    std::string why;
  } cases[] = {
      {"/accessors/0/count", 143,
       "accessors[0] has 143 elements of type VEC3, but the Draco data of meshes[0].primitives[0] have 144 "
       "of 3 numbers"},
      {"/accessors/2/count", 1e9, "accessors[2] has 1000000000 elements of type VEC2, but the Draco data"},
      {"/accessors/0/type", "VEC4", "accessors[0] has 144 elements of type VEC4, but the Draco data"},
      {"/accessors/0/type", "MAT4", "accessors[0] has 144 elements of type MAT4, but the Draco data"},
      {"/accessors/0/componentType", 5124, "accessors[0] has a componentType that glTF does not define"},
      {"/accessors/1/componentType", 5121,
       "accessors[1] cannot store the values of the Draco data of meshes[0].primitives[0]"},
      {"/accessors/3/count", 723,
       "accessors[3] has a count of 723, but the Draco data of meshes[0].primitives[0] contain 242 "
       "triangles"},
      {"/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/attributes/NORMAL", 7,
       "reads NORMAL from attribute 7, which its data lack"},
      {"/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/attributes/NORMAL", 4294967297,
       "reads NORMAL from attribute 4294967297, which its data lack"},
      {"/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/bufferView", 9,
       "bufferView must be an index below"},
      {"/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression", Json::object(), "has no bufferView"},
      {"/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression",
       {{"bufferView", 0}},
       "has no attributes"},
  };
  for (const auto& each : cases) {
    const std::string& why = each.why;
    CAPTURE(why);
    GltfFile file = draco_grid();
    file.json[Json::json_pointer(each.at)] = each.value;
    const std::string message = refusal(file.gltf(), "a.gltf");
    CAPTURE(message);
    CHECK(contains(message, why));
    if (!contains(why, "accessors")) CHECK(contains(message, "meshes[0].primitives[0].extensions.KHR_draco"));
  }
}

TEST_CASE("draco: foreign, truncated or damaged data, and data of another kind, are refused") {
  const std::string where = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression has data that ";
  CHECK(contains(refusal_of_data(""), where + "are not Draco data"));
  CHECK(contains(refusal_of_data("DRAGO\x02\x02\x01\x01"), where + "are not Draco data"));
  CHECK(
      contains(refusal_of_data(std::string("DRACO\x02\x03\x00\x01\x00\x00", 11)), where + "are not a mesh"));
  CHECK(contains(refusal_of_data(std::string("DRACO\x02\x02\x01\x07\x00\x00", 11)),
                 where + "are of a kind that"));
  CHECK(contains(refusal_of_data(std::string("DRACO\x09\x09\x01\x01\x00\x00", 11)), where + "are damaged: "));
  for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    for (const int speed : {0, 5, 10}) {
      GltfFile file = draco_grid({method, speed, true, true});
      Json& view = file.json["bufferViews"][0];
      const size_t whole = view["byteLength"];
      size_t read = 0;
      for (size_t length = 0; length < whole; ++length) {
        view["byteLength"] = length;
        const std::string why = refusal(file.glb(), "a.glb");
        CAPTURE(why);
        read += why == "accepted";
        REQUIRE((why == "accepted" || contains(why, where)));
      }
      CHECK(read <= 16);  // decoders of bits read zeros beyond the end
    }
  }
}

TEST_CASE("draco: absurd sizes take no memory, in its header, its attributes or its metadata") {
  const std::string too_much = "have more faces or vertices than data of this size can encode";
  const std::string billion = varint(1000000000);
  CHECK(contains(refusal_of_data(edgebreaker_head + billion + billion + '\0' + billion + '\0'), too_much));
  // Twelve million corners are allowed; 255 tables of them are not.
  const std::string million = varint(4000000);
  const std::string many_tables = edgebreaker_head + million + million + '\xff' + million + '\0';
  const std::string one_table = edgebreaker_head + million + million + '\0' + million + '\0';
  CHECK(contains(refusal_of_data(many_tables), too_much));
  CHECK(contains(refusal_of_data(one_table), "are damaged"));

  // A position of 255 numbers at each vertex of a flat plane, whose data are very small.
  Grid plane = hilly_grid(400);
  for (size_t i = 2; i < plane.positions.size(); i += 3) plane.positions[i] = 0;
  DracoMesh mesh(plane);
  mesh.add<float>(draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, plane.positions);
  std::string data = mesh.code({draco::MESH_EDGEBREAKER_ENCODING, 0});
  CHECK(data.size() < 60000);
  const size_t declared = data.find(std::string("\x00\x09\x03\x00", 4));  // position, float32, three of them
  REQUIRE(declared != std::string::npos);
  data[declared + 2] = '\xff';
  CHECK(contains(refusal_of_data(data), too_much));

  // Metadata that announce 100 branches at each of 900 nested levels, and then end.
  std::string tree("DRACO\x02\x02\x01\x01\x00\x80\x00", 12);
  for (int level = 0; level < 900; ++level) tree += std::string("\0", 1) + varint(100) + std::string("\0", 1);
  CHECK(contains(refusal_of_data(tree), "are damaged: their metadata end too early"));
}

TEST_CASE("draco: copies of a large mesh's attribute into accessors are limited") {
  constexpr int side = 400;
  Grid plane = hilly_grid(side);
  for (size_t i = 2; i < plane.positions.size(); i += 3) plane.positions[i] = 0;
  DracoMesh mesh(plane);
  mesh.add<float>(draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, plane.positions);
  GltfFile file = draco_grid();
  replace_data(file, mesh.code({draco::MESH_EDGEBREAKER_ENCODING, 0}));
  file.primitive()["attributes"] = {{"POSITION", 0}};
  draco_of(file)["attributes"] = {{"POSITION", 0}};
  file.json["accessors"][0]["count"] = side * side;
  file.json["accessors"][3]["count"] = 6 * (side - 1) * (side - 1);
  CHECK(import_sound(file.glb(), "a.glb").meshes[0].triangles.size() == 2 * (side - 1) * (side - 1));
  for (int i = 0; i < 40; ++i) {
    const std::string name = "COPY_" + std::to_string(i);
    file.primitive()["attributes"][name] = file.json["accessors"].size();
    file.json["accessors"].push_back(Json(file.json["accessors"][0]));
    draco_of(file)["attributes"][name] = 0;
  }
  CHECK(contains(refusal(file.glb(), "a.glb"),
                 "makes the number of elements larger than a file of this size may have"));
}

// Draco 1.5.5 takes 7 s for the claimed orientations, in a few bytes; only decoding finds their count.
TEST_CASE("draco: absurd counts of uv orientations take no time") {
  const std::string whole = draco_grid_data({draco::MESH_EDGEBREAKER_ENCODING, 3}, hilly_grid());
  size_t survived = 0;
  for (size_t at = 40; at + 4 <= whole.size(); ++at) {
    std::string data = whole;
    data.replace(at, 4, "\xff\xff\xff\x7f");
    const std::clock_t start = std::clock();
    survived += refusal_of_data(data) == "accepted";
    REQUIRE(std::clock() - start < 4 * CLOCKS_PER_SEC);
  }
  CHECK(survived < whole.size() - 44);
}
