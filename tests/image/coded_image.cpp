#include "host/image/coded_image.hpp"
#include "host/image/exif.hpp"

#include <cmath>
#include <cstring>

#include "host/core/atomic_file.hpp"
#include "host/core/error.hpp"
#include "host/core/peak_memory.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using test::Random;

namespace {

using Pixel = std::array<uint8_t, 4>;

std::string bytes_of(const std::string& file) {
  return read_file("tests/image/pictures/" + file);
}

CodedImage decode(const std::string& bytes, std::vector<std::string>& warnings) {
  PixelBudget budget;
  return decode_coded_image(std::as_bytes(std::span(bytes)), "a picture", budget, warnings);
}

CodedImage decode(const std::string& bytes) {
  std::vector<std::string> warnings;
  return decode(bytes, warnings);
}

// The error for bytes that are no picture.
std::string refusal(const std::string& bytes) {
  try {
    decode(bytes);
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::file_io);
    return error.what();
  }
  return "accepted";
}

// A PNG of one grey channel whose header states `width` and `height`, which are not those of the data.
std::string png_with_size(uint32_t width, uint32_t height) {
  std::string bytes = bytes_of("grey.png");
  for (int i = 0; i < 4; ++i) {
    bytes[size_t(16 + i)] = char(width >> (24 - 8 * i));
    bytes[size_t(20 + i)] = char(height >> (24 - 8 * i));
  }
  return bytes;
}

}  // namespace

TEST_CASE("PNG of every kind decodes to the right codes, from the top left") {
  const Pixel colors[] = {{255, 0, 0, 255}, {0, 255, 0, 255},     {0, 0, 255, 255},
                          {0, 0, 0, 255},   {255, 255, 255, 255}, {64, 128, 192, 255}};
  for (const char* file : {"rgb.png", "palette.png", "rgb16.png", "rgba_interlaced.png"}) {
    CAPTURE(file);
    const CodedImage image = decode(bytes_of(file));
    REQUIRE(image.width == 3);
    REQUIRE(image.height == 2);
    REQUIRE(image.pixels.size() == 6);
    const uint8_t alpha = file == std::string("rgba_interlaced.png") ? 64 : 255;
    for (size_t i = 0; i < 6; ++i)
      CHECK(image.pixels[i] == Pixel{colors[i][0], colors[i][1], colors[i][2], alpha});
  }
  const CodedImage grey = decode(bytes_of("grey.png"));
  REQUIRE(grey.pixels.size() == 6);
  for (size_t i = 0; i < 6; ++i) {
    const uint8_t code = std::array<uint8_t, 6>{0, 64, 128, 192, 254, 255}[i];
    CHECK(grey.pixels[i] == Pixel{code, code, code, 255});
  }
}

TEST_CASE("WebP decodes to the right codes, lossless, with alpha and lossy") {
  const CodedImage wanted = decode(bytes_of("rgba_interlaced.png"));
  for (const auto& [file, alpha] : {std::pair("rgb.webp", uint8_t(255)), {"rgba.webp", uint8_t(64)}}) {
    const CodedImage image = decode(bytes_of(file));
    REQUIRE(image.width == 3);
    REQUIRE(image.pixels.size() == wanted.pixels.size());
    for (size_t i = 0; i < wanted.pixels.size(); ++i) {
      Pixel pixel = wanted.pixels[i];
      pixel[3] = alpha;
      CHECK(image.pixels[i] == pixel);
    }
  }
  // Red grows to the right and green downwards, by 16 a pixel.
  std::vector<std::string> warnings;
  const CodedImage lossy = decode(bytes_of("lossy.webp"), warnings);
  REQUIRE(lossy.pixels.size() == 256);
  for (size_t i = 0; i < 256; ++i) {
    CHECK(std::abs(lossy.pixels[i][0] - int(16 * (i % 16))) < 24);
    CHECK(std::abs(lossy.pixels[i][1] - int(16 * (i / 16))) < 24);
    CHECK(lossy.pixels[i][3] == 255);
  }
  CHECK(warnings.empty());
  decode(bytes_of("profile.webp"), warnings);
  CHECK(warnings == std::vector<std::string>{
                        "a picture: its colour profile (ICCP) is ignored: its colours are read as sRGB"});
}

