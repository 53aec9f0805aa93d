// TGA and BMP of every kind, made here byte by byte from the same six pixels.
#include "host/core/error.hpp"
#include "host/image/coded_image.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using test::Random;

namespace {

using BitmapPixel = std::array<uint8_t, 4>;

// Three columns and two rows, the top row first. Five bits a channel hold every colour exactly.
const std::vector<BitmapPixel> bitmap_colors = {{255, 0, 0, 255}, {0, 255, 0, 255},     {0, 0, 255, 255},
                                                {0, 0, 0, 255},   {255, 255, 255, 255}, {255, 0, 0, 255}};
constexpr int bitmap_columns = 3, bitmap_rows = 2;

std::string little(uint64_t value, int size) {
  std::string bytes;
  for (int i = 0; i < size; ++i) bytes += char(value >> (8 * i));
  return bytes;
}

struct Bitmap {
  std::vector<BitmapPixel> pixels;
  std::vector<std::string> warnings;
  std::string refused;
};

Bitmap decode_bitmap(const std::string& bytes) {
  Bitmap result;
  try {
    PixelBudget budget;
    const CodedImage image =
        decode_coded_image(std::as_bytes(std::span(bytes)), "a", budget, result.warnings);
    CHECK(image.width == bitmap_columns);
    CHECK(image.height == bitmap_rows);
    result.pixels = image.pixels;
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::file_io);
    result.refused = error.what();
  }
  return result;
}

void check_colors(const std::string& bytes) {
  const Bitmap found = decode_bitmap(bytes);
  CHECK(found.refused == "");
  CHECK(found.warnings.empty());
  CHECK(found.pixels == bitmap_colors);
}

// A file cut off anywhere is refused, with one sentence.
void check_cut(const std::string& bytes, size_t from = 30) {
  for (size_t size = from; size < bytes.size(); ++size) {
    CAPTURE(size);
    CHECK(decode_bitmap(bytes.substr(0, size)).refused == "cannot read a: it ends early");
  }
}

std::string bgr(const BitmapPixel& pixel, int bits) {
  if (bits > 16) return {char(pixel[2]), char(pixel[1]), char(pixel[0]), char(pixel[3])};
  return little(uint32_t(pixel[0] / 8 << 10 | pixel[1] / 8 << 5 | pixel[2] / 8 | (pixel[3] / 128) << 15), 2);
}

std::string tga_color(const BitmapPixel& pixel, int bits) {
  return bgr(pixel, bits).substr(0, size_t(bits + 7) / 8);
}

// The header of a TGA file. `descriptor` contains the order of the pixels in the file.
std::string tga_header(int type, int bits, int descriptor, int map_count = 0, int map_bits = 0,
                       int map_first = 0) {
  return std::string("\3", 1) + char(map_count > 0) + char(type) + little(uint32_t(map_first), 2) +
         little(uint32_t(map_count), 2) + char(map_bits) + little(7, 2) + little(9, 2) +
         little(bitmap_columns, 2) + little(bitmap_rows, 2) + char(bits) + char(descriptor) + "id!";
}

std::vector<BitmapPixel> in_order(int descriptor) {
  std::vector<BitmapPixel> pixels;
  for (int y = 0; y < bitmap_rows; ++y)
    for (int x = 0; x < bitmap_columns; ++x) {
      const int row = (descriptor & 32) ? y : bitmap_rows - 1 - y,
                column = (descriptor & 16) ? bitmap_columns - 1 - x : x;
      pixels.push_back(bitmap_colors[size_t(row * bitmap_columns + column)]);
    }
  return pixels;
}

