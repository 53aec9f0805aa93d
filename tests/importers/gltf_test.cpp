// The geometry of glTF files: accessors, primitives, nodes, containers.
#include <map>

#include "gltf_files.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

void check_square(const ImportedScene& scene) {
  REQUIRE(scene.meshes.size() == 1);
  CHECK(scene.meshes[0].triangles.size() == 2);
  CHECK(signed_area(scene.meshes[0], {0, 0, 1}) == doctest::Approx(2));
  CHECK(scene.warnings.empty());
}

}  // namespace

TEST_CASE("the same square is read from a data URI, a .glb and two files") {
  const GltfFile file = square_file();
  check_square(import_sound(file.gltf(), "a.gltf"));
  check_square(import_sound(file.glb(), "a.glb"));
  check_square(import_sound(file.glb(), "a.gltf"));  // identified by its first bytes
  const Folder folder;
  folder.write("sub/the data.bin", file.data());
  const ImportedScene scene = import_file(folder.write("a.gltf", file.gltf("sub/the%20data.bin")));
  check_square(scene);
  CHECK(scene.files == std::vector<std::filesystem::path>{folder / "a.gltf", folder / "sub/the data.bin"});
}

TEST_CASE("every type of index and of coordinate is read") {
  for (const int index : {5121, 5123, 5125}) {
    GltfFile file;
    file.add_positions(square_positions);
    file.primitive()["indices"] = file.add({0, 1, 2, 0, 2, 3}, index, "SCALAR", 1);
    check_square(import_sound(file.gltf(), "a.gltf"));
  }
  for (const int component : {5120, 5121, 5122, 5123, 5126}) {
    for (const bool normalized : {false, true}) {
      if (component == 5126 && normalized) continue;  // which breaks a rule
      CAPTURE(component);
      CAPTURE(normalized);
      const std::map<int, double> one = {{5120, 127}, {5121, 255}, {5122, 32767}, {5123, 65535}, {5126, 1}};
      std::vector<double> numbers = square_positions;
      for (double& number : numbers) number *= normalized ? one.at(component) : 1;
      GltfFile file;
      file.json["extensionsUsed"] = {"KHR_mesh_quantization"};
      file.primitive()["attributes"]["POSITION"] = file.add(numbers, component, "VEC3", 3, normalized);
      file.primitive()["mode"] = 6;
      check_square(import_sound(file.gltf(), "a.gltf"));
    }
  }
}

TEST_CASE("lists, strips and fans are read, with and without indices") {
  const std::vector<double> zigzag = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::vector<double> soup = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
  const struct {
    int mode;
    std::vector<double> positions;
    std::vector<double> indices;
  } cases[] = {{4, zigzag, {0, 1, 2, 2, 1, 3}}, {4, soup, {}},
               {5, zigzag, {0, 1, 2, 3}},       {5, zigzag, {}},
               {6, zigzag, {0, 1, 3, 2}},       {6, square_positions, {}}};
  for (const auto& [number, positions, indices] : cases) {
    const int mode = number;
    CAPTURE(mode);
    GltfFile file;
    file.add_positions(positions);
    file.primitive()["mode"] = mode;
    if (!indices.empty()) file.primitive()["indices"] = file.add(indices, 5121, "SCALAR", 1);
    check_square(import_sound(file.gltf(), "a.gltf"));
  }
}

TEST_CASE("interleaved attributes, normals and uv are read, and v starts at the top") {
  GltfFile file;
  std::vector<double> rows;
  for (size_t i = 0; i < 4; ++i) {
    const double x = square_positions[3 * i], y = square_positions[3 * i + 1];
    rows.insert(rows.end(), {x, y, 0, 0, 0, 1, x, 1 - y});
  }
  const int view = file.add_view(rows, 5126);
  file.json["bufferViews"][size_t(view)]["byteStride"] = 32;
  for (const auto& [name, type, offset] :
       {std::tuple("POSITION", "VEC3", 0), std::tuple("NORMAL", "VEC3", 12),
        std::tuple("TEXCOORD_0", "VEC2", 24)}) {
    file.json["accessors"].push_back({{"bufferView", view},
                                      {"byteOffset", offset},
                                      {"componentType", 5126},
                                      {"type", type},
                                      {"count", 4}});
    file.primitive()["attributes"][name] = file.json["accessors"].size() - 1;
  }
  file.json["accessors"][0].update({{"min", {0, 0, 0}}, {"max", {1, 1, 0}}});
  file.primitive()["mode"] = 6;
  const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  check_square(scene);
  for (size_t i = 0; i < 4; ++i) {
    CHECK(scene.meshes[0].normals[i] == Vec3(0, 0, 1));
    CHECK(scene.meshes[0].uv[i] == Vec2(scene.meshes[0].positions[i]));
  }
}

