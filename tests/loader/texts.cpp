// Texts, against the letters of scripts/make-font, and hostile fonts.
#include <cmath>
#include <fstream>
#include <iterator>

#include "host/core/error.hpp"
#include "host/loader/scene_file.hpp"
#include "tests/loader/folder.hpp"
#include "tests/loader/walls.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

std::string bytes_of_font() {
  std::ifstream file("scenes/shapes/include/eyeray.ttf", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A scene with one text, and the font beside it.
class TextFolder {
 public:
  explicit TextFolder(const std::string& font = bytes_of_font()) { folder_.write("font.ttf", font); }

  Scene load(const std::string& text, const std::string& more = "") {
    folder_.write("scene.toml", "[[material]]\nname = \"wall\"\ntype = \"phong\"\n[[text]]\ntext = \"" +
                                    text + "\"\nfont = \"font.ttf\"\ndepth = 0.2\nmaterial = \"wall\"\n" +
                                    more);
    return loader::load_scene(folder_.path() / "scene.toml", {});
  }
  // The error, or "accepted".
  std::string error_of(const std::string& text, const std::string& more = "") {
    try {
      load(text, more);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

 private:
  Folder folder_;
};

// True if the text has a letter at (x, y).
bool is_inked(const Scene& scene, double x, double y) {
  const auto hit = scene.shapes.at(0)->intersect({{x, y, 5}, {0, 0, -1}});
  if (hit) CHECK(hit->t == doctest::Approx(4.8));
  return hit.has_value();
}

}  // namespace

TEST_CASE("letters are those of the font, up to the tolerance") {
  TextFolder folder;
  const Scene scene = folder.load("o");
  // Circles of 0.26 and 0.17 around (0.28, 0.25).
  for (int i = 0; i < 360; ++i) {
    const double angle = i * 0.0174532925;
    const auto at = [&](double radius) {
      return is_inked(scene, 0.28 + radius * std::cos(angle), 0.25 + radius * std::sin(angle));
    };
    CAPTURE(i);
    CHECK(at(0.2585));
    CHECK(!at(0.2615));
    CHECK(at(0.1715));
    CHECK(!at(0.1685));
  }
  const Bounds bounds = scene.shapes[0]->bounds();
  CHECK(bounds.min.z == doctest::Approx(0));
  CHECK(bounds.max.z == doctest::Approx(0.2));

  // u and v on the front are x and y.
  const Ray ray{{0.28, 0.02, 5}, {0, 0, -1}};
  const SurfacePoint point = scene.shapes[0]->surface(ray, *scene.shapes[0]->intersect(ray));
  CHECK(point.uv.x == doctest::Approx(0.28));
  CHECK(point.uv.y == doctest::Approx(0.02));
  CHECK(point.normal.z == doctest::Approx(1));
}

TEST_CASE("letters are set with their widths, kerning, lines and alignment") {
  TextFolder folder;
  // The r is 0.35 wide, and an a behind it moves 0.03 to the left. The stem of the a ends at 0.54.
  const double right = 0.35 - 0.03 + 0.54;
  const Scene scene = folder.load("ra");
  CHECK(is_inked(scene, right - 0.002, 0.1));
  CHECK(!is_inked(scene, right + 0.002, 0.1));

  const Scene pair = folder.load("o\\no", "size = 2\n");
  CHECK(is_inked(pair, 0.56, 0.1));
  CHECK(is_inked(pair, 0.56, 0.1 - 2.3));  // 1.15 ems below
  CHECK(!is_inked(pair, 0.56, 0.5 - 2.3));

  for (const double share : {0.0, 0.5, 1.0}) {
    const char* align = share == 0 ? "left" : share == 1 ? "right" : "center";
    const Scene aligned = folder.load("o", std::string("align = \"") + align + "\"\n");
    const Bounds bounds = aligned.shapes[0]->bounds();
    CHECK((bounds.min.x + bounds.max.x) / 2 == doctest::Approx(0.28 - share * 0.56));
  }
  // An é in UTF-8 is an e with an accent.
  const Scene accent = folder.load("é");
  CHECK(is_inked(accent, 0.33, 0.65));
  CHECK(!is_inked(folder.load("e"), 0.33, 0.65));
}

TEST_CASE("letters that the font lacks are left out, with a warning") {
  TextFolder folder;
  const Scene scene = folder.load("eßzy");
  REQUIRE(!scene.warnings.empty());  // the other one is that the scene is dark
  CHECK(scene.warnings.back().message ==
        "2 of the text's 4 letters are left out, because the font has no U+00DF …");
  CHECK(folder.load("e").warnings.size() + 1 == scene.warnings.size());
  CHECK(folder.error_of("z").find("the text has no visible letter") != std::string::npos);
  CHECK(folder.error_of(" ").find("the text has no visible letter") != std::string::npos);
}

TEST_CASE("a text may be part of a CSG object") {
  Folder folder;
  folder.write("font.ttf", bytes_of_font());
  folder.write(
      "scene.toml",
      "[[material]]\nname = \"wall\"\ntype = \"phong\"\n[[csg]]\nmaterial = \"wall\"\n[[csg.box]]\n"
      "min = [0, 0, -0.5]\nmax = [1, 1, 0.1]\n[[csg.minus.text]]\ntext = \"o\"\nfont = \"font.ttf\"\n"
      "depth = 0.2\n");
  const Scene scene = loader::load_scene(folder.path() / "scene.toml", {});
  const auto depth = [&](double x, double y) {
    return 5 - scene.shapes.at(0)->intersect({{x, y, 5}, {0, 0, -1}}).value().t;
  };
  CHECK(depth(0.28, 0.25) == doctest::Approx(0.1));
  CHECK(depth(0.28, 0.03) == doctest::Approx(0));
}

TEST_CASE("faulty and hostile fonts are refused") {
  const std::string font = bytes_of_font();
  REQUIRE(font.size() > 1000);
  const auto why = [](const std::string& bytes) { return TextFolder(bytes).error_of("eyeray"); };
  CHECK(why("").find("it is no TrueType or OpenType font") != std::string::npos);
  CHECK(why("\x1f\x8b\x08 compressed").find("it is no TrueType or OpenType font") != std::string::npos);
  CHECK(why(font.substr(0, 300)).find("the font cannot be used: it is damaged") != std::string::npos);

  // Wherever the file ends and whatever its bytes are, there is a picture or an error.
  for (size_t size = 0; size < font.size(); size += 37) CHECK(!why(font.substr(0, size)).empty());
  Random random{11};
  int accepted = 0, failed = 0;
  for (int i = 0; i < 300; ++i) {
    std::string bytes = font;
    for (int k = 0; k < 4; ++k) bytes[size_t(random.below(int(bytes.size())))] = char(random.below(256));
    (why(bytes) == "accepted" ? accepted : failed)++;
  }
  MESSAGE(accepted << " fonts with changed bytes are accepted, " << failed << " refused");
  CHECK(accepted > 0);
  CHECK(failed > 0);

  // Kerning that pushes an a into an r.
  std::string pushed = font;
  const size_t kern = pushed.find("\xff\xe2");  // −30
  REQUIRE(kern != std::string::npos);
  REQUIRE(pushed.find("\xff\xe2", kern + 1) == std::string::npos);
  pushed.replace(kern, 2, "\xfe\xc0");
  const std::string found = TextFolder(pushed).error_of("ra");
  CAPTURE(found);
  CHECK(found.find("the letters \"r\" and \"a\" overlap or touch") != std::string::npos);

  Folder folder;
  folder.write("scene.toml",
               "[[material]]\nname = \"wall\"\ntype = \"phong\"\n[[text]]\ntext = \"a\"\nfont = "
               "\"../font.ttf\"\ndepth = 0.2\nmaterial = \"wall\"\n");
  CHECK_THROWS_AS(loader::load_scene(folder.path() / "scene.toml", {}), InputError);

  const std::string without_file =
      refused("[[text]]\ntext = \"a\"\nfont = \"a.ttf\"\ndepth = 1\nmaterial = \"wall\"\n");
  CHECK(without_file.find("only a scene in a file can have fonts") != std::string::npos);
}
