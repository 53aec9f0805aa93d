// Files cut short at every byte, and files with random damage: refused or read, never a crash, and a file
// that is read keeps every promise.
#include <fmt/format.h>

#include <random>

#include "coded_grid.hpp"
#include "tests/support/package.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

struct Seed {
  std::string name;
  std::string bytes;
};

std::vector<Seed> seeds() {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  Bytes little, big(std::endian::big);
  for (Bytes* data : {&little, &big}) {
    for (const double number : square_positions) data->add(float(number));
    data->add(uint8_t(4)).add(0).add(1).add(2).add(3);
  }
  const auto header = [&](const std::string& format) {
    return "ply\nformat " + format + " 1.0\nelement vertex 4\n" + xyz +
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  };
  const auto pcd = [](const std::string& data) {
    return "VERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\n"
           "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA " +
           data + "\n";
  };
  Bytes points;
  for (const double number : {0, 0, 0, 7, 1, 2, 3, 255}) points.add(float(number));
  GltfFile gltf = square_file();
  gltf.primitive()["attributes"]["NORMAL"] = gltf.add({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 3);
  gltf.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}}}}};
  gltf.json["nodes"][0]["translation"] = {1, 2, 3};
  gltf.json["animations"] = {
      {{"samplers",
        {{{"input", gltf.add({0, 1}, 5126, "SCALAR", 1)},
          {"output", gltf.add({0, 0, 0, 1, 0, 1, 0, 0}, 5126, "VEC4", 4)}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
  return {
      {"a.obj",
       "mtllib a.mtl\no thing\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.2 0\nvt 0 0\nvt 1 0\nvn 0 0 1\n"
       "usemtl red\nf 1/1/1 2/2/1 3/1/1 4/2/1\ns off\nf -5//-1 -4//-1 -3//-1 -1//-1\nf 1 \\\n 2 3\nl 1 2\n"},
      {"a.ply", header("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"},
      {"b.ply", header("binary_little_endian") + little.text()},
      {"c.ply", header("binary_big_endian") + big.text()},
      {"d.ply", "ply\nformat ascii 1.0\nelement vertex 2\n" + xyz + "end_header\n0 0 0\n1 2 3\n"},
      {"a.off", "COFF\n4 1 0\n0 0 0 9 9 9\n1 0 0 9 0 9\n1 1 0 9 9 0 255\n0 1 0 0 9 9\n4 0 1 2 3 255 0 0\n"},
      {"a.3mf", package_3mf(model_3mf("<m:colorgroup id=\"2\"><m:color color=\"#FF0000\"/></m:colorgroup>"
                                      "<object id=\"1\">" +
                                          square_3mf("pid=\"2\" p1=\"0\"") + "</object>",
                                      "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0 1\"/>"))},
      {"a.xyz", "# a scan\n3\n0 0 0 255 0 128\n1 0 0 0 255 1\n0 2e0 +0 7 8 9\n"},
      {"a.pcd", pcd("ascii") + "0 0 0 7\n1 0 0 9\n"},
      {"b.pcd", pcd("binary") + points.text()},
      {"c.pcd", pcd("binary_compressed") + std::string("\x21\0\0\0\x20\0\0\0\x1f", 9) + points.text()},
      {"a.gltf", gltf.gltf()},
      {"a.glb", gltf.glb()},
      {"meshopt.glb", meshopt_grid().glb()},
      {"draco.glb", draco_grid().glb()}};
}

// True if the bytes are read; false if they are refused.
bool survives(const std::string& bytes, const std::string& name) {
  try {
    const ImportedScene scene = import_bytes(bytes, name, {.playing = {.seconds = 0.5}});
    REQUIRE(broken_promise(scene) == "");
    return true;
  } catch (const Error& error) {
    REQUIRE(std::string(error.what()).size() > 5);
    return false;
  }
}

}  // namespace

TEST_CASE("files truncated at every byte are refused or read") {
  for (const Seed& seed : seeds()) {
    const auto& name = seed.name;
    const auto& bytes = seed.bytes;
    CAPTURE(name);
    CHECK(survives(bytes, name));
    size_t read = 0;
    for (size_t length = 0; length < bytes.size(); ++length) read += survives(bytes.substr(0, length), name);
    // Binary data and JSON must be complete; a text file may end sooner. minizip does without the last two
    // bytes of a ZIP, the length of a comment.
    if (!name.ends_with("obj") && !name.ends_with("xyz") && !name.ends_with("off"))
      CHECK(read <= (name.ends_with("3mf") ? 3 : 1));
  }
}

TEST_CASE("files with random damage are refused or read") {
  std::mt19937 random(11);
  const auto below = [&](size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(random); };
  constexpr std::string_view tokens[] = {"-1",
                                         "0",
                                         "4294967295",
                                         "1e999",
                                         "nan",
                                         "-",
                                         "/",
                                         "//",
                                         "f ",
                                         "\n",
                                         "usemtl ",
                                         "{",
                                         "}",
                                         "[",
                                         "\"",
                                         ":",
                                         "null",
                                         "true",
                                         "0.5",
                                         "\xff",
                                         "\\\n",
                                         ",",
                                         "9999999999999999999"};
  for (const Seed& seed : seeds()) {
    const auto& name = seed.name;
    CAPTURE(name);
    size_t read = 0;
    constexpr size_t rounds = 4000;
    for (size_t round = 0; round < rounds; ++round) {
      std::string bytes = seed.bytes;
      for (size_t change = 0, changes = 1 + below(4); change < changes; ++change) {
        const size_t at = below(bytes.size());
        const size_t length = std::min(1 + below(8), bytes.size() - at);
        switch (below(4)) {
          case 0:
            bytes[at] = static_cast<char>(below(256));
            break;
          case 1:
            bytes.replace(at, length, tokens[below(std::size(tokens))]);
            break;
          case 2:
            bytes.insert(below(bytes.size()), bytes.substr(at, length));
            break;
          default:
            bytes[at] = static_cast<char>(bytes[at] ^ char(1 << below(8)));
        }
      }
      read += survives(bytes, name);
    }
    CHECK(read > 5);
    CHECK(read < rounds);
  }
}

TEST_CASE("files other than mesh files are refused") {
  CHECK(refusal("", "a.3ds") == fmt::format("a.3ds: error: a mesh file's name must end in {}", mesh_endings));
  CHECK_FALSE(is_mesh_file("a.toml"));
  CHECK_FALSE(is_mesh_file("obj"));
  CHECK(is_mesh_file("x/A.GLB"));
  const Folder folder;
  for (const std::string& name : {folder / "none.obj", std::string("/dev/zero.obj")})
    CHECK_THROWS_AS(import_file(name), Error);
}
