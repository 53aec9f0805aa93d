// Uncompressed TIFF of every kind, made here byte by byte from the same six pixels.
#include <tiffio.h>

#include <cmath>
#include <map>

#include "decode_tiff.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/peak_memory.hpp"
#include "host/image/coded_image.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using test::Colors;
using test::decode_tiff;
using test::Decoded;

namespace {

// Three columns and two rows, the top row first.
const Colors tiff_colors = {{255, 0, 0, 255},  {0, 255, 0, 255},     {0, 0, 255, 255},
                            {10, 20, 30, 255}, {255, 255, 255, 255}, {64, 128, 192, 255}};
constexpr uint32_t tiff_columns = 3, tiff_rows = 2;

// A TIFF of one page, in either order of bytes. `data` lies behind the header, at `data_at`.
struct TiffMaker {
  bool big = false;
  std::string data = {};
  std::map<uint16_t, std::vector<uint32_t>> fields = {};  // by tag; values are SHORT or LONG

  static constexpr uint32_t data_at = 8;

  std::string number(uint64_t value, int size) const {
    std::string bytes;
    for (int i = 0; i < size; ++i) bytes += char(value >> (8 * (big ? size - 1 - i : i)));
    return bytes;
  }

  std::string bytes() const {
    std::string file = (big ? std::string("MM\0*", 4) : std::string("II*\0", 4));
    std::string lists, entries;
    const auto start = uint32_t(data_at + data.size() + data.size() % 2);
    for (const auto& [tag, values] : fields) {
      // Offsets and sizes of strips and tiles are LONG.
      const bool is_long = tag == 273 || tag == 279 || tag == 324 || tag == 325 || tag == 256 || tag == 257;
      const int size = is_long ? 4 : 2;
      std::string written;
      for (const uint32_t value : values) written += number(value, size);
      entries += number(tag, 2) + number(is_long ? 4 : 3, 2) + number(values.size(), 4);
      if (written.size() <= 4) {
        entries += written + std::string(4 - written.size(), '\0');
      } else {
        entries += number(start + lists.size(), 4);
        lists += written;
      }
    }
    file += number(start + lists.size(), 4) + data + std::string(data.size() % 2, '\0') + lists;
    return file + number(fields.size(), 2) + entries + number(0, 4);
  }
};

// The fields of an uncompressed picture in one strip.
TiffMaker tiff_of(const std::string& data, std::vector<uint32_t> bits, uint32_t photometric,
                  bool big = false) {
  TiffMaker maker{big, data};
  maker.fields = {{256, {tiff_columns}},
                  {257, {tiff_rows}},
                  {258, bits},
                  {259, {1}},
                  {262, {photometric}},
                  {273, {TiffMaker::data_at}},
                  {277, {uint32_t(bits.size())}},
                  {278, {tiff_rows}},
                  {279, {uint32_t(data.size())}}};
  return maker;
}

std::string rgb_bytes() {
  std::string data;
  for (const auto& pixel : tiff_colors)
    for (size_t i = 0; i < 3; ++i) data += char(pixel[i]);
  return data;
}

void check_tiff(const TiffMaker& maker, const Colors& wanted = tiff_colors) {
  const Decoded found = decode_tiff(maker.bytes());
  CHECK(found.refused == "");
  CHECK(found.warnings == std::vector<std::string>{});
  CHECK(found.pixels == wanted);
}

Colors grey_colors(const std::vector<uint8_t>& codes) {
  Colors all;
  for (const uint8_t code : codes) all.push_back({code, code, code, 255});
  return all;
}

}  // namespace

TEST_CASE("TIFF: RGB of 8 and 16 bits, in both orders of bytes, in strips, tiles and planes") {
  for (const bool big : {false, true}) {
    CAPTURE(big);
    const TiffMaker plain = tiff_of(rgb_bytes(), {8, 8, 8}, 2, big);
    check_tiff(plain);

    // The upper 8 bits of 16 are kept.
    TiffMaker deep = tiff_of("", {16, 16, 16}, 2, big);
    for (const char code : rgb_bytes()) deep.data += deep.number(uint64_t(uint8_t(code)) << 8 | 0x7f, 2);
    deep.fields[279] = {uint32_t(deep.data.size())};
    check_tiff(deep);

    TiffMaker strips = plain;
    strips.fields[278] = {1};
    strips.fields[273] = {TiffMaker::data_at, TiffMaker::data_at + 9};
    strips.fields[279] = {9, 9};
    check_tiff(strips);

    TiffMaker planes = plain;
    planes.data.clear();
    for (size_t i = 0; i < 3; ++i)
      for (const auto& pixel : tiff_colors) planes.data += char(pixel[i]);
    planes.fields[284] = {2};
    planes.fields[273] = {TiffMaker::data_at, TiffMaker::data_at + 6, TiffMaker::data_at + 12};
    planes.fields[279] = {6, 6, 6};
    check_tiff(planes);
  }
}

