#include "host/image/image_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "host/image/pfm_file.hpp"
#include "host/image/srgb.hpp"
#include "tests/support/process.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using eyeray::engine::test::Random;
using eyeray::engine::test::TemporaryFolder;
using eyeray::engine::test::write_text;

namespace {

Image random_image(int width, int height, int channels, double high) {
  Random random(uint64_t(width * 1000 + height * 10 + channels));
  Image image(width, height, channels);
  for (float& sample : image.samples()) sample = float(random.uniform(0, high));
  return image;
}

bool same_bits(const Image& a, const Image& b) {
  if (!a.same_size(b)) return false;
  for (size_t i = 0; i < a.sample_count(); ++i) {
    if (std::bit_cast<uint32_t>(a.samples()[i]) != std::bit_cast<uint32_t>(b.samples()[i])) return false;
  }
  return true;
}

bool unreadable(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  write_text(folder / name, bytes);
  try {
    read_image(folder / name);
    return false;
  } catch (const Error& error) {
    return error.code() == ExitCode::file_io && std::string(error.what()).find(name) != std::string::npos;
  }
}

}  // namespace

TEST_CASE("srgb8 follows IEC 61966-2-1, rounded half up") {
  // Values of the standard's formula, worked out by hand.
  CHECK(int(srgb8(0.0f)) == 0);
  CHECK(int(srgb8(1.0f)) == 255);
  CHECK(int(srgb8(0.5f)) == 188);
  CHECK(int(srgb8(0.18f)) == 118);
  CHECK(int(srgb8(0.0031308f)) == 10);
  CHECK(int(srgb8(0.001f)) == 3);
  CHECK(int(srgb8(0.2140411f)) == 127);
  CHECK(int(srgb8(0.2158605f)) == 128);

  // Values outside [0, 1] are clipped, and a NaN becomes 0.
  CHECK(int(srgb8(-1.0f)) == 0);
  CHECK(int(srgb8(7.0f)) == 255);
  CHECK(int(srgb8(std::numeric_limits<float>::infinity())) == 255);
  CHECK(int(srgb8(std::numeric_limits<float>::quiet_NaN())) == 0);

  // The code is always the rounded result of the formula, except within one float of a boundary.
  Random random(1);
  for (int i = 0; i < 1'000'000; ++i) {
    const double linear = double(float(random.uniform() * random.uniform()));
    const double exact = 255 * srgb_from_linear(linear);
    if (std::abs(exact - std::floor(exact) - 0.5) < 1e-4) continue;
    REQUIRE(int(srgb8(float(linear))) == int(std::floor(exact + 0.5)));
  }
}

TEST_CASE("the sRGB curve and its inverse undo each other, and every code comes back") {
  for (int i = 0; i <= 10000; ++i) {
    CHECK(std::abs(linear_from_srgb(srgb_from_linear(i / 10000.0)) - i / 10000.0) < 1e-7);
  }
  for (int code = 0; code < 256; ++code) CHECK(int(srgb8(float(linear_from_srgb(code / 255.0)))) == code);
}

TEST_CASE("the ending decides the format, in either case") {
  CHECK(image_format("a/b.png") == ImageFormat::png);
  CHECK(image_format("b.PFM") == ImageFormat::pfm);
  CHECK(image_format("b.c.hdr") == ImageFormat::hdr);
  CHECK(image_format("b.exr") == ImageFormat::exr);
  for (const char* name : {"b", "b.jpg", "png", ".png", "b.png/"}) {
    CHECK_THROWS_AS(image_format(name), Error);
  }
}

TEST_CASE("PFM keeps every bit, of one and three channels") {
  const TemporaryFolder folder;
  for (const int channels : {1, 3}) {
    Image image = random_image(7, 5, channels, 1e6);
    image.samples()[0] = std::numeric_limits<float>::quiet_NaN();
    image.samples()[1] = -std::numeric_limits<float>::infinity();
    image.samples()[2] = -0.0f;
    image.samples()[3] = 1e-45f;
    write_image(folder / "a.pfm", image);
    CHECK(same_bits(read_image(folder / "a.pfm"), image));
  }
}

