// EXT_meshopt_compression: meshes from the library's encoder are read back; all else is refused.
#include "coded_grid.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

Json& meshopt_of(GltfFile& file, size_t view) {
  return file.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
}

// Four floats a vertex, the last of them 1: the input of the filters' encoders.
std::vector<float> by_four(const std::vector<double>& three) {
  std::vector<float> four;
  for (size_t i = 0; i < three.size(); ++i) {
    four.push_back(float(three[i]));
    if (i % 3 == 2) four.push_back(1);
  }
  return four;
}

}  // namespace

TEST_CASE("meshopt: attributes and indices decode in every mode, size and container, by both names") {
  check_grid(import_sound(grid_file().gltf(), "a.gltf"), 1e-6);
  for (const char* mode : {"TRIANGLES", "INDICES"}) {
    for (const int component : {5123, 5125}) {
      for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        const GltfFile file = meshopt_grid(mode, component, name);
        check_grid(import_sound(file.gltf(), "a.gltf"), 1e-6);
        check_grid(import_sound(file.glb(), "a.glb"), 1e-6);
      }
    }
  }
  const GltfFile file = meshopt_grid();
  const Folder folder;
  folder.write("coded.bin", file.data());
  check_grid(import_file(folder.write("a.gltf", file.gltf("coded.bin"))), 1e-6);
}

TEST_CASE("meshopt: coded data are used, and the fallback is not even read") {
  GltfFile file = meshopt_grid();
  file.json.erase("extensionsRequired");
  file.more_buffers = {{{"byteLength", 1 << 20}, {"uri", "missing.bin"}}};
  check_grid(import_sound(file.gltf(), "a.gltf"), 1e-6);
  file.json["bufferViews"][0].erase("extensions");
  CHECK_THROWS_AS(import_bytes(file.gltf(), "a.gltf"), Error);  // now the missing buffer is read
  file.more_buffers = {{{"byteLength", 1 << 20}}};
  CHECK(contains(refusal(file.gltf(), "a.gltf"), "buffers[1] has no data"));
}

TEST_CASE("meshopt: one view may hold interleaved and quantised attributes") {
  GltfFile file = grid_file();
  const Grid grid = hilly_grid();
  Bytes vertices;
  for (size_t i = 0; i < grid.uv.size() / 2; ++i) {
    for (size_t k = 0; k < 3; ++k) vertices.add(int16_t(std::lround(grid.positions[3 * i + k] * 32767)));
    vertices.add(uint16_t(0));
    for (size_t k = 0; k < 2; ++k) vertices.add(uint16_t(std::lround(grid.uv[2 * i + k] * 65535)));
  }
  code_view(file, 0, vertices.text(), {"ATTRIBUTES", 12});
  file.json["bufferViews"][0]["byteStride"] = 12;
  file.json["accessors"][0].update({{"componentType", 5122}, {"normalized", true}});
  for (const char* bound : {"min", "max"})
    for (Json& number : file.json["accessors"][0][bound]) number = number.get<double>() * 32767;
  file.json["accessors"][2].update(
      {{"componentType", 5123}, {"normalized", true}, {"bufferView", 0}, {"byteOffset", 8}});
  for (const char* bound : {"min", "max"}) file.json["accessors"][2].erase(bound);
  file.json["extensionsUsed"].push_back("KHR_mesh_quantization");
  check_grid(import_sound(file.gltf(), "a.gltf"), 1e-3);
}

TEST_CASE("meshopt: the filter OCTAHEDRAL decodes 8 and 16 bits") {
  const std::vector<float> normals = by_four(hilly_grid().normals);
  const size_t count = normals.size() / 4;
  for (const size_t stride : {4, 8}) {
    std::string coded(count * stride, '\0');
    meshopt_encodeFilterOct(coded.data(), count, stride, stride == 4 ? 8 : 12, normals.data());
    GltfFile file = grid_file();
    code_view(file, 1, coded, {"ATTRIBUTES", stride, "OCTAHEDRAL"});
    file.json["bufferViews"][1]["byteStride"] = stride;
    file.json["accessors"][1].update({{"componentType", stride == 4 ? 5120 : 5122}, {"normalized", true}});
    for (const char* bound : {"min", "max"}) file.json["accessors"][1].erase(bound);
    file.json["extensionsUsed"].push_back("KHR_mesh_quantization");
    check_grid(import_sound(file.gltf(), "a.gltf"), stride == 4 ? 2e-2 : 1e-3);
    meshopt_of(file, 1).erase("filter");
    const ImportedScene raw =
        import_bytes(file.gltf(), "a.gltf");  // without the filter its numbers are not normals
    CHECK(glm::length(raw.meshes[0].normals[1] - normal_at(1.0 / (grid_side - 1), 0)) > 0.1);
  }
}