TEST_CASE("TIFF: tiles may reach beyond the picture") {
  // 20 × 18 pixels in tiles of 16 × 16. Red is the column, green the row.
  TiffMaker maker = tiff_of("", {8, 8, 8}, 2);
  std::vector<uint32_t> offsets, lengths;
  for (int top = 0; top < 18; top += 16)
    for (int left = 0; left < 20; left += 16) {
      offsets.push_back(uint32_t(TiffMaker::data_at + maker.data.size()));
      lengths.push_back(16 * 16 * 3);
      for (int y = top; y < top + 16; ++y)
        for (int x = left; x < left + 16; ++x) maker.data += {char(x), char(y), 7};
    }
  for (const int tag : {273, 278, 279}) maker.fields.erase(uint16_t(tag));
  maker.fields[256] = {20};
  maker.fields[257] = {18};
  maker.fields[322] = maker.fields[323] = {16};
  maker.fields[324] = offsets;
  maker.fields[325] = lengths;
  const Decoded found = decode_tiff(maker.bytes());
  CHECK(found.refused == "");
  REQUIRE(found.pixels.size() == 360);
  for (size_t i = 0; i < 360; ++i)
    CHECK(found.pixels[i] == std::array<uint8_t, 4>{uint8_t(i % 20), uint8_t(i / 20), 7, 255});

  // A tile that would take too much memory is refused.
  maker.fields[322] = maker.fields[323] = {16384};
  CHECK(decode_tiff(maker.bytes()).refused ==
        "cannot read a: a row or a tile of it has 805306368 bytes; the most is 67108864 (64 MiB)");
}

TEST_CASE("TIFF: grey of 1, 2, 4, 8 and 16 bits, and grey whose 0 is white") {
  // Rows begin at whole bytes.
  check_tiff(tiff_of("\xa0\x40", {1}, 1), grey_colors({255, 0, 255, 0, 255, 0}));
  check_tiff(tiff_of("\xa0\x40", {1}, 0), grey_colors({0, 255, 0, 255, 0, 255}));
  check_tiff(tiff_of("\x1b\xe4", {2}, 1), grey_colors({0, 85, 170, 255, 170, 85}));
  check_tiff(tiff_of(std::string("\x0f\x10\x23\x40", 4), {4}, 1), grey_colors({0, 255, 17, 34, 51, 68}));
  check_tiff(tiff_of(std::string("\0\x40\x80\xc0\xfe\xff", 6), {8}, 1),
             grey_colors({0, 64, 128, 192, 254, 255}));
  check_tiff(tiff_of(std::string("\0\x40\x80\xc0\xfe\xff", 6), {8}, 0),
             grey_colors({255, 191, 127, 63, 1, 0}));
  check_tiff(tiff_of(std::string("\xff\0\xff\x40\xff\x80\xff\xc0\xff\xfe\xff\xff", 12), {16}, 1),
             grey_colors({0, 64, 128, 192, 254, 255}));
}

TEST_CASE("TIFF: palettes of 4 and 8 bits, also with 8 bits a colour") {
  for (const uint32_t bits : {4u, 8u})
    for (const bool in_8_bits : {false, true}) {
      TiffMaker maker = tiff_of(bits == 4 ? "\x01\x20\x34\x50" : std::string("\0\1\2\3\4\5", 6), {bits}, 3);
      std::vector<uint32_t>& map = maker.fields[320];
      for (size_t i = 0; i < 3; ++i)
        for (size_t k = 0; k < size_t{1} << bits; ++k)
          map.push_back(k < 6 ? uint32_t(tiff_colors[k][i]) * (in_8_bits ? 1 : 257) : 0);
      check_tiff(maker);
    }
  const TiffMaker none = tiff_of("\x01\x20\x34\x50", {4}, 3);
  CHECK(decode_tiff(none.bytes()).refused.starts_with("cannot read a: it is damaged ("));
}

TEST_CASE("TIFF: alpha is kept, and colours multiplied by it are divided; other channels get a warning") {
  const auto with_extra = [](uint32_t kind, uint8_t extra, double share) {
    TiffMaker maker = tiff_of("", {8, 8, 8, 8}, 2);
    for (const auto& pixel : tiff_colors) {
      for (size_t i = 0; i < 3; ++i) maker.data += char(std::lround(pixel[i] * share));
      maker.data += char(extra);
    }
    maker.fields[338] = {kind};
    maker.fields[279] = {uint32_t(maker.data.size())};
    return maker;
  };
  Colors wanted = tiff_colors;
  for (auto& pixel : wanted) pixel[3] = 51;
  check_tiff(with_extra(2, 51, 1), wanted);
  // A code of 20 becomes 4 in the file, and 20 again. One of 64 becomes 13, and 65.
  const Decoded divided = decode_tiff(with_extra(1, 51, 0.2).bytes());
  CHECK(divided.warnings.empty());
  REQUIRE(divided.pixels.size() == 6);
  CHECK(divided.pixels[3] == std::array<uint8_t, 4>{10, 20, 30, 51});
  CHECK(divided.pixels[5][0] == 65);
  // Without alpha there is no colour to divide.
  CHECK(decode_tiff(with_extra(1, 0, 0).bytes()).pixels[0] == std::array<uint8_t, 4>{0, 0, 0, 0});

  const Decoded other = decode_tiff(with_extra(0, 51, 1).bytes());
  CHECK(other.pixels == tiff_colors);
  CHECK(other.warnings ==
        std::vector<std::string>{"a: 1 of its channels are neither colours nor alpha, and were left out"});
}