TEST_CASE("sparse accessors replace data, or zeros without a view") {
  for (const bool base : {true, false}) {
    GltfFile file = square_file();
    Json& positions = file.json["accessors"][0];
    if (!base) positions.erase("bufferView");
    const std::vector<double> changes =
        base ? std::vector<double>{2, 2, 0} : std::vector<double>{1, 0, 0, 1, 1, 0, 0, 1, 0};
    const std::vector<double> indices = base ? std::vector<double>{2} : std::vector<double>{1, 2, 3};
    positions["sparse"] = {
        {"count", indices.size()},
        {"indices", {{"bufferView", file.add_view(indices, 5121)}, {"componentType", 5121}}},
        {"values", {{"bufferView", file.add_view(changes, 5126)}}}};
    const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
    CHECK(signed_area(scene.meshes[0], {0, 0, 1}) == (base ? 4 : 2));
    file.json["accessors"][0]["sparse"]["indices"]["bufferView"] = file.add_view({4, 4, 4}, 5121);
    CHECK(contains(refusal(file.gltf(), "a.gltf"), "beyond the accessor"));
  }
}

TEST_CASE("nodes transform their descendants, and share meshes") {
  GltfFile file = square_file();
  file.json["nodes"] = {{{"mesh", 0}, {"children", {2, 1}}, {"translation", {1, 2, 3}}},
                        {{"mesh", 0}, {"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 5, 0, 0, 1}}},
                        {{"mesh", 0}, {"rotation", {0, 0, 0.70710678, 0.70710678}}, {"scale", {1, 3, 1}}},
                        {{"mesh", 0}, {"scale", {0, 1, 1}}}};
  file.json["scenes"] = {{{"nodes", {3}}}, {{"nodes", {0, 3}}}};
  file.json["scene"] = 1;
  const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  CHECK(scene.meshes.size() == 1);
  REQUIRE(scene.instances.size() == 3);
  const auto corner = [&](size_t i) { return Vec3(scene.instances[i].transform * Vec4(1, 1, 0, 1)); };
  CHECK(glm::length(corner(0) - Vec3(2, 3, 3)) < 1e-7);
  CHECK(glm::length(corner(1) - Vec3(-2, 3, 3)) < 1e-7);
  CHECK(glm::length(corner(2) - Vec3(8, 4, 3)) < 1e-7);
  CHECK(warns(scene, "a node whose transforms flatten everything was left out"));

  // Without scenes, every node that has no parent is shown.
  file.json.erase("scenes");
  file.json.erase("scene");
  CHECK(import_sound(file.gltf(), "a.gltf").instances.size() == 3);
}

TEST_CASE("nodes that are their own ancestors, or have two parents, are refused") {
  GltfFile file = square_file();
  file.json["nodes"] = {{{"children", {1}}}, {{"mesh", 0}, {"children", {0}}}};
  CHECK(refusal(file.gltf(), "a.gltf") ==
        "a.gltf: error: nodes[0] is reached twice: a node can have one parent, and cannot be below itself");
  file.json["nodes"] = {{{"children", {1, 2}}}, {{"children", {2}}}, {{"mesh", 0}}};
  CHECK(contains(refusal(file.gltf(), "a.gltf"), "nodes[2] is reached twice"));
  Json chain = Json::array();
  for (int i = 0; i < 20000; ++i) chain.push_back({{"children", {i + 1}}});
  chain.push_back({{"mesh", 0}});
  file.json["nodes"] = chain;
  CHECK(import_sound(file.gltf(), "a.gltf").instances.size() == 1);
}

TEST_CASE("wrong glTF is refused, and the position named") {
  const auto message = [](const char* pointer, const Json& value) {
    GltfFile file = square_file();
    file.json[Json::json_pointer(pointer)] = value;
    return refusal(file.gltf(), "a.gltf");
  };
  CHECK(message("/asset/version", "1.0") == "a.gltf: error: it is not glTF 2: its asset.version is \"1.0\"");
  CHECK(message("/asset", 3) == "a.gltf: error: asset must be an object");
  CHECK(message("/nodes/0/mesh", 1) == "a.gltf: error: nodes[0].mesh must be an index below 1");
  CHECK(message("/nodes/0/mesh", -1) == "a.gltf: error: nodes[0].mesh must be an index below 1");
  CHECK(message("/nodes/0/mesh", 0.5) == "a.gltf: error: nodes[0].mesh must be an index below 1");
  CHECK(message("/nodes/0/scale", {1, 2}) == "a.gltf: error: nodes[0].scale must be a list of 3 numbers");
  CHECK(message("/nodes/0/scale", {1, "a", 2}) ==
        "a.gltf: error: nodes[0].scale must be a list of 3 numbers");
  CHECK(message("/nodes/0/rotation", {0, 0, 0, 0}) == "a.gltf: error: nodes[0] has a rotation of length 0");
  CHECK(message("/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}) ==
        "a.gltf: error: nodes[0] has a matrix that is not affine");
  CHECK(message("/nodes", 7) == "a.gltf: error: nodes must be a list");
  CHECK(message("/scene", 5) == "a.gltf: error: scene must be an index below 1");
  CHECK(message("/meshes/0/primitives/0/mode", 9) ==
        "a.gltf: error: meshes[0].primitives[0] has a mode that glTF does not define");
  CHECK(message("/meshes/0/primitives/0/indices", 0) ==
        "a.gltf: error: accessors[0] contains indices, which must be unsigned integers");
  CHECK(message("/meshes/0/primitives/0/attributes/NORMAL", 1) ==
        "a.gltf: error: accessors[1] contains NORMAL, which cannot be componentType 5123");
  CHECK(message("/accessors/0/type", "VEC2") == "a.gltf: error: accessors[0] must be of type VEC3");
  CHECK(message("/accessors/0/count", 3) ==
        "a.gltf: error: meshes[0].primitives[0] refers to vertex 3, but there are 3, counted from 0");
  CHECK(message("/accessors/0/count", 5) ==
        "a.gltf: error: accessors[0] reaches beyond the end of its bufferView");
  CHECK(message("/accessors/0/count", 9007199254740992) ==
        "a.gltf: error: accessors[0] reaches beyond the end of its bufferView");
  CHECK(message("/accessors/0/byteOffset", 9007199254740992) ==
        "a.gltf: error: accessors[0] reaches beyond the end of its bufferView");
  CHECK(message("/accessors/0/componentType", 5124) ==
        "a.gltf: error: accessors[0] has a componentType that glTF does not define");
  CHECK(message("/bufferViews/0/byteStride", 4) ==
        "a.gltf: error: accessors[0] has elements of 12 bytes, 4 apart");
  CHECK(message("/bufferViews/0/byteLength", 1000) ==
        "a.gltf: error: bufferViews[0] extends to byte 1000 of a buffer that has 60");
  CHECK(message("/bufferViews/0/buffer", 3) ==
        "a.gltf: error: bufferViews[0].buffer must be an index below 1");
}

TEST_CASE("damaged files are refused") {
  CHECK(refusal("{\"asset\":\n  x}", "a.gltf") == "a.gltf:2:3: error: this is not JSON");
  CHECK(refusal("", "a.gltf") == "a.gltf:1:1: error: this is not JSON");
  CHECK(refusal("[]", "a.gltf") == "a.gltf: error: the document must be an object");
  CHECK(contains(refusal("{\"asset\": 1e999}", "a.gltf"), "a number that is out of range"));
  CHECK(contains(refusal("{\"asset\":" + std::string(1000000, '['), "a.gltf"), "nested more than 64 deep"));
  const GltfFile file = square_file();
  CHECK(contains(refusal(file.gltf("data:;base64,####"), "a.gltf"), "has a data URI that is not base64"));
  CHECK(contains(refusal(file.gltf("data:text/plain,abc"), "a.gltf"), "has a data URI that is not base64"));
  CHECK(contains(refusal(file.gltf("data:;base64,AAAA"), "a.gltf"),
                 "buffers[0] should have 60 bytes, but there are only 3"));
  std::string glb = file.glb();
  glb[4] = 1;
  CHECK(contains(refusal(glb, "a.glb"), "it must be glTF 2, not 1"));
}

TEST_CASE("a small file cannot claim much memory") {
  GltfFile file = square_file();
  file.json["accessors"][0] = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 1000000000}};
  CHECK(contains(refusal(file.gltf(), "a.gltf"),
                 "makes the number of elements larger than a file of this size may have"));

  // A mesh of many primitives, shown by many nodes.
  file = square_file();
  for (int i = 0; i < 1199; ++i) file.json["meshes"][0]["primitives"].push_back(Json(file.primitive()));
  file.json["nodes"] = Json::array();
  for (int i = 0; i < 1000; ++i) file.json["nodes"].push_back({{"mesh", 0}});
  file.json.erase("scenes");
  CHECK(contains(refusal(file.gltf(), "a.gltf"),
                 "is one of more than 1048576 instances, the most that a file may have"));
}

TEST_CASE("buffers outside the folder tree are refused") {
  const Folder folder;
  const GltfFile file = square_file();
  folder.write("data.bin", file.data());
  std::filesystem::create_directory(folder.path() / "in");
  std::filesystem::create_symlink(folder / "data.bin", folder / "in/link.bin");
  for (const std::string& name : {std::string("../data.bin"), folder / "data.bin", std::string("link.bin"),
                                  std::string("%2e%2e/data.bin"), std::string("x/..%2F../data.bin")}) {
    CAPTURE(name);
    const std::string gltf = folder.write("in/a.gltf", file.gltf(name));
    std::string why;
    try {
      import_file(gltf);
    } catch (const Error& error) {
      why = error.what();
    }
    CHECK(contains(why, "lies outside the file's folder; --allow-path DIR allows other ones"));
    CHECK(import_file(gltf, {}, std::array{folder.path()}).meshes.size() == 1);
  }
  CHECK_THROWS_AS(import_file(folder.write("a.gltf", file.gltf("missing.bin"))), Error);
  CHECK_THROWS_AS(import_file(folder.write("a.gltf", file.gltf("file:///etc/passwd"))), Error);
}