TEST_CASE("PFM has the layout of the format: the bottom row first") {
  Image image(1, 2, 1);
  *image.pixel(0, 0) = 1.0f;  // top
  *image.pixel(0, 1) = 2.0f;
  const TemporaryFolder folder;
  write_image(folder / "a.pfm", image);
  CHECK(read_file(folder / "a.pfm") ==
        std::string("Pf\n1 2\n-1.0\n") + std::string("\x00\x00\x00\x40\x00\x00\x80\x3f", 8));

  // The other byte order, a scale, and other white space.
  const std::string swapped = std::string("Pf 1\t2 2\n") + std::string("\x40\x00\x00\x00\x3f\x80\x00\x00", 8);
  const Image read = decode_pfm(swapped, "x");
  CHECK(*read.pixel(0, 0) == 2.0f);
  CHECK(*read.pixel(0, 1) == 4.0f);
}

TEST_CASE("PNG keeps the codes, of one and three channels") {
  const TemporaryFolder folder;
  for (const int channels : {1, 3}) {
    const Image image = random_image(9, 4, channels, 1.2);
    write_image(folder / "a.png", image);
    const Image read = read_image(folder / "a.png");
    REQUIRE(read.same_size(image));
    for (size_t i = 0; i < image.sample_count(); ++i) {
      REQUIRE(int(srgb8(read.samples()[i])) == int(srgb8(image.samples()[i])));
    }
  }
}

TEST_CASE("HDR keeps eight bits of the largest channel, and nothing that it cannot hold") {
  const TemporaryFolder folder;
  // Below 8 pixels a row is stored plainly, above it in runs.
  for (const int width : {3, 40}) {
    Image image = random_image(width, 4, 3, 1000);
    for (float* p = image.pixel(0, 3); p != image.pixel(0, 3) + 3; ++p) *p = 0.25f;
    write_image(folder / "a.hdr", image);
    const Image read = read_image(folder / "a.hdr");
    REQUIRE(read.same_size(image));
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < width; ++x) {
        const float* p = image.pixel(x, y);
        const float largest = std::max({p[0], p[1], p[2]});
        for (int c = 0; c < 3; ++c) REQUIRE(std::abs(read.pixel(x, y)[c] - p[c]) <= largest / 128);
      }
    }
  }
  Image strange(1, 1, 3);
  strange.samples() = {-1.0f, std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity()};
  write_image(folder / "b.hdr", strange);
  const Image read = read_image(folder / "b.hdr");
  CHECK(read.samples()[0] == 0.0f);
  CHECK(read.samples()[1] == 0.0f);
  CHECK(read.samples()[2] > 1e37f);
}

TEST_CASE("HDR: EXPOSURE and COLORCORR are divided out, other primaries cause a warning, old runs are read") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& lines, const std::string& rows,
                        std::vector<std::string>& warnings) {
    write_file_atomically(folder / "a.hdr", "#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n" + rows);
    return read_image(folder / "a.hdr", "", warnings);
  };
  const std::string one = "-Y 1 +X 1\n\x80\x80\x80\x81";
  std::vector<std::string> warnings;
  const Image image = read("EXPOSURE=4\nEXPOSURE= 0.5\nCOLORCORR=1 2 4\n", one, warnings);
  CHECK(image.samples() == std::vector<float>{0.5f, 0.25f, 0.125f});
  read("PRIMARIES=0.64 0.33 0.29 0.6 0.15 0.06 0.3333 0.3333\nPIXASPECT=1\nVIEW= -vth\n", one, warnings);
  CHECK(warnings.empty());
  read("PRIMARIES=0.7 0.3 0.2 0.8 0.13 0.05 0.3127 0.329\nPIXASPECT=2\n", one, warnings);
  CHECK(warnings.size() == 2);
  read("GAMMA=1.0\n", one, warnings);
  CHECK(warnings.size() == 2);
  read("GAMMA=2.2\n", one, warnings);
  CHECK(warnings.size() == 3);
  for (const char* wrong : {"EXPOSURE=0\n", "EXPOSURE=-1\n", "EXPOSURE=nan\n", "EXPOSURE=1e-320\n",
                            "EXPOSURE=x\n", "COLORCORR=2 1\n"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(read(wrong, one, warnings), Error);
  }

  // 300 pixels: one, 0x28 + (1 << 8) repetitions of it, and three others.
  const Image runs = read("",
                          std::string("-Y 1 +X 300\n\x80\x80\x80\x81\1\1\1\x28\1\1\1\1", 24) +
                              "\x80\x80\x80\x82\x80\x80\x80\x83\x80\x80\x80\x84",
                          warnings);
  CHECK(*runs.pixel(296, 0) == 1);
  CHECK(*runs.pixel(297, 0) == 2);
  CHECK(*runs.pixel(299, 0) == 8);
  CHECK_THROWS_AS(read("", "-Y 1 +X 2\n\1\1\1\2", warnings), Error);
  CHECK_THROWS_AS(read("", "-Y 1 +X 2\n\x80\x80\x80\x81\1\1\1\2", warnings), Error);
}

