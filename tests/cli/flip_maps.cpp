// The pictures that compare writes of FLIP and HDR-FLIP.
#include <algorithm>

#include "host/image/image_file.hpp"
#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

namespace {

// A dark picture with a square whose red is `brightness`.
Image bright_pixels(float brightness) {
  Image image(40, 30, 3);
  for (float& value : image.samples()) value = 0.05f;
  for (int y = 10; y < 20; ++y)
    for (int x = 10; x < 20; ++x) image.pixel(x, y)[0] = brightness;
  return image;
}

}  // namespace

TEST_CASE("compare measures HDR-FLIP of values above 1 or on request, and writes its errors and exposures") {
  const TemporaryFolder folder;
  write_image(folder / "a.exr", bright_pixels(90));
  write_image(folder / "b.exr", bright_pixels(60));
  const auto compare = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"compare", folder / "a.exr", folder / "b.exr"});
    return run_eyeray(options);
  };
  // To LDR-FLIP both squares are equally bright.
  ProcessResult result = compare({"--flip", folder / "flip.pfm", "--exposures", folder / "stops.pfm"});
  CHECK(result.code == 1);
  CHECK(result.out.find("FLIP: mean 0, ") != std::string::npos);
  CHECK(result.out.find("HDR-FLIP: mean 0.0") != std::string::npos);
  const Image flip = read_image(folder / "flip.pfm"), stops = read_image(folder / "stops.pfm");
  CHECK(*flip.pixel(15, 15) > 0.03f);
  CHECK(*flip.pixel(35, 25) == 0);
  CHECK(*stops.pixel(15, 15) < -2);
  REQUIRE(compare({"--flip", folder / "flip.png", "--exposures", folder / "stops.png"}).code == 1);
  CHECK(read_image(folder / "flip.png").channels() == 3);

  write_image(folder / "a.exr", bright_pixels(0.9f));
  write_image(folder / "b.exr", bright_pixels(0.6f));
  CHECK(compare({}).out.find("HDR-FLIP") == std::string::npos);
  CHECK(compare({"--hdr"}).out.find("HDR-FLIP") != std::string::npos);
  result = compare({"--exposures", folder / "none.png"});
  CHECK(result.code == 2);
  CHECK(result.err.find("--hdr asks for it") != std::string::npos);
  CHECK(compare({"--flip", folder / "b.exr"}).err.find("--flip would overwrite it") != std::string::npos);
}
