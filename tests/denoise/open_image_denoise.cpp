// Open Image Denoise, by a library with its interface.
#include "host/denoise/open_image_denoise.hpp"

#include <cstdlib>
#include <limits>

#include "host/core/error.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::denoise;
using image::Image;

namespace {

NoisyPicture small_picture() {
  NoisyPicture picture;
  for (Image* each : {&picture.color, &picture.albedo, &picture.normal}) *each = Image(5, 4, 3);
  for (size_t i = 0; i < picture.color.sample_count(); ++i) {
    picture.color.samples()[i] = float(i) / 4;
    picture.albedo.samples()[i] = float(i) / 64;
    picture.normal.samples()[i] = -float(i) / 128;
  }
  return picture;
}

std::string error_of(const NoisyPicture& picture) {
  try {
    denoise_by_oidn(picture);
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::bad_input);
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a library that is missing is one error; one that is there gets colour, albedo and normal") {
  NoisyPicture picture = small_picture();
  setenv("EYERAY_OPEN_IMAGE_DENOISE", "/no/such/library.so", 1);
  CHECK(error_of(picture).starts_with(
      "the library Open Image Denoise is not on this machine: install it, or "));

  setenv("EYERAY_OPEN_IMAGE_DENOISE", FAKE_OIDN, 1);
  setenv("FAKE_OIDN_FAILS", "1", 1);
  CHECK(error_of(picture) == "Open Image Denoise fails: out of memory");
  unsetenv("FAKE_OIDN_FAILS");

  const auto expected = [&](size_t i) {
    return 0.5f * picture.color.samples()[i] + 0.25f * picture.albedo.samples()[i] +
           0.125f * picture.normal.samples()[i];
  };
  const DenoisedPicture denoised = denoise_by_oidn(picture);
  CHECK(denoised.errors.sample_count() == 0);
  for (size_t i = 0; i < picture.color.sample_count(); ++i) CHECK(denoised.color.samples()[i] == expected(i));

  // A value that is not finite reaches no neighbour, and stays.
  picture.color.samples()[7] = std::numeric_limits<float>::infinity();
  const Image with_infinity = denoise_by_oidn(picture).color;
  for (size_t i = 0; i < with_infinity.sample_count(); ++i)
    CHECK(with_infinity.samples()[i] == (i == 7 ? picture.color.samples()[i] : expected(i)));
}

TEST_CASE("an alpha goes through the library, and stays exact beside no edge") {
  setenv("EYERAY_OPEN_IMAGE_DENOISE", FAKE_OIDN, 1);
  NoisyPicture picture = small_picture();
  picture.coverage = Image(5, 4, 1);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) *picture.coverage.pixel(x, y) = x < 2 ? 0.0f : x == 2 ? 0.5f : 1.0f;
  const Image denoised = denoise_by_oidn(picture).color;
  REQUIRE(denoised.channels() == 4);
  for (int x = 0; x < 5; ++x) {
    CHECK(denoised.pixel(x, 1)[3] == *picture.coverage.pixel(x, 1));
    // Pixels that nothing covers keep their colour.
    CHECK((denoised.pixel(x, 1)[0] == picture.color.pixel(x, 1)[0]) == (x == 0));
  }
}