TEST_CASE("meshopt: the filter EXPONENTIAL is decoded") {
  std::vector<float> positions;
  for (const double number : hilly_grid().positions) positions.push_back(float(number));
  std::string coded(positions.size() * 4, '\0');
#if MESHOPTIMIZER_VERSION >= 190
  meshopt_encodeFilterExp(coded.data(), positions.size() / 3, 12, 15, positions.data(),
                          meshopt_EncodeExpSharedVector);
#else
  meshopt_encodeFilterExp(coded.data(), positions.size() / 3, 12, 15, positions.data());
#endif
  GltfFile file = grid_file();
  code_view(file, 0, coded, {"ATTRIBUTES", 12, "EXPONENTIAL"});
  check_grid(import_sound(file.gltf(), "a.gltf"), 1e-3);
  meshopt_of(file, 0)["filter"] = "NONE";
  CHECK(glm::length(import_bytes(file.gltf(), "a.gltf").meshes[0].positions[0]) > 1e3);
}

// This file has no rotations, so the test uses colours, which have four numbers too.
TEST_CASE("meshopt: the filter QUATERNION is decoded") {
  std::vector<float> turns;
  for (int i = 0; i < grid_side * grid_side; ++i) {
    const Vec4 turn = glm::normalize(Vec4(1 + i % 3, 1 + i % 5, 9, 1 + i % 7));
    for (int k = 0; k < 4; ++k) turns.push_back(float(turn[k]));
  }
  std::string coded(turns.size() * 2, '\0');
  meshopt_encodeFilterQuat(coded.data(), turns.size() / 4, 8, 16, turns.data());
  GltfFile file = grid_file();
  file.primitive()["attributes"]["COLOR_0"] = 4;
  file.json["accessors"].push_back({{"bufferView", file.add_view(coded)},
                                    {"componentType", 5122},
                                    {"normalized", true},
                                    {"type", "VEC4"},
                                    {"count", turns.size() / 4}});
  code_view(file, 4, coded, {"ATTRIBUTES", 8, "QUATERNION"});
  const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
  const Mesh& mesh = scene.meshes[0];
  REQUIRE(mesh.colors.size() == mesh.positions.size());
  REQUIRE(mesh.alphas.size() == mesh.positions.size());
  double worst = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const auto at =
        size_t(std::lround(mesh.positions[i].x * 11) + 12 * std::lround(mesh.positions[i].y * 11));
    for (int k = 0; k < 3; ++k)
      worst = std::max(worst, std::abs(mesh.colors[i][k] - double(turns[4 * at + size_t(k)])));
    worst = std::max(worst, std::abs(mesh.alphas[i] - double(turns[4 * at + 3])));
  }
  CHECK(worst < 1e-3);
}

