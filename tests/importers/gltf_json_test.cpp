// The JSON of glTF files.
#include <ctime>

#include "gltf_files.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

TEST_CASE("a key that occurs twice in an object is refused, with its position") {
  const std::string plain = square_file().gltf();
  const auto with = [&](const std::string& extras) {
    return refusal("{\n\"extras\": " + extras + "," + plain.substr(1), "a.gltf");
  };
  CHECK(with("{\"a\": {\"a\": 1}, \"b\": [{\"a\": \"a\"}, {\"a\": \"\\\"b\"}]}") == "accepted");
  CHECK(with("{\"a\": 1, \"b\": {}, \"a\": 1}") == "a.gltf:2:29: error: an object has the key \"a\" twice");
  CHECK(with("[{\"a\": [1, \"a\"], \"\\u0061\": 1}]") ==
        "a.gltf:2:28: error: an object has the key \"a\" twice");
  CHECK(with("1, \"extras\": 2") == "a.gltf:2:14: error: an object has the key \"extras\" twice");
}

TEST_CASE("the time to read JSON grows linearly with its length, and its number of values is bounded") {
  GltfFile file = square_file();
  const std::string plain = file.gltf();
  const size_t index = plain.find("\"nodes\":[") + 9;
  const auto with_nodes = [&](size_t count) {
    std::string nodes;
    for (size_t i = 0; i < count; ++i) nodes += "{},";
    return std::string(plain).insert(index, nodes);
  };
  // When the time grew with the square of the size, this took 17 s; now it takes a tenth of a second.
  std::string many = with_nodes(300'000);
  many.replace(many.find("\"nodes\":[0]"), 11, "\"nodes\":[300000]");
  const std::clock_t before = std::clock();
  CHECK(import_bytes(many, "a.gltf").instances.size() == 1);
  CHECK(double(std::clock() - before) / CLOCKS_PER_SEC < 8);

  const std::string too_many = refusal("{\"a\":[0\n" + std::string(size_t{1} << 24, ',') + ",0]}", "a.gltf");
  CHECK(too_many == "a.gltf:2:16777215: error: its JSON has more than 16777216 values");
  // Brackets in strings do not count as nesting.
  CHECK(refusal("{\"a\":\"" + std::string(100, '[') + "\\\"" + std::string(100, '{') + "\"}", "a.gltf") ==
        "a.gltf: error: it is not glTF 2: its asset.version is \"\"");
}