TEST_CASE("malformed PFM files are refused") {
  const std::string pixel("\0\0\0\0", 4);
  REQUIRE_FALSE(unreadable("a.pfm", "Pf\n1 1\n-1\n" + pixel));
  for (const std::string& bytes :
       {std::string(), std::string("Pf"), "Pg\n1 1\n-1\n" + pixel, "Pf\n0 1\n-1\n" + pixel,
        "Pf\n-1 -1\n-1\n" + pixel, "Pf\n1 1\n0\n" + pixel, "Pf\n1 1\nnan\n" + pixel, "Pf\n1 1\ninf\n" + pixel,
        "Pf\n1 1x\n-1\n" + pixel, "Pf\n1 1\n-1\n" + pixel.substr(1), "Pf\n1 1\n-1\n" + pixel + "x",
        "PF\n1 1\n-1\n" + pixel, "Pf\n70000 1\n-1\n" + pixel, "Pf\n60000 60000\n-1\n" + pixel,
        "Pf\n99999999999999999999 1\n-1\n" + pixel, "Pf  \n1 1\n-1\n" + pixel}) {
    CAPTURE(bytes);
    CHECK(unreadable("a.pfm", bytes));
  }
}

TEST_CASE("malformed HDR files are refused") {
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n", pixel("\x80\x80\x80\x81", 4);
  REQUIRE_FALSE(unreadable("a.hdr", head + "-Y 1 +X 1\n" + pixel));
  const std::string row = std::string("\2\2\0\x8", 4);
  const std::string run = "\x88z";
  REQUIRE_FALSE(unreadable("a.hdr", head + "-Y 1 +X 8\n" + row + run + run + run + run));
  for (const std::string& bytes :
       {"#?RADIANCE\n\n-Y 1 +X 1\n" + pixel, head + "-Y 1 +X 1\n" + pixel + "x", head + "+Y 1 +X 1\n" + pixel,
        head + "-Y 0 +X 1\n" + pixel, head + "-Y 1 +X 1 \n" + pixel, head + "-Y 60000 +X 60000\n" + pixel,
        head + "-Y 1 +X 8\n" + row + "\x89z" + run + run + run,
        head + "-Y 1 +X 8\n" + row + std::string(1, '\0') + run + run + run + run,
        head + "-Y 16000 +X 16000\n" + pixel}) {
    CAPTURE(bytes);
    CHECK(unreadable("a.hdr", bytes));
  }
}

TEST_CASE("files of other formats are refused, and so are truncated files") {
  const TemporaryFolder folder;
  const Image image = random_image(20, 3, 3, 1);
  for (const std::string name : {"a.png", "a.hdr", "a.pfm"}) {
    write_image(folder / name, image);
    const std::string whole = read_file(folder / name);
    REQUIRE_FALSE(unreadable(name, whole));
    // The last bytes of a PNG are its empty end chunk, which decoders do not need whole.
    const size_t longest = name == "a.png" ? whole.size() - 12 : whole.size() - 1;
    for (size_t length = 0; length <= longest; ++length) {
      CAPTURE(name);
      CAPTURE(length);
      REQUIRE(unreadable(name, whole.substr(0, length)));
    }
    CHECK(unreadable(name, "GIF89a" + whole));
  }
}
