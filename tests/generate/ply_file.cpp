#include "host/generate/ply_file.hpp"

#include <cstring>

#include "host/generate/sphereflake.hpp"
#include "host/generate/terrain.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::generate;
using eyeray::engine::test::read_text;
using eyeray::engine::test::TemporaryFolder;

namespace {

// FNV-1a.
uint64_t hash(const std::string& bytes) {
  uint64_t value = 0xcbf29ce484222325u;
  for (const char c : bytes) value = (value ^ uint8_t(c)) * 0x100000001b3u;
  return value;
}

}  // namespace

TEST_CASE("a PLY file has its header, then vertices, then faces, little-endian") {
  const TemporaryFolder folder;
  PlyFile file(folder / "a.ply", "a comment");
  file.begin(3, 1);
  file.vertex({1, 2, 3}, {0, 0, 1});
  file.vertex({4, 5, 6}, {0, 1, 0});
  file.vertex({0.1, 0, 0}, {1, 0, 0});
  file.triangle(0, 1, 2);
  CHECK(folder.names().count("a.ply") == 0);  // nothing before commit
  file.commit();
  CHECK(folder.names() == std::set<std::string>{"a.ply"});

  const std::string text = read_text(folder / "a.ply");
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment a comment\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "element face 1\nproperty list uchar uint vertex_indices\nend_header\n";
  REQUIRE(text.starts_with(header));
  REQUIRE(text.size() == header.size() + 3 * 24 + 13);
  CHECK(file.bytes() == text.size());
  float values[18];
  std::memcpy(values, text.data() + header.size(), sizeof values);
  CHECK(values[0] == 1);
  CHECK(values[11] == 0);
  CHECK(values[12] == 0.1f);
  CHECK(values[15] == 1);
  CHECK(text.substr(header.size() + 72) == std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13));
}

TEST_CASE("an unfinished mesh leaves nothing") {
  const TemporaryFolder folder;
  {
    PlyFile file(folder / "a.ply", "");
    file.begin(300'000, 1);
    for (int i = 0; i < 300'000; ++i) file.vertex(Vec3(0.0), {0, 0, 1});
  }
  CHECK(folder.names().empty());
}

TEST_CASE("generated files are the same on every machine") {
  const TemporaryFolder folder;
  PlyFile terrain(folder / "terrain.ply", "");
  terrain_mesh({.grid = 200, .seed = 42}, terrain);
  terrain.commit();
  CHECK(hash(read_text(folder / "terrain.ply")) == 17999887847188548354u);

  PlyFile flake(folder / "flake.ply", "");
  sphereflake_mesh(3, 2, flake);
  flake.commit();
  CHECK(hash(read_text(folder / "flake.ply")) == 9839308808140660727u);
  CHECK(hash(sphereflake_spheres(4)) == 16982202584418866316u);
}
