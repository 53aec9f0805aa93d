// Compressed TIFF, as libtiff writes it.
#include <tiffio.h>

#include "decode_tiff.hpp"
#include "host/core/atomic_file.hpp"
#include "tests/support/process.hpp"
#include "tests/support/random.hpp"

using namespace eyeray::engine;
using test::decode_tiff;
using test::Decoded;
using test::Random;

namespace {

// A picture of 48 × 40 pixels whose red grows to the right and green downwards, as libtiff writes it.
std::string compressed_tiff(uint16_t compression, bool tiled, bool bilevel) {
  const test::TemporaryFolder folder;
  const std::string name = folder / "a.tif";
  const int samples = bilevel ? 1 : 3, side = 16;
  TIFF* tiff = TIFFOpen(name.c_str(), "w");
  REQUIRE(tiff);
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 48);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 40);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bilevel ? 1 : 8);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, samples);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, compression);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC,
               bilevel ? PHOTOMETRIC_MINISWHITE
                       : (compression == COMPRESSION_JPEG ? PHOTOMETRIC_YCBCR : PHOTOMETRIC_RGB));
  if (compression == COMPRESSION_JPEG) TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
  const auto row = [&](int left, int width, int y) {
    std::string bytes(bilevel ? size_t(width) / 8 : size_t(width * 3), '\0');
    for (int x = 0; x < width; ++x) {
      if (bilevel && left + x < y) bytes[size_t(x) / 8] = char(bytes[size_t(x) / 8] | 0x80 >> x % 8);
      if (!bilevel) bytes.replace(size_t(3 * x), 3, {char(5 * (left + x)), char(6 * y), 50});
    }
    return bytes;
  };
  if (tiled) {
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, side);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, side);
    for (int top = 0; top < 40; top += side)
      for (int left = 0; left < 48; left += side) {
        std::string tile;
        for (int y = top; y < top + side; ++y) tile += row(left, side, y);
        REQUIRE(TIFFWriteTile(tiff, tile.data(), uint32_t(left), uint32_t(top), 0, 0) > 0);
      }
  } else {
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 16);
    for (int y = 0; y < 40; ++y) {
      std::string bytes = row(0, 48, y);
      REQUIRE(TIFFWriteScanline(tiff, bytes.data(), uint32_t(y)) == 1);
    }
  }
  TIFFClose(tiff);
  return read_file(name);
}

constexpr uint16_t tiff_codecs[] = {COMPRESSION_NONE,     COMPRESSION_LZW,  COMPRESSION_ADOBE_DEFLATE,
                                    COMPRESSION_PACKBITS, COMPRESSION_ZSTD, COMPRESSION_LZMA,
                                    COMPRESSION_JPEG};

}  // namespace

TEST_CASE("TIFF: every compression, in strips and tiles") {
  for (const uint16_t compression : tiff_codecs)
    for (const bool tiled : {false, true}) {
      CAPTURE(compression);
      CAPTURE(tiled);
      const Decoded found = decode_tiff(compressed_tiff(compression, tiled, false));
      CHECK(found.refused == "");
      CHECK(found.warnings.empty());
      REQUIRE(found.pixels.size() == 48 * 40);
      const int slack = compression == COMPRESSION_JPEG ? 12 : 0;
      int wrong = 0;
      for (int i = 0; i < 48 * 40; ++i) {
        const auto& pixel = found.pixels[size_t(i)];
        wrong += std::abs(pixel[0] - 5 * (i % 48)) > slack || std::abs(pixel[1] - 6 * (i / 48)) > slack ||
                 std::abs(pixel[2] - 50) > slack || pixel[3] != 255;
      }
      CHECK(wrong == 0);
    }
  for (const int codec : {COMPRESSION_CCITTRLE, COMPRESSION_CCITTFAX3, COMPRESSION_CCITTFAX4}) {
    CAPTURE(codec);
    const Decoded found = decode_tiff(compressed_tiff(uint16_t(codec), false, true));
    CHECK(found.refused == "");
    REQUIRE(found.pixels.size() == 48 * 40);
    for (size_t i = 0; i < 48 * 40; ++i) CHECK(found.pixels[i][0] == (i % 48 < i / 48 ? 0 : 255));
  }
}

TEST_CASE("a TIFF that is cut short is refused, and one with damaged bytes is decoded or refused") {
  Random random(6);
  int decoded = 0, refused = 0;
  std::vector<std::string> files;
  for (const uint16_t compression : tiff_codecs) files.push_back(compressed_tiff(compression, true, false));
  files.push_back(compressed_tiff(COMPRESSION_CCITTFAX4, false, true));
  for (const std::string& whole : files) {
    // Lists lie at the end of the files, or pixels do.
    for (size_t length = 0; length + 4 < whole.size(); length += 1 + whole.size() / 200)
      CHECK(decode_tiff(whole.substr(0, length)).refused.starts_with("cannot read a: it "));
    for (int round = 0; round < 500; ++round) {
      std::string bytes = whole;
      for (int change = 0, changes = 1 + random.below(4); change < changes; ++change)
        bytes[size_t(4 + random.below(int(whole.size()) - 4))] = char(random.bits());
      const std::string message = decode_tiff(bytes).refused;
      ++(message.empty() ? decoded : refused);
      REQUIRE((message.empty() || message.starts_with("cannot read a: ")));
    }
  }
  CHECK(decoded > 100);
  CHECK(refused > 100);
}