TEST_CASE("TIFF: CMYK") {
  TiffMaker maker = tiff_of("", {8, 8, 8, 8}, 5);
  for (const auto& pixel : tiff_colors) {
    for (size_t i = 0; i < 3; ++i) maker.data += char(255 - pixel[i]);
    maker.data += '\0';
  }
  maker.fields[279] = {uint32_t(maker.data.size())};
  check_tiff(maker);
  // The last pixel with black of 60 %.
  maker.data.back() = char(153);
  CHECK(decode_tiff(maker.bytes()).pixels[5] == std::array<uint8_t, 4>{26, 51, 77, 255});
}

TEST_CASE("TIFF: orientation turns the picture; resolutions, profiles and pages get a warning") {
  TiffMaker maker = tiff_of(rgb_bytes(), {8, 8, 8}, 2);
  maker.fields[274] = {6};  // the first row is at the right
  const Decoded turned = decode_tiff(maker.bytes());
  CHECK(turned.width == 2);
  CHECK(turned.height == 3);
  CHECK(turned.pixels == Colors{tiff_colors[3], tiff_colors[0], tiff_colors[4], tiff_colors[1],
                                tiff_colors[5], tiff_colors[2]});

  const test::TemporaryFolder folder;
  const std::string name = folder / "pages.tif";
  TIFF* tiff = TIFFOpen(name.c_str(), "w");
  REQUIRE(tiff);
  const std::string pixels = rgb_bytes();
  for (int page = 0; page < 2; ++page) {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, tiff_columns);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, tiff_rows);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 3);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_XRESOLUTION, 72.0);
    TIFFSetField(tiff, TIFFTAG_YRESOLUTION, 36.0);
    TIFFSetField(tiff, TIFFTAG_ICCPROFILE, 10, "Adobe RGB ");
    for (uint32_t y = 0; y < tiff_rows; ++y)
      TIFFWriteScanline(tiff, const_cast<char*>(pixels.data() + y * 9), y);
    TIFFWriteDirectory(tiff);
  }
  TIFFClose(tiff);
  const Decoded pages = decode_tiff(read_file(name));
  CHECK(pages.pixels == tiff_colors);
  CHECK(pages.warnings ==
        std::vector<std::string>{"a: its colour profile is ignored: its colours are read as sRGB",
                                 "a: its pixels are not square (its resolutions differ), which is ignored",
                                 "a: only the first of its pages is read"});
}

TEST_CASE("TIFF of other kinds is refused with the reason") {
  const auto refused = [](uint16_t tag, std::vector<uint32_t> value) {
    TiffMaker maker = tiff_of(rgb_bytes() + std::string(100, '\0'), {8, 8, 8}, 2);
    maker.fields[tag] = std::move(value);
    return decode_tiff(maker.bytes()).refused;
  };
  CHECK(refused(259, {6}) ==
        "cannot read a: its compression, 6 by TIFF's numbers, is not read: save it with LZW or Deflate");
  CHECK(
      refused(339, {3, 3, 3}) ==
      "cannot read a: its samples are floating-point or signed numbers: save it with 8 or 16 bits a channel");
  CHECK(refused(258, {32, 32, 32}) == "cannot read a: it has 32 bits a channel: save it with 8 or 16");
  CHECK(refused(262, {8}) == "cannot read a: its colours are CIE L*a*b*: save it as RGB");
  CHECK(refused(262, {6}) == "cannot read a: its colours are YCbCr without JPEG: save it as RGB");
  CHECK(refused(262, {77}) == "cannot read a: its colours are of an unknown kind: save it as RGB");
  CHECK(refused(262, {5}) == "cannot read a: it is damaged (it has 3 channels and needs 4)");
  CHECK(refused(256, {16385}) == "cannot read a: it has 16385×2 pixels; the most is 16384 a side");
  CHECK(refused(257, {0}).starts_with("cannot read a: it "));
}

TEST_CASE("a TIFF that claims more pixels than its file can hold takes no memory") {
  TiffMaker maker = tiff_of("\xa0\x40", {1}, 1);
  maker.fields[256] = maker.fields[257] = {16384};
  const uint64_t before = peak_memory();
  CHECK(decode_tiff(maker.bytes()).refused == "cannot read a: it ends early");
  CHECK(peak_memory() - before < (uint64_t{20} << 20));
}