TEST_CASE("a WebP that is damaged, or an animation, is refused; its size counts before it is decoded") {
  CHECK(refusal(bytes_of("animated.webp")) ==
        "cannot read a picture: it is damaged (it is an animation, of which no frame is chosen)");
  for (const char* file : {"rgba.webp", "lossy.webp"}) {
    const std::string whole = bytes_of(file);
    for (size_t length = 0; length + 2 < whole.size(); ++length)
      CHECK(refusal(whole.substr(0, length)) != "accepted");
  }
  // A picture of one colour may be short, but not if its header states the most pixels that there can be.
  std::string plain = read_file("tests/fuzz/corpus/image/plain.webp");
  CHECK(decode(plain).pixels.size() == size_t{1} << 24);
  CHECK(decode(plain).pixels[77] == Pixel{0x33, 0x66, 0x99, 255});
  std::memcpy(&plain[21], "\xff\xff\xff\x0f", 4);
  CHECK(refusal(plain) == "cannot read a picture: it ends early");
  std::vector<std::string> warnings;
  PixelBudget few{5};
  const std::string bytes = bytes_of("rgb.webp");
  CHECK_THROWS_AS(decode_coded_image(std::as_bytes(std::span(bytes)), "a picture", few, warnings),
                  TooManyPixels);
}

TEST_CASE("a PNG may have two bits a pixel and a transparent grey") {
  const CodedImage image = decode(bytes_of("grey2_transparent.png"));
  REQUIRE(image.pixels.size() == 10);
  for (size_t i = 0; i < 10; ++i) {
    const uint8_t code = std::array<uint8_t, 10>{0, 1, 2, 3, 0, 3, 2, 1, 0, 3}[i];
    const auto grey = uint8_t(85 * code);
    CHECK(image.pixels[i] == Pixel{grey, grey, grey, uint8_t(code == 1 ? 0 : 255)});
  }
}

