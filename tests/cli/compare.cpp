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

  const std::string grey = "tests/image/pictures/grey.png";
  image::write_image(folder / "color.png", image::in_color(image::read_image(grey)));
  CHECK(run_eyeray({"compare", grey, folder / "color.png"}).code == 0);
}