// A BMP file: the file's header, a header of `size` bytes, `middle`, and the pixels.
std::string bmp(int size, int height, int bits, int compression, const std::string& rest,
                const std::string& middle, const std::string& pixels) {
  std::string header = little(uint32_t(size), 4);
  if (size == 12) {
    header +=
        little(bitmap_columns, 2) + little(uint32_t(height), 2) + little(1, 2) + little(uint32_t(bits), 2);
  } else {
    header += little(bitmap_columns, 4) + little(uint32_t(height), 4) + little(1, 2) +
              little(uint32_t(bits), 2) + little(uint32_t(compression), 4) + little(0, 4) + little(2835, 4) +
              little(2835, 4) + little(0, 8);
  }
  header += rest;
  header.resize(size_t(size));
  const auto at = uint32_t(14 + header.size() + middle.size());
  return "BM" + little(at + uint32_t(pixels.size()), 4) + little(0, 4) + little(at, 4) + header + middle +
         pixels;
}

std::string bmp_rows(int bits, bool from_top) {
  std::string pixels;
  for (int y = 0; y < bitmap_rows; ++y) {
    for (int x = 0; x < bitmap_columns; ++x)
      pixels +=
          tga_color(bitmap_colors[size_t((from_top ? y : bitmap_rows - 1 - y) * bitmap_columns + x)], bits);
    while (pixels.size() % 4 != 0) pixels += '\0';
  }
  return pixels;
}

}  // namespace

TEST_CASE("TGA, plain and in runs, 15 to 32 bits, from each corner") {
  for (const int bits : {15, 16, 24, 32})
    for (const int corner : {0, 16, 32, 48}) {
      CAPTURE(bits);
      CAPTURE(corner);
      const int descriptor = corner | (bits == 32 ? 8 : bits == 16 ? 1 : 0);
      const std::vector<BitmapPixel> pixels = in_order(corner);
      std::string plain = tga_header(2, bits, descriptor), runs = tga_header(10, bits, descriptor);
      for (const BitmapPixel& pixel : pixels) plain += tga_color(pixel, bits);
      runs += "\3";  // four pixels stored singly, then two runs of one pixel
      for (size_t i = 0; i < 4; ++i) runs += tga_color(pixels[i], bits);
      for (size_t i = 4; i < 6; ++i) runs += "\x80" + tga_color(pixels[i], bits);
      check_colors(plain);
      check_colors(runs);
      check_cut(plain);
      check_cut(runs);
    }
}

TEST_CASE("TGA with a palette, grey, and a run that is longer than a row") {
  std::string palette = tga_header(1, 8, 32, 5, 24, 2);
  for (const size_t i : {0, 1, 2, 3, 4}) palette += tga_color(bitmap_colors[i], 24);
  check_colors(palette + "\2\3\4\5\6\2");
  CHECK(decode_bitmap(palette + "\2\3\4\5\6\7").refused ==
        "cannot read a: a pixel has colour number 7, but the palette begins at 2 and has 5 colours");
  CHECK(decode_bitmap(palette + "\2\3\4\5\6\1").refused ==
        "cannot read a: a pixel has colour number 1, but the palette begins at 2 and has 5 colours");

  const Bitmap grey = decode_bitmap(tga_header(11, 8, 32) + "\x84\x40" + std::string("\0\x80", 2));
  CHECK(grey.pixels == std::vector<BitmapPixel>{{64, 64, 64, 255},
                                                {64, 64, 64, 255},
                                                {64, 64, 64, 255},
                                                {64, 64, 64, 255},
                                                {64, 64, 64, 255},
                                                {128, 128, 128, 255}});
}

