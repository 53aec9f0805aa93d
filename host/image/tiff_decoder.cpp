#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "host/image/color_fields.hpp"
#include "host/image/tiff_file.hpp"
#include "host/image/tiff_rows.hpp"

namespace eyeray::engine::image {

namespace {

using TiffPixel = std::array<uint8_t, 4>;

// The layout of a page's samples, checked.
struct TiffLayout {
  int64_t width, height;
  uint16_t bits, samples, photometric;
  bool separate;  // true: one plane a sample; false: the samples of a pixel lie together
  bool tiled;
  int64_t tile_width, tile_height;
  uint16_t extra;  // the meaning of the first sample beside the colours; EXTRASAMPLE_UNSPECIFIED if none

  uint16_t colors() const {
    if (photometric == PHOTOMETRIC_SEPARATED) return 4;
    return photometric == PHOTOMETRIC_RGB ? 3 : 1;
  }
  bool has_alpha() const { return extra != EXTRASAMPLE_UNSPECIFIED && photometric != PHOTOMETRIC_SEPARATED; }
};

std::string_view name_of_colors(uint16_t photometric) {
  switch (photometric) {
    case PHOTOMETRIC_YCBCR:
      return "YCbCr without JPEG";
    case PHOTOMETRIC_CIELAB:
    case PHOTOMETRIC_ICCLAB:
    case PHOTOMETRIC_ITULAB:
      return "CIE L*a*b*";
    case PHOTOMETRIC_LOGL:
    case PHOTOMETRIC_LOGLUV:
      return "LogLuv";
    case PHOTOMETRIC_CFA:
      return "the raw values of a camera's sensor";
    default:
      return "of an unknown kind";
  }
}

// The reason why a page of this kind is not read, or "". Codecs that few programs write, and old-style JPEG,
// are left out: each would be one more decoder for hostile files.
std::string unread_kind(const TiffFile& file, const TiffLayout& layout) {
  const auto compression = file.field<uint16_t>(TIFFTAG_COMPRESSION);
  constexpr uint16_t known[] = {COMPRESSION_NONE,      COMPRESSION_LZW,       COMPRESSION_ADOBE_DEFLATE,
                                COMPRESSION_DEFLATE,   COMPRESSION_PACKBITS,  COMPRESSION_JPEG,
                                COMPRESSION_CCITTRLE,  COMPRESSION_CCITTRLEW, COMPRESSION_CCITTFAX3,
                                COMPRESSION_CCITTFAX4, COMPRESSION_ZSTD,      COMPRESSION_LZMA};
  if (std::ranges::find(known, compression) == std::end(known))
    return fmt::format("its compression, {} by TIFF's numbers, is not read: save it with LZW or Deflate",
                       compression);
  const auto format = file.field<uint16_t>(TIFFTAG_SAMPLEFORMAT);
  if (format != SAMPLEFORMAT_UINT && format != SAMPLEFORMAT_VOID)
    return "its samples are floating-point or signed numbers: save it with 8 or 16 bits a channel";
  constexpr uint16_t depths[] = {1, 2, 4, 8, 16};
  if (std::ranges::find(depths, layout.bits) == std::end(depths))
    return fmt::format("it has {} bits a channel: save it with 8 or 16", layout.bits);
  constexpr uint16_t models[] = {PHOTOMETRIC_MINISWHITE, PHOTOMETRIC_MINISBLACK, PHOTOMETRIC_RGB,
                                 PHOTOMETRIC_PALETTE, PHOTOMETRIC_SEPARATED};
  if (std::ranges::find(models, layout.photometric) == std::end(models))
    return fmt::format("its colours are {}: save it as RGB", name_of_colors(layout.photometric));
  if (layout.samples < layout.colors())
    return fmt::format("it is damaged (it has {} channels and needs {})", layout.samples, layout.colors());
  return "";
}

// Reads the layout of the first page, and the reason why it is not read.
TiffLayout layout_of(const TiffFile& file, std::string& fault) {
  TIFF* tiff = file.get();
  // libtiff converts the YCbCr of its JPEG codec.
  if (file.field<uint16_t>(TIFFTAG_COMPRESSION) == COMPRESSION_JPEG &&
      file.field<uint16_t>(TIFFTAG_PHOTOMETRIC) == PHOTOMETRIC_YCBCR)
    TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
  TiffLayout layout{.width = file.field<uint32_t>(TIFFTAG_IMAGEWIDTH),
                    .height = file.field<uint32_t>(TIFFTAG_IMAGELENGTH),
                    .bits = file.field<uint16_t>(TIFFTAG_BITSPERSAMPLE),
                    .samples = file.field<uint16_t>(TIFFTAG_SAMPLESPERPIXEL),
                    .photometric = file.field<uint16_t>(TIFFTAG_PHOTOMETRIC),
                    .separate = file.field<uint16_t>(TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE,
                    .tiled = TIFFIsTiled(tiff) != 0,
                    .tile_width = file.field<uint32_t>(TIFFTAG_TILEWIDTH),
                    .tile_height = file.field<uint32_t>(TIFFTAG_TILELENGTH),
                    .extra = EXTRASAMPLE_UNSPECIFIED};
  if (layout.photometric == PHOTOMETRIC_YCBCR &&
      file.field<uint16_t>(TIFFTAG_COMPRESSION) == COMPRESSION_JPEG)
    layout.photometric = PHOTOMETRIC_RGB;
  fault = unread_kind(file, layout);
  uint16_t count = 0, *kinds = nullptr;
  if (TIFFGetFieldDefaulted(tiff, TIFFTAG_EXTRASAMPLES, &count, &kinds) && count > 0 &&
      layout.samples > layout.colors())
    layout.extra = kinds[0];
  return layout;
}

// Turns the samples of a page to pixels: first each row of samples to 8-bit codes, then the codes to red,
// green, blue and alpha.
class TiffReader {
 public:
  TiffReader(const TiffFile& file, const TiffLayout& layout, std::span<TiffPixel> pixels)
      : file_(file), layout_(layout), pixels_(pixels) {}

  // Returns the fault, or "".
  std::string read() {
    if (layout_.photometric == PHOTOMETRIC_PALETTE && !read_palette())
      return "it is damaged (it has no palette)";
    std::ranges::fill(pixels_, TiffPixel{0, 0, 0, 255});
    const bool whole = layout_.tiled ? read_tiles() : read_strips();
    if (!whole || !file_.fault().empty())
      return fmt::format("it is damaged ({})", file_.fault().empty() ? "it ends early" : file_.fault());
    for (TiffPixel& pixel : pixels_) finish(pixel);
    return "";
  }

 private:
  // The number of planes that pixels need: one, unless each sample has its own.
  uint16_t planes() const {
    return layout_.separate ? uint16_t(layout_.colors() + (layout_.has_alpha() ? 1 : 0)) : uint16_t{1};
  }

  bool read_strips() {
    buffer_.resize(size_t(TIFFScanlineSize64(file_.get())));
    for (uint16_t plane = 0; plane < planes(); ++plane)
      for (int64_t y = 0; y < layout_.height; ++y) {
        if (TIFFReadScanline(file_.get(), buffer_.data(), uint32_t(y), plane) < 1) return false;
        if (!take_row(buffer_, plane, 0, y, layout_.width)) return false;
      }
    return true;
  }

  bool read_tiles() {
    const auto row_size = size_t(TIFFTileRowSize64(file_.get()));
    buffer_.resize(size_t(TIFFTileSize64(file_.get())));
    for (uint16_t plane = 0; plane < planes(); ++plane)
      for (int64_t y = 0; y < layout_.height; y += layout_.tile_height)
        for (int64_t x = 0; x < layout_.width; x += layout_.tile_width) {
          if (TIFFReadTile(file_.get(), buffer_.data(), uint32_t(x), uint32_t(y), 0, plane) < 0) return false;
          const int64_t columns = std::min(layout_.tile_width, layout_.width - x);
          const int64_t rows = std::min(layout_.tile_height, layout_.height - y);
          for (int64_t row = 0; row < rows; ++row)
            if (!take_row(std::span(buffer_).subspan(size_t(row) * row_size, row_size), plane, x, y + row,
                          columns))
              return false;
        }
    return true;
  }

  // Takes the samples of `columns` pixels from (x, y) on; false if the row is too short for them.
  bool take_row(std::span<const uint8_t> row, uint16_t plane, int64_t x, int64_t y, int64_t columns) {
    const size_t samples = layout_.separate ? 1 : layout_.samples;
    if (row.size() * 8 < size_t(columns) * samples * layout_.bits) return false;
    const size_t used = std::min<size_t>(samples, layout_.colors() + size_t(layout_.has_alpha()));
    TiffPixel* pixel = &pixels_[size_t(y * layout_.width + x)];
    for (size_t column = 0; column < size_t(columns); ++column, ++pixel)
      for (size_t sample = 0; sample < used; ++sample)
        take_sample(*pixel, layout_.separate ? plane : sample, sample_at(row, column * samples + sample));
    return true;
  }

  uint32_t sample_at(std::span<const uint8_t> row, size_t i) const {
    if (layout_.bits == 16) {
      uint16_t value;
      std::memcpy(&value, &row[2 * i], sizeof value);
      return value;
    }
    const size_t bit = i * layout_.bits;
    return uint32_t(row[bit / 8]) >> (8 - layout_.bits - bit % 8) & ((1u << layout_.bits) - 1);
  }

  // The 8-bit code of a sample.
  uint8_t code_of(uint32_t value) const {
    if (layout_.bits == 16) return uint8_t(value >> 8);
    return uint8_t(value * 255 / ((1u << layout_.bits) - 1));
  }

  void take_sample(TiffPixel& pixel, size_t sample, uint32_t value) const {
    if (sample >= layout_.colors())
      pixel[3] = code_of(value);
    else if (layout_.photometric == PHOTOMETRIC_PALETTE)
      for (size_t i = 0; i < 3; ++i) pixel[i] = palette_[i][value];
    else
      pixel[sample] = code_of(value);
  }

  // The palette's colours as 8-bit codes. Some programs write 8 bits into its 16.
  bool read_palette() {
    std::array<uint16_t*, 3> written{};
    if (!TIFFGetField(file_.get(), TIFFTAG_COLORMAP, &written[0], &written[1], &written[2])) return false;
    const size_t size = size_t{1} << layout_.bits;
    const bool in_8_bits = std::ranges::all_of(written, [&](const uint16_t* channel) {
      return std::all_of(channel, channel + size, [](uint16_t value) { return value < 256; });
    });
    for (size_t i = 0; i < 3; ++i)
      for (size_t k = 0; k < size; ++k)
        palette_[i].push_back(uint8_t(in_8_bits ? written[i][k] : written[i][k] >> 8));
    return true;
  }

  // Turns a pixel's codes to red, green, blue and alpha.
  void finish(TiffPixel& pixel) const {
    auto& [red, green, blue, alpha] = pixel;
    switch (layout_.photometric) {
      case PHOTOMETRIC_MINISWHITE:
        red = uint8_t(255 - red);
        [[fallthrough]];
      case PHOTOMETRIC_MINISBLACK:
        green = blue = red;
        break;
      case PHOTOMETRIC_SEPARATED:  // cyan, magenta, yellow and black
        for (size_t i = 0; i < 3; ++i) pixel[i] = uint8_t(((255 - pixel[i]) * (255 - alpha) + 127) / 255);
        alpha = 255;
        break;
      default:
        break;
    }
    if (layout_.has_alpha() && layout_.extra == EXTRASAMPLE_ASSOCALPHA && alpha > 0)
      for (size_t i = 0; i < 3; ++i) pixel[i] = uint8_t(std::min((pixel[i] * 255 + alpha / 2) / alpha, 255));
  }

  const TiffFile& file_;
  const TiffLayout& layout_;
  std::span<TiffPixel> pixels_;
  std::vector<uint8_t> buffer_;
  std::array<std::vector<uint8_t>, 3> palette_;
};

// Clauses for the fields that are ignored.
void list_ignored(const TiffFile& file, const TiffLayout& layout, std::vector<std::string>& warnings) {
  uint32_t size = 0;
  void* profile = nullptr;
  if (TIFFGetField(file.get(), TIFFTAG_ICCPROFILE, &size, &profile) && layout.colors() == 3)
    if (std::string clause = profile_clause({static_cast<const char*>(profile), size}); !clause.empty())
      warnings.push_back(std::move(clause));
  const auto across = file.field<float>(TIFFTAG_XRESOLUTION), down = file.field<float>(TIFFTAG_YRESOLUTION);
  if (across > 0 && down > 0 && across != down)
    warnings.emplace_back("its pixels are not square (its resolutions differ), which is ignored");
  const int used = layout.colors() + int(layout.has_alpha());
  if (layout.samples > used)
    warnings.push_back(fmt::format("{} of its channels are neither colours nor alpha, and were left out",
                                   layout.samples - used));
  if (!TIFFLastDirectory(file.get())) warnings.emplace_back("only the first of its pages is read");
}

}  // namespace

bool is_tiff(std::string_view bytes) {
  using namespace std::string_view_literals;
  const std::string_view start = bytes.substr(0, 4);
  return start == "II*\0"sv || start == "MM\0*"sv || start == "II+\0"sv || start == "MM\0+"sv;
}

BitmapSize tiff_size(std::string_view bytes, std::string& fault) {
  const TiffFile file(bytes);
  if (!file.get()) {
    fault = file.fault();
    return {0, 0};
  }
  return {file.field<uint32_t>(TIFFTAG_IMAGEWIDTH), file.field<uint32_t>(TIFFTAG_IMAGELENGTH)};
}

std::string read_tiff(std::string_view bytes, std::span<TiffPixel> pixels, int& orientation,
                      std::vector<std::string>& warnings) {
  const TiffFile file(bytes);
  if (!file.get()) return fmt::format("it is damaged ({})", file.fault());
  std::string fault;
  const TiffLayout layout = layout_of(file, fault);
  if (!fault.empty()) return fault;
  // A strip is read by rows, and a tile at once.
  constexpr uint64_t most_buffer = uint64_t{1} << 26;
  const uint64_t buffer = layout.tiled ? TIFFTileSize64(file.get()) : TIFFScanlineSize64(file.get());
  if (buffer == 0 || buffer > most_buffer)
    return fmt::format("a row or a tile of it has {} bytes; the most is {} (64 MiB)", buffer, most_buffer);
  if (layout.tiled && (layout.tile_width < 1 || layout.tile_height < 1)) return "it is damaged (empty tiles)";
  const auto stored = file.field<uint16_t>(TIFFTAG_ORIENTATION);
  orientation = stored >= 1 && stored <= 8 ? stored : 1;
  list_ignored(file, layout, warnings);
  return TiffReader(file, layout, pixels).read();
}

}  // namespace eyeray::engine::image
