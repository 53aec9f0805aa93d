// Pictures and AOVs as the layers of one .exr.
#include <algorithm>
#include <bit>

#include "host/image/image_file.hpp"
#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

namespace {

bool same_bits(const Image& a, const Image& b) {
  return a.same_size(b) && std::ranges::equal(a.samples(), b.samples(), [](float x, float y) {
           return std::bit_cast<uint32_t>(x) == std::bit_cast<uint32_t>(y);
         });
}

}  // namespace

TEST_CASE("an .exr holds the picture and every AOV with the bits of their separate files") {
  const SceneFolder folder;
  const ProcessResult result = run_eyeray({"render", folder.scene(), "--aov", "all", "-o", folder / "a.exr"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  CHECK(folder.names() ==
        std::set<std::string>{"scene.toml", "a.exr", "a.shape.json", "a.primitive.json", "a.material.json"});
  const std::string legend = read_text(folder / "a.shape.json");
  REQUIRE(run_eyeray({"render", folder.scene(), "--aov", "all", "-o", folder / "a.pfm"}).code == 0);
  CHECK(read_text(folder / "a.shape.json") == legend);
  CHECK(same_bits(read_image(folder / "a.exr"), read_image(folder / "a.pfm")));
  int layers = 0;
  for (const std::string& name : folder.names()) {
    if (!name.starts_with("a.") || !name.ends_with(".pfm") || name == "a.pfm") continue;
    const std::string layer = name.substr(2, name.size() - 6);
    CAPTURE(layer);
    CHECK(same_bits(read_image(folder / "a.exr", layer), read_image(folder / name)));
    CHECK(run_eyeray({"compare", "--layer", layer, folder / "a.exr", folder / name}).code == 0);
    ++layers;
  }
  CHECK(layers == 22);
  CHECK(run_eyeray({"compare", folder / "a.exr", folder / "a.pfm"}).code == 0);
  CHECK(run_eyeray({"compare", "--layer", "normal", folder / "a.exr", folder / "a.position.pfm"}).code == 1);
}

TEST_CASE("the first of several outputs has the AOVs, and --half affects only the picture") {
  const SceneFolder folder;
  const ProcessResult result = run_eyeray({"render", folder.scene(), "--aov", "depth", "--half", "-o",
                                           folder / "a.exr", "-o", folder / "b.exr", "-o", folder / "c.pfm"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  CHECK(folder.names() == std::set<std::string>{"scene.toml", "a.exr", "b.exr", "c.pfm"});
  CHECK(same_bits(read_image(folder / "a.exr"), read_image(folder / "b.exr")));
  CHECK(run_eyeray({"compare", folder / "a.exr", folder / "c.pfm", "--tolerance", "1e-6"}).code == 1);
  CHECK(run_eyeray({"compare", folder / "a.exr", folder / "c.pfm", "--tolerance", "5e-4"}).code == 0);
  CHECK(*read_image(folder / "a.exr", "depth").pixel(32, 24) == doctest::Approx(3).epsilon(1e-3));
}

TEST_CASE("compare names the fault of an .exr, and lists its layers") {
  const SceneFolder folder;
  REQUIRE(run_eyeray({"render", folder.scene(), "--aov", "depth,uv", "-o", folder / "a.exr"}).code == 0);
  const auto refusal = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    const ProcessResult result = run_eyeray(arguments);
    CHECK(result.code != 0);
    return result.err + result.out;
  };
  const std::string a = folder / "a.exr";
  CHECK(refusal({"--layer", "dept", a, a}) ==
        "eyeray: error: cannot read " + a + " as EXR: it has no layer 'dept'; its layers are depth, uv\n");
  CHECK(refusal({"--layer", "depth", "a.pfm", "b.png"}) ==
        "eyeray: error: --layer depth needs an .exr: neither a.pfm nor b.png is one\n");
  CHECK(refusal({"tests/fuzz/corpus/exr/zip.exr", a})
            .find("the sizes differ: 9×5 in 3 channels against 64×48") != std::string::npos);
  CHECK(refusal({"none.exr", a}).find("cannot read none.exr: ") != std::string::npos);
}

TEST_CASE("interrupted at any time, an .exr is whole or absent") {
  const SceneFolder folder;
  for (const int stop : {30, 80, 150, 300, 500, 800}) {
    const ProcessResult result = run_eyeray({"render", folder.scene(), "-s", "900x600", "--spp", "4",
                                             "--backend", "twin", "--aov", "all", "-o", folder / "a.exr"},
                                            {}, 120, stop);
    CAPTURE(result.err);
    CHECK((result.code == 0 || result.code == 130));
    for (const std::string& name : folder.names()) CHECK(name.find(".part") == std::string::npos);
    if (!folder.names().contains("a.exr")) continue;
    CHECK(read_image(folder / "a.exr").width() == 900);
    std::filesystem::remove(folder / "a.exr");
  }
}