TEST_CASE("meshopt: violations of the specification are refused, with their position") {
  const struct {
    size_t view;
    Json changes;
    std::string why;
  } cases[] = {
      {0, {{"mode", "STRIPS"}}, "has the mode \"STRIPS\", which eyeray does not support"},
      {0, {{"filter", "COLOR"}}, "has the filter \"COLOR\", which eyeray does not support"},
      {0, {{"byteStride", 6}, {"count", 288}}, "has a byteStride of 6, which ATTRIBUTES cannot have"},
      {0, {{"byteStride", 0}}, "has a byteStride of 0, which ATTRIBUTES cannot have"},
      {0, {{"byteStride", 576}, {"count", 3}}, "has a byteStride of 576, which ATTRIBUTES cannot have"},
      {3, {{"byteStride", 12}}, "has a byteStride of 12, which TRIANGLES cannot have"},
      {3, {{"count", 725}}, "has a count of 725, which must be a multiple of three"},
      {0,
       {{"filter", "OCTAHEDRAL"}},
       "has the filter OCTAHEDRAL, which ATTRIBUTES with a byteStride of 12 cannot have"},
      {0,
       {{"filter", "QUATERNION"}},
       "has the filter QUATERNION, which ATTRIBUTES with a byteStride of 12 cannot have"},
      {3,
       {{"filter", "EXPONENTIAL"}},
       "has the filter EXPONENTIAL, which TRIANGLES with a byteStride of 2 cannot have"},
      {0, {{"count", 143}}, "should have 1728 bytes, but is decoded to 143 elements of 12"},
      {0, {{"count", 1e15}}, "should have 1728 bytes, but is decoded to 1000000000000000 elements of 12"},
      {0,
       {{"mode", "INDICES"}, {"byteStride", 4}, {"count", 432}},
       "has data that are damaged: they are not INDICES"},
      {0, {{"byteLength", 1e9}}, "of a buffer that has"},
      {0, {{"buffer", 7}}, "buffer must be an index below 2"},
      {0, {{"buffer", 1}}, "buffers[1] has no data"},
  };
  for (const auto& each : cases) {
    const size_t view = each.view;
    const std::string& why = each.why;
    CAPTURE(why);
    GltfFile file = meshopt_grid();
    meshopt_of(file, view).update(each.changes);
    const std::string message = refusal(file.gltf(), "a.gltf");
    CAPTURE(message);
    CHECK(contains(message, why));
    if (!contains(why, "buffers[1]")) CHECK(contains(message, fmt::format("bufferViews[{}]", view)));
  }
  GltfFile file = meshopt_grid();
  file.json["bufferViews"][0]["byteStride"] = 16;
  CHECK(contains(refusal(file.gltf(), "a.gltf"),
                 "bufferViews[0] has another byteStride than its decoded data"));
}

TEST_CASE("meshopt: data truncated at any byte, or of another version, are refused") {
  for (const auto& [mode, view] : {std::pair("TRIANGLES", size_t{0}), std::pair("TRIANGLES", size_t{3}),
                                   std::pair("INDICES", size_t{3})}) {
    GltfFile file = meshopt_grid(mode);
    const size_t whole = meshopt_of(file, view)["byteLength"];
    for (size_t length = 0; length < whole; ++length) {
      meshopt_of(file, view)["byteLength"] = length;
      const std::string why = refusal(file.glb(), "a.glb");
      CAPTURE(why);
      REQUIRE((contains(why, "cannot encode") || contains(why, "are damaged")));
    }
  }
  GltfFile file = meshopt_grid();
  Json& coding = meshopt_of(file, 0);
  std::string later = file.data().substr(coding["byteOffset"], coding["byteLength"]);
  later[0] = char(0xa1);
  coding["byteOffset"] = file.json["bufferViews"][size_t(file.add_view(later))]["byteOffset"];
  CHECK(contains(refusal(file.gltf(), "a.gltf"),
                 "[0].extensions.EXT_meshopt_compression has data of version 1 of ATTRIBUTES; eyeray reads "
                 "versions up to 0"));
}

TEST_CASE("meshopt: absurd counts take no memory, alone or many of them together") {
  // A coded byte stands for at most 64 bytes, apart from the bytes at the ends.
  for (const auto& [view, stride] : {std::pair(size_t{0}, 12), std::pair(size_t{3}, 2)}) {
    GltfFile file = meshopt_grid();
    meshopt_of(file, view)["count"] = 999999999;
    file.json["bufferViews"][view]["byteLength"] = 999999999ll * stride;
    CHECK(contains(refusal(file.gltf(), "a.gltf"), "bytes, which cannot encode 999999999 elements"));
  }

  // Only zeros: each block of 256 elements of 32 bytes is coded in 128 bytes.
  const std::string zeros(size_t{1} << 18, '\0');
  GltfFile file;
  Json view;
  for (int i = 0; i < 40; ++i) {
    const int accessor = file.add({}, 5126, "VEC3", 3);
    if (i == 0) {
      code_view(file, 0, zeros, {"ATTRIBUTES", 32});
      view = file.json["bufferViews"][0];
      CHECK(view["extensions"]["EXT_meshopt_compression"]["byteLength"] == 1 + zeros.size() / 64 + 32);
    }
    file.json["accessors"][size_t(accessor)]["bufferView"] = int(file.json["bufferViews"].size());
    file.json["accessors"][size_t(accessor)]["count"] = 1;
    file.json["bufferViews"].push_back(view);
    file.json["meshes"][0]["primitives"][size_t(i)] = {{"attributes", {{"POSITION", accessor}}}};
  }
  CHECK(contains(refusal(file.glb(), "a.glb"),
                 "makes the decoded data larger than a file of this size may have"));
}
