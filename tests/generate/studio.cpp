#include "host/generate/studio.hpp"

#include "host/image/image_file.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

TEST_CASE("the generated studio equals the file that lights scenes") {
  const test::TemporaryFolder folder;
  image::write_image(folder / "studio.hdr", generate::studio(64));
  CHECK(test::read_text(folder / "studio.hdr") == test::read_text("scenes/path/studio.hdr"));
}

TEST_CASE("a studio's light does not depend on its size") {
  const auto mean = [](const image::Image& picture) {
    double sum = 0;
    for (const float sample : picture.samples()) sum += double(sample);
    return sum / double(picture.sample_count());
  };
  CHECK(mean(generate::studio(512)) == doctest::Approx(mean(generate::studio(1024))).epsilon(0.01));
}