TEST_CASE("TGA: alpha follows the header's fields; gamma, aspect and premultiplied colours cause warnings") {
  std::string pixels;
  for (int i = 0; i < 6; ++i) pixels += std::string("\x10\x20\x30\x40", 4);
  CHECK(decode_bitmap(tga_header(2, 32, 32 | 8) + pixels).pixels[0] == BitmapPixel{48, 32, 16, 64});
  const Bitmap undeclared = decode_bitmap(tga_header(2, 32, 32) + pixels);
  CHECK(undeclared.pixels[0] == BitmapPixel{48, 32, 16, 255});
  REQUIRE(undeclared.warnings.size() == 1);
  CHECK(undeclared.warnings[0].find("no bits of alpha") != std::string::npos);

  const auto extended = [&](int aspect, int gamma, int kind) {
    std::string bytes = tga_header(2, 32, 32 | 8) + pixels;
    const auto at = uint32_t(bytes.size());
    std::string extension(495, '\0');
    extension.replace(0, 2, little(495, 2));
    extension.replace(474, 4, little(uint32_t(aspect), 2) + little(1, 2));
    extension.replace(478, 4, little(uint32_t(gamma), 2) + little(1, 2));
    extension[494] = char(kind);
    return decode_bitmap(bytes + extension + little(at, 4) + little(0, 4) +
                         std::string("TRUEVISION-XFILE.\0", 18));
  };
  CHECK(extended(1, 1, 3).warnings.empty());
  CHECK(extended(1, 1, 3).pixels[0][3] == 64);
  CHECK(extended(1, 1, 2).pixels[0][3] == 255);
  CHECK(extended(2, 1, 3).warnings.size() == 1);
  CHECK(extended(1, 2, 3).warnings.size() == 1);
  CHECK(extended(2, 2, 4).warnings.size() == 3);
  CHECK(decode_bitmap(tga_header(2, 32, 64) + pixels).refused.find("interleaved") != std::string::npos);
}

TEST_CASE("BMP of 16 to 32 bits, with masks or without, from either end") {
  for (const int size : {12, 40, 52, 56, 108, 124})
    for (const int bits : {16, 24, 32})
      for (const bool from_top : {false, true}) {
        if (size == 12 && (from_top || bits == 16)) continue;
        CAPTURE(size);
        CAPTURE(bits);
        const std::string whole =
            bmp(size, from_top ? -bitmap_rows : bitmap_rows, bits, 0, "", "", bmp_rows(bits, from_top));
        check_colors(whole);
        check_cut(whole, 60);
      }
  const std::string masks = little(0xff, 4) + little(0xff00, 4) + little(0xff0000, 4);
  std::string pixels;
  for (int y = bitmap_rows - 1; y >= 0; --y)
    for (int x = 0; x < bitmap_columns; ++x) {
      const BitmapPixel& pixel = bitmap_colors[size_t(y * bitmap_columns + x)];
      pixels += std::string{char(pixel[0]), char(pixel[1]), char(pixel[2]), '\x40'};
    }
  check_colors(bmp(40, bitmap_rows, 32, 3, "", masks, pixels));
  check_colors(bmp(52, bitmap_rows, 32, 3, masks, "", pixels));
  CHECK(decode_bitmap(bmp(56, bitmap_rows, 32, 3, masks + little(0xff000000, 4), "", pixels)).pixels[0] ==
        BitmapPixel{255, 0, 0, 64});
}

TEST_CASE("BMP with a palette of 1, 4 or 8 bits") {
  std::string palette;
  for (const size_t i : {0, 1, 2, 3, 4}) palette += bgr(bitmap_colors[i], 32);
  const auto with_colors = [&](int bits, int count, const std::string& pixels) {
    std::string bytes = bmp(40, bitmap_rows, bits, 0, "", palette, pixels);
    bytes.replace(14 + 32, 4, little(uint32_t(count), 4));
    return bytes;
  };
  check_colors(with_colors(8, 5, std::string("\3\4\0\0\0\1\2\0", 8)));
  check_colors(with_colors(4, 5, std::string("\x34\0\0\0\1\x20\0\0", 8)));
  CHECK(decode_bitmap(with_colors(8, 5, std::string("\3\4\5\0\0\1\2\0", 8))).refused ==
        "cannot read a: a pixel has colour number 5, but the palette has 5 colours");
  CHECK(decode_bitmap(with_colors(1, 2, std::string("\x40\0\0\0\xa0\0\0\0", 8))).pixels ==
        std::vector<BitmapPixel>{bitmap_colors[1], bitmap_colors[0], bitmap_colors[1], bitmap_colors[0],
                                 bitmap_colors[1], bitmap_colors[0]});
}

