// Fields that define the meaning of a picture's codes: eyeray warns of each that it does not honour.
#include "host/image/color_fields.hpp"
#include <fstream>

#include "host/core/atomic_file.hpp"
#include "host/image/coded_image.hpp"
#include "host/image/image_file.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;

namespace {

std::string big(uint32_t value, int size = 4) {
  std::string bytes;
  for (int i = size; i-- > 0;) bytes += char(value >> (8 * i));
  return bytes;
}

std::string test_picture(const std::string& file) {
  return read_file("tests/image/pictures/" + file);
}

// A PNG with these chunks before its pixels; checksums are not checked.
std::string png_with(const std::vector<std::pair<std::string, std::string>>& chunks) {
  constexpr size_t after_header = 8 + 25;
  std::string bytes = test_picture("rgb.png"), added;
  for (const auto& [name, content] : chunks) added += big(uint32_t(content.size())) + name + content + big(0);
  return bytes.insert(after_header, added);
}

std::vector<std::string> warnings_of(const std::string& bytes) {
  PixelBudget budget;
  std::vector<std::string> warnings;
  decode_coded_image(std::as_bytes(std::span(bytes)), "a", budget, warnings);
  return warnings;
}

std::string message_of_png(const std::vector<std::pair<std::string, std::string>>& chunks) {
  const std::vector<std::string> warnings = warnings_of(png_with(chunks));
  REQUIRE(warnings.size() <= 1);
  return warnings.empty() ? "" : warnings[0];
}

std::string primaries(uint32_t red_x) {
  std::string chunk;
  for (const uint32_t value : {31270u, 32900u, red_x, 33000u, 30000u, 60000u, 15000u, 6000u})
    chunk += big(value);
  return chunk;
}

// An iCCP chunk whose profile is one stored block of zlib.
std::string profile(const std::string& name, const std::string& content) {
  const auto size = uint32_t(content.size());
  const auto little = [](uint32_t value) { return std::string{char(value), char(value >> 8)}; };
  return name + std::string(2, '\0') + "\x78\x01\x01" + little(size) + little(~size) + content;
}

std::string jpeg_with(uint8_t marker, const std::string& content) {
  std::string bytes = test_picture("baseline.jpg");
  return bytes.insert(2, std::string{'\xff', char(marker)} + big(uint32_t(content.size() + 2), 2) + content);
}

}  // namespace

TEST_CASE("PNG: the first one present of cICP, iCCP, sRGB, gAMA and cHRM counts") {
  const std::string not_srgb = " is ignored: its colours are read as sRGB";
  CHECK(message_of_png({}) == "");
  CHECK(message_of_png({{"gAMA", big(45455)}, {"cHRM", primaries(64000)}}) == "");
  CHECK(message_of_png({{"gAMA", big(100000)}}) == "a: its gamma (gAMA) of 1" + not_srgb);
  CHECK(message_of_png({{"gAMA", big(55556)}}) == "a: its gamma (gAMA) of 0.5556" + not_srgb);
  CHECK(message_of_png({{"cHRM", primaries(68000)}}) == "a: its primaries (cHRM)" + not_srgb);
  CHECK(message_of_png({{"sRGB", "\1"}, {"gAMA", big(100000)}}) == "");
  CHECK(message_of_png({{"iCCP", profile("Display P3", "desc P3")}}) ==
        "a: its colour profile (iCCP)" + not_srgb);
  CHECK(message_of_png({{"iCCP", profile("ICC Profile", "desc sRGB IEC61966-2.1")}}) == "");
  CHECK(message_of_png({{"iCCP", profile("sRGB", "desc")}, {"gAMA", big(100000)}}) == "");
  CHECK(message_of_png({{"iCCP", profile("ICC Profile", std::string("mluc s\0R\0G\0B", 12))}}) == "");
  CHECK(message_of_png({{"cICP", std::string("\1\15\0\1", 4)}, {"gAMA", big(100000)}}) == "");
  CHECK(message_of_png({{"cICP", std::string("\11\20\0\1", 4)}, {"sRGB", "\1"}}) ==
        "a: its colour space (cICP 9, 16)" + not_srgb);
}

TEST_CASE("PNG: non-square pixels and an orientation cause warnings") {
  CHECK(message_of_png({{"pHYs", big(2835) + big(2835) + "\1"}}) == "");
  CHECK(message_of_png({{"pHYs", big(1) + big(2) + std::string(1, '\0')}}) ==
        "a: its pixels are not square (pHYs), which is ignored");
  const auto oriented = [](char orientation) {
    return "MM" + big(42, 2) + big(8) + big(1, 2) + big(0x0112, 2) + big(3, 2) + big(1) +
           std::string{'\0', orientation, '\0', '\0'};
  };
  CHECK(message_of_png({{"eXIf", oriented(1)}}) == "");
  CHECK(message_of_png({{"eXIf", oriented(6)}}) == "a: its EXIF orientation (eXIf) of 6 is ignored");
}

TEST_CASE("JPEG: other colour profiles and non-square densities cause warnings") {
  const std::string icc = std::string("ICC_PROFILE\0\1\1", 14);
  CHECK(warnings_of(jpeg_with(0xe2, icc + "desc sRGB IEC61966-2.1")).empty());
  CHECK(warnings_of(jpeg_with(0xe2, icc + "desc Adobe RGB (1998)")) ==
        std::vector<std::string>{"a: its colour profile is ignored: its colours are read as sRGB"});
  const auto density = [](uint32_t across, uint32_t down) {
    return std::string("JFIF\0\1\2\1", 8) + big(across, 2) + big(down, 2) + std::string(2, '\0');
  };
  CHECK(warnings_of(jpeg_with(0xe0, density(72, 72))).empty());
  CHECK(warnings_of(jpeg_with(0xe0, density(72, 144))).size() == 1);
}

TEST_CASE("compared pictures cause the same warnings, and damaged fields do no harm") {
  const test::TemporaryFolder folder;
  const std::string file = folder / "a.png";
  std::ofstream(file) << png_with({{"gAMA", big(100000)}});
  std::vector<std::string> warnings;
  read_image(file, "", warnings);
  CHECK(warnings.size() == 1);
  const std::string whole = png_with({{"iCCP", profile("P3", "desc P3")}});
  for (size_t size = 0; size < whole.size(); ++size)
    CHECK(png_color_fields(whole.substr(0, size)).size() <= 1);
  const std::string jpeg = jpeg_with(0xe2, std::string("ICC_PROFILE\0", 12));
  for (size_t size = 0; size < jpeg.size(); ++size) CHECK(jpeg_color_fields(jpeg.substr(0, size)).empty());
}
