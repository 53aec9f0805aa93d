// Names on the command line: legends of ids, verify's report of hits, check's lists.
#include <fmt/format.h>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "host/image/image_file.hpp"
#include "scene.hpp"
#include "tests/support/faults.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

namespace {

// The small scene with a name, a floor without one, and a mesh in a group.
class NamedScene : public SceneFolder {
 public:
  NamedScene() {
    replace_in_file(scene(), "[[sphere]]\n", "[[sphere]]\nname = \"left eye\"\n");
    write_text(scene(),
               read_text(scene()) +
                   "[[plane]]\npoint = [0, -0.5, 0]\nnormal = [0, 1, 0]\nmaterial = \"matte\"\n"
                   "[[group]]\nname = \"hat\"\n[[group.mesh]]\nfile = \"flap.obj\"\nmaterial = \"matte\"\n");
    write_text(*this / "flap.obj", "v -1 2 1\nv 1 2 1\nv 0 2.5 1\nv 0 1.8 1\nf 1 2 3\nf 2 1 4\n");
  }
};

// The pixel's colour as the legend writes it.
std::string code(const Image& picture, int x, int y) {
  const float* pixel = picture.pixel(x, y);
  return fmt::format("#{:02x}{:02x}{:02x}", srgb8(pixel[0]), srgb8(pixel[1]), srgb8(pixel[2]));
}

}  // namespace

TEST_CASE("a legend of the ids lies beside each picture of ids") {
  const NamedScene folder;
  const ProcessResult result = run_eyeray({"render", folder.scene(), "-o", folder / "a.png", "--aov",
                                           "primitive,material,depth", "--json", "--quiet"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  CHECK(result.out.find("a.primitive.json") != std::string::npos);
  CHECK_FALSE(folder.names().contains("a.depth.json"));

  const auto legend = nlohmann::json::parse(read_text(folder / "a.primitive.json"));
  const Image data = read_image(folder / "a.primitive.pfm");
  const Image shown = read_image(folder / "a.primitive.png");
  const auto& ids = legend.at("ids");
  REQUIRE(ids.size() == 3);
  CHECK(ids[0].at("kind") == "sphere");
  CHECK(ids[0].at("name") == "left eye");
  CHECK(ids[0].at("file") == folder.scene());
  CHECK(ids[0].at("line") == 24);
  CHECK(ids[1].at("kind") == "plane");
  CHECK_FALSE(ids[1].contains("name"));
  CHECK(ids[2].at("kind") == "mesh");
  CHECK(ids[2].at("group") == "hat");
  CHECK(ids[2].at("first") == 2);
  CHECK(ids[2].at("last") == 3);
  CHECK_FALSE(ids[2].contains("color"));

  // Every pixel belongs to an entry of the legend, and has that entry's colour.
  std::map<int, int64_t> pixels;
  int miscoloured = 0;
  for (int y = 0; y < data.height(); ++y) {
    for (int x = 0; x < data.width(); ++x) {
      const int id = int(*data.pixel(x, y));
      ++pixels[std::min(id, 2)];
      if (id < 2) {
        const auto& entry = id < 0 ? legend.at("nothing") : ids[size_t(id)];
        miscoloured += entry.at("color") != code(shown, x, y);
      }
    }
  }
  CHECK(miscoloured == 0);
  CHECK(legend.at("nothing").at("pixels") == pixels[-1]);
  for (int id = 0; id < 3; ++id) CHECK(ids[size_t(id)].at("pixels") == pixels[id]);

  const auto materials = nlohmann::json::parse(read_text(folder / "a.material.json"));
  REQUIRE(materials.at("ids").size() == 1);
  CHECK(materials.at("ids")[0].at("name") == "matte");
  CHECK(materials.at("ids")[0].at("pixels") == pixels[0] + pixels[1] + pixels[2]);
}

TEST_CASE("verify names the objects that differing pixels hit") {
  const NamedScene folder;
  const ProcessResult result =
      run_eyeray({"verify", folder.scene(), "--crop", "30,22,4,4", "--backends", "gpu", "--quiet",
                  "--shaders", lay_fault(folder, "light"), "--keep", folder / "kept"});
  CAPTURE(result.out);
  CHECK(result.code == 1);
  CHECK(result.out.find("primitive 0 (sphere \"left eye\", " + folder.scene() +
                        ":24), material 0 (\"matte\"), t ") != std::string::npos);
}

TEST_CASE("check lists names, and errors begin with them") {
  const NamedScene folder;
  ProcessResult result = run_eyeray({"check", folder.scene()});
  CHECK(result.out.find("\nnames        sphere \"left eye\"\n") != std::string::npos);
  result = run_eyeray({"check", folder.scene(), "--json"});
  const auto names = nlohmann::json::parse(result.out).at("names");
  CHECK(names.at("count") == 1);
  CHECK(names.at("first")[0] == "sphere \"left eye\"");

  result = run_eyeray({"check", folder.scene(), "-D", "sphere.0.radius=-1"});
  CHECK(result.code == 2);
  CHECK(result.err.find("error: sphere \"left eye\": `radius` must be ") != std::string::npos);
}