TEST_CASE("a PNG takes little more memory than its pixels, and only within the remaining budget") {
  const std::string bytes = bytes_of("one_bit_4096.png");
  CHECK(bytes.size() < 11'000);
  const uint64_t before = peak_memory();
  const CodedImage image = decode(bytes);
  CHECK(peak_memory() - before < (uint64_t{80} << 20));  // its pixels are 64 MiB
  CHECK(image.pixels[2047] == Pixel{0, 0, 0, 255});
  CHECK(image.pixels.back() == Pixel{255, 255, 255, 255});

  PixelBudget budget{4096 * 4096 + 6};
  std::vector<std::string> warnings;
  const auto message = [&](const std::string& picture) -> std::string {
    try {
      decode_coded_image(std::as_bytes(std::span(picture)), "a picture", budget, warnings);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  CHECK(message(bytes) == "accepted");
  CHECK(message(bytes_of("rgb.png")) == "accepted");
  CHECK(
      message(bytes_of("rgb.png")) ==
      "cannot read a picture: it has 3×2 pixels; of the 2^28 that all images of a scene may have together, 0 "
      "are left");
}

TEST_CASE("JPEG, baseline, progressive and grey, decodes to the right codes, within the format's losses") {
  for (const char* file : {"baseline.jpg", "progressive.jpg"}) {
    CAPTURE(file);
    const CodedImage image = decode(bytes_of(file));
    CHECK(image.width == 16);
    CHECK(image.height == 8);
    REQUIRE(image.pixels.size() == 128);
    for (const Pixel& pixel : image.pixels) {
      CHECK(std::abs(pixel[0] - 200) <= 2);
      CHECK(std::abs(pixel[1] - 100) <= 2);
      CHECK(std::abs(pixel[2] - 50) <= 2);
      CHECK(pixel[3] == 255);
    }
  }
  // A ramp from 0 at the left to 240 at the right.
  const CodedImage grey = decode(bytes_of("grey.jpg"));
  REQUIRE(grey.pixels.size() == 256);
  for (int i = 0; i < 256; ++i) {
    const Pixel& pixel = grey.pixels[size_t(i)];
    CHECK(std::abs(pixel[0] - i % 16 * 16) <= 4);
    CHECK(pixel[0] == pixel[2]);
  }
}

TEST_CASE("a JPEG is rotated according to its EXIF orientation") {
  // The stored picture is 3 × 2: 0 1 2 / 3 4 5. Row by row, as a viewer sees it (Exif 2.3, figure of tag
  // 0x0112).
  const std::string seen[8] = {"012345", "210543", "543210", "345012",
                               "031425", "304152", "524130", "251403"};
  image::CodedImage stored{3, 2, {}};
  for (uint8_t i = 0; i < 6; ++i) stored.pixels.push_back({i, 0, 0, 255});
  for (int orientation = 1; orientation <= 8; ++orientation) {
    CAPTURE(orientation);
    const image::CodedImage turned = image::upright(stored, orientation);
    CHECK(turned.width == (orientation < 5 ? 3 : 2));
    std::string codes;
    for (const auto& pixel : turned.pixels) codes += char('0' + pixel[0]);
    CHECK(codes == seen[orientation - 1]);

    for (const bool little : {true, false}) {
      const char number = char(orientation);
      const std::string tiff =
          little ? std::string("II*\0\x8\0\0\0\1\0\x12\1\3\0\1\0\0\0", 18) + number + std::string(7, '\0')
                 : std::string("MM\0*\0\0\0\x8\0\1\1\x12\0\3\0\0\0\1\0", 19) + number + std::string(6, '\0');
      const std::string jpeg = std::string("\xff\xd8\xff\xe1\0", 5) + char(2 + 6 + tiff.size()) +
                               std::string("Exif\0\0", 6) + tiff + "\xff\xda";
      const auto bytes = std::as_bytes(std::span(jpeg));
      CHECK(image::exif_orientation(bytes) == orientation);
      for (size_t size = 0; size < jpeg.size(); ++size) {
        const int cut = image::exif_orientation(bytes.first(size));
        CHECK((cut == 1 || cut == orientation));
      }
    }
  }
}

TEST_CASE("pictures that end early are refused, wherever they end") {
  for (const char* file : {"rgb.png", "palette.png", "rgb16.png", "rgba_interlaced.png", "grey.png",
                           "baseline.jpg", "progressive.jpg", "grey.jpg"}) {
    const std::string whole = bytes_of(file);
    // The last four bytes of a PNG are a checksum, which decoders do not check.
    const size_t longest = whole.starts_with("\x89PNG") ? whole.size() - 5 : whole.size() - 1;
    for (size_t length = 0; length <= longest; ++length) {
      CAPTURE(file);
      CAPTURE(length);
      REQUIRE(refusal(whole.substr(0, length)).starts_with("cannot read a picture: it "));
    }
    CHECK(refusal(whole + "and more") == "accepted");
  }
}

TEST_CASE("a header that claims more than its file can hold takes no memory") {
  CHECK(refusal(png_with_size(3, 2)) == "accepted");
  CHECK(refusal(png_with_size(16384, 16384)) == "cannot read a picture: it ends early");
  CHECK(refusal(png_with_size(16385, 1)) ==
        "cannot read a picture: it has 16385×1 pixels; the most is 16384 a side");
  CHECK(refusal(png_with_size(1, 0x7fffff)).find("the most is 16384 a side") != std::string::npos);
  for (const uint32_t size : {0u, 0x80000000u, 0xffffffffu}) {
    CAPTURE(size);
    CHECK(refusal(png_with_size(size, 1)).starts_with("cannot read a picture: it "));
  }

  // A JPEG's size stands nine bytes behind the start of its frame header: marker, length, precision, height,
  // width.
  std::string jpeg = bytes_of("grey.jpg");
  const size_t frame = jpeg.find("\xff\xc0");
  REQUIRE(frame != std::string::npos);
  jpeg.replace(frame + 5, 4, "\x40\x00\x40\x00", 4);
  CHECK(refusal(jpeg) == "cannot read a picture: it ends early");
  // A JPEG of 3000 pixels a byte has fewer bits than its blocks need.
  const auto side = static_cast<int>(std::sqrt(3000.0 * double(jpeg.size())));
  for (const size_t at : {5, 7}) {
    jpeg[frame + at] = char(side >> 8);
    jpeg[frame + at + 1] = char(side);
  }
  CHECK(refusal(jpeg) == "cannot read a picture: it ends early");
  jpeg.replace(frame + 5, 4, "\xff\xff\xff\xff", 4);
  CHECK(refusal(jpeg) == "cannot read a picture: it has 65535×65535 pixels; the most is 16384 a side");
}

TEST_CASE("pictures with damaged bytes are decoded or refused") {
  Random random(5);
  int decoded = 0, refused = 0;
  for (const char* file :
       {"palette.png", "rgba_interlaced.png", "baseline.jpg", "progressive.jpg", "grey.jpg"}) {
    const std::string whole = bytes_of(file);
    for (int round = 0; round < 1000; ++round) {
      std::string bytes = whole;
      for (int change = 0, changes = 1 + random.below(4); change < changes; ++change)
        bytes[size_t(3 + random.below(int(whole.size()) - 3))] = char(random.bits());
      const std::string message = refusal(bytes);
      ++(message == "accepted" ? decoded : refused);
      REQUIRE((message == "accepted" || message.starts_with("cannot read a picture: it ")));
    }
  }
  CHECK(decoded > 100);
  CHECK(refused > 100);
}

TEST_CASE("a file that is no PNG, JPEG, BMP or TGA is refused, though stb_image could read it") {
  for (const std::string& bytes : {std::string(), std::string("GIF89a"), std::string("P6 1 1 255\nabc"),
                                   std::string("BM"), std::string("#?RADIANCE\n"), std::string(1000, '\0')})
    CHECK(refusal(bytes) == "cannot read a picture: it is not a PNG, JPEG, WebP, TIFF, BMP or TGA");
}
