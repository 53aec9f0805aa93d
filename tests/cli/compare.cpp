// `eyeray compare` judges pictures, not how files store them.
#include "host/image/image_file.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("alpha is compared; grey equals a pixel of the same red, green and blue") {
  const TemporaryFolder folder;
  const std::string transparent = "tests/image/pictures/rgba_interlaced.png";
  image::write_image(folder / "opaque.png", image::read_image(transparent));
  CHECK(run_eyeray({"compare", transparent, transparent}).code == 0);
  const ProcessResult differs = run_eyeray({"compare", transparent, folder / "opaque.png"});
  CHECK(differs.code == 1);
  CHECK(differs.out.find("the alpha of ") != std::string::npos);

  // Pixels of the color key are transparent.
  const std::string keyed = "tests/image/pictures/grey2_transparent.png";
  image::write_image(folder / "opaque.png", image::read_image(keyed));
  CHECK(run_eyeray({"compare", folder / "opaque.png", keyed}).out.find("the alpha of ") != std::string::npos);

  const std::string grey = "tests/image/pictures/grey.png";
  image::write_image(folder / "color.png", image::in_color(image::read_image(grey)));
  CHECK(run_eyeray({"compare", grey, folder / "color.png"}).code == 0);

  // The text names channels that are not in the picture. A name with a line break stays in one line.
  const std::string layers = "tests/fuzz/corpus/exr/layers.exr", broken = folder / "a\nb.exr";
  std::filesystem::copy_file(layers, broken);
  const ProcessResult named = run_eyeray({"compare", layers, broken});
  CHECK(named.code == 0);
  CHECK(named.out.starts_with("PASSED " + layers + " " + (folder / "a?b.exr") + "\n"));
  CHECK(named.out.find("  not compared: ") != std::string::npos);
  CHECK(named.out.find("normal.X") != std::string::npos);
  CHECK(run_eyeray({"compare", layers, layers, "--layer", "normal"}).out.find("not compared") ==
        std::string::npos);
}
