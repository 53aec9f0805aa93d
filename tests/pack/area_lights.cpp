// Area lights of [[light]], compared with emissive shapes of the same form.
#include <cstring>

#include "host/loader/scene_file.hpp"
#include "host/pack/pack.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

namespace {

// A path-traced scene of a floor and `lights`.
Scene scene_of(const std::string& lights) {
  return loader::parse_scene(R"(
[render]
integrator = "path"
[[material]]
name = "floor"
type = "diffuse"
[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "floor"
)" + lights,
                             "scene.toml");
}

template <typename List>
bool same_bytes(const List& a, const List& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

struct Written {
  std::string shape, table, keys;
};

const Written area_shapes[] = {
    {"triangle", "triangle", "vertices = [[0, 2, 0], [1, 2, 0], [0, 2, 1]]\n"},
    {"rectangle", "parallelogram", "origin = [0, 3, 0]\nedge_u = [1, 0, 0]\nedge_v = [0, 0, 1]\n"},
    {"disk", "disk", "center = [0, 1, 0]\nnormal = [0, -1, 0]\nradius = 2\n"},
    {"sphere", "sphere", "batch = { center = [[3, 3, 0], [5, 3, 0]], radius = [1, 0.5] }\n"},
};
constexpr const char* transform = "transform = [{ translate = [0, 1, 0] }]\n";

}  // namespace

TEST_CASE("an area light is packed as the shape of a black material that emits as much") {
  for (const std::string side : {"both", "front"}) {
    CAPTURE(side);
    std::string lights;
    std::string emitters =
        "[[material]]\nname = \"lit\"\ntype = \"phong\"\ndiffuse = 0\nemission = [1, 2, 3]\nemission_side = "
        "\"" +
        side + "\"\n";
    for (const Written& it : area_shapes) {
      lights += "[[light]]\ntype = \"area\"\nshape = \"" + it.shape +
                "\"\nintensity = [1, 2, 3]\nemission_side = \"" + side + "\"\n" + transform + it.keys;
      emitters += "[[" + it.table + "]]\nmaterial = \"lit\"\n" + transform + it.keys;
    }
    const records::PackedScene packed = pack::pack(scene_of(lights));
    const records::PackedScene expected = pack::pack(scene_of(emitters));
    CHECK(packed.emitters.size() == 5);
    CHECK(packed.lights.empty());
    CHECK(same_bytes(packed.primitives, expected.primitives));
    CHECK(same_bytes(packed.materials, expected.materials));
    CHECK(same_bytes(packed.emitters, expected.emitters));
  }
}

TEST_CASE("an area light emits in front unless its table says otherwise, with radiance 1") {
  const Scene scene =
      scene_of("[[light]]\ntype = \"area\"\nshape = \"disk\"\nname = \"moon\"\n" + area_shapes[2].keys);
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.materials.back()->emits_in_front);
  CHECK(scene.materials.back()->constant_emission() == Vec3(1));
  CHECK(scene.warnings.empty());
}