TEST_CASE("BMP: compressed files are refused, and other colour spaces cause a warning") {
  const std::string pixels = bmp_rows(24, false);
  for (const int compression : {1, 2, 4, 5, 7})
    CHECK(decode_bitmap(bmp(40, bitmap_rows, 24, compression, "", "", pixels))
              .refused.starts_with("cannot read a: it "));
  CHECK(decode_bitmap(bmp(64, bitmap_rows, 24, 0, "", "", pixels)).refused ==
        "cannot read a: its header has 64 bytes, which no BMP of Windows has");
  CHECK(decode_bitmap(bmp(40, bitmap_rows, 7, 0, "", "", pixels)).refused ==
        "cannot read a: it has 7 bits a pixel");
  const auto of_space = [&](uint32_t space, char endpoint) {
    return decode_bitmap(
               bmp(108, bitmap_rows, 24, 0, std::string(16, '\0') + little(space, 4) + endpoint, "", pixels))
        .warnings.size();
  };
  CHECK(of_space(0x73524742, 1) == 0);
  CHECK(of_space(0, 0) == 0);
  CHECK(of_space(0, 1) == 1);
  CHECK(of_space(0x4d424544, 0) == 1);
}

TEST_CASE("sizes in TGA and BMP headers are trusted only if the file has the bytes") {
  std::string bytes = tga_header(10, 24, 0);
  bytes.replace(12, 4, "\xff\xff\xff\xff");
  CHECK(decode_bitmap(bytes).refused == "cannot read a: it has 65535×65535 pixels; the most is 16384 a side");
  bytes.replace(12, 4, std::string("\0\x40\0\x40", 4));
  CHECK(decode_bitmap(bytes).refused == "cannot read a: it ends early");
  bytes.replace(12, 4, std::string("\0\0\1\0", 4));
  CHECK(decode_bitmap(bytes).refused == "cannot read a: it has 0×1 pixels; the most is 16384 a side");
  std::string map = bmp(40, bitmap_rows, 24, 0, "", "", bmp_rows(24, false));
  map.replace(18, 8, little(16384, 4) + little(uint32_t(-16384), 4));
  CHECK(decode_bitmap(map).refused == "cannot read a: it ends early");
  map.replace(22, 4, little(0x80000000, 4));
  CHECK(decode_bitmap(map).refused ==
        "cannot read a: it has 16384×2147483648 pixels; the most is 16384 a side");
  map = bmp(40, bitmap_rows, 24, 0, "", "", bmp_rows(24, false));
  map.replace(10, 4, "\xff\xff\xff\xff");
  CHECK(decode_bitmap(map).refused == "cannot read a: it ends early");
}

TEST_CASE("TGA and BMP with damaged bytes are decoded or refused") {
  Random random(7);
  std::string tga = tga_header(10, 32, 40);
  tga += "\x82" + std::string("abcd") + "\2" + "efghijklmnop";
  std::string palette;
  for (int i = 0; i < 16; ++i) palette += "abc";
  palette += '\0';
  for (const std::string& whole : {tga, bmp(40, bitmap_rows, 24, 0, "", "", bmp_rows(24, false)),
                                   bmp(40, bitmap_rows, 4, 0, "", palette, std::string(8, '\x11'))})
    for (int i = 0; i < 3000; ++i) {
      std::string bytes = whole;
      for (int change = 0, changes = 1 + random.below(4); change < changes; ++change)
        bytes[size_t(2 + random.below(int(whole.size()) - 2))] = char(random.bits());
      try {
        PixelBudget budget;
        std::vector<std::string> warnings;
        const CodedImage image = decode_coded_image(std::as_bytes(std::span(bytes)), "a", budget, warnings);
        REQUIRE(image.pixels.size() == size_t(image.width) * size_t(image.height));
      } catch (const Error& error) {
        REQUIRE(std::string(error.what()).starts_with("cannot read a: "));
      }
    }
}
