#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "host/image/bitmap_rows.hpp"

namespace eyeray::engine::image {

namespace {

using Pixel = std::array<uint8_t, 4>;

constexpr uint64_t file_header = 14, core_header = 12, info_header = 40;
enum Compression : uint32_t { plain = 0, bit_fields = 3, alpha_bit_fields = 6 };

// The header that follows the file header's 14 bytes, in the form of Windows 3 and later; the header of OS/2
// 1 is shorter.
struct Header {
  uint64_t pixels_at, size;
  int64_t width, height;
  uint64_t planes, bits, compression, colors;

  explicit Header(std::string_view bytes)
      : pixels_at(number_at(bytes, 10, 4)), size(number_at(bytes, file_header, 4)) {
    const bool core = size == core_header;
    const auto side = [&](uint64_t at) { return int64_t(int32_t(number_at(bytes, file_header + at, 4))); };
    width = core ? number_at(bytes, file_header + 4, 2) : side(4);
    height = core ? number_at(bytes, file_header + 6, 2) : side(8);
    planes = number_at(bytes, file_header + (core ? 8 : 12), 2);
    bits = number_at(bytes, file_header + (core ? 10 : 14), 2);
    compression = core ? uint32_t(plain) : number_at(bytes, file_header + 16, 4);
    colors = core ? 0 : number_at(bytes, file_header + 32, 4);
    if (bits <= 8 && colors == 0) colors = uint64_t{1} << bits;
  }

  uint64_t color_size() const { return size == core_header ? 3 : 4; }
  uint64_t row_size() const { return (uint64_t(width) * bits + 31) / 32 * 4; }
  // The offset of the colour masks: in the header, or right after a header of 40 bytes.
  uint64_t masks_at() const { return file_header + info_header; }
  uint64_t palette_at() const {
    const uint64_t masks = size != info_header               ? 0
                           : compression == bit_fields       ? 12
                           : compression == alpha_bit_fields ? 16
                                                             : 0;
    return file_header + size + masks;
  }
  bool has_alpha_mask() const {
    return compression == alpha_bit_fields || (compression == bit_fields && size >= 56);
  }

  std::string fault() const {
    constexpr uint64_t sizes[] = {core_header, info_header, 52, 56, 108, 124};
    if (std::ranges::find(sizes, size) == std::end(sizes))
      return fmt::format("its header has {} bytes, which no BMP of Windows has", size);
    if (planes != 1) return fmt::format("it has {} planes instead of 1", planes);
    if (compression == 1 || compression == 2)
      return "it is compressed by run lengths: write it without compression";
    if (compression == 4 || compression == 5)
      return "it contains a JPEG or a PNG for a printer: use that file";
    const bool fields = compression == bit_fields || compression == alpha_bit_fields;
    if (compression != plain && !fields)
      return fmt::format("it has compression {}, which BMP does not define", compression);
    constexpr uint64_t known[] = {1, 4, 8, 16, 24, 32};
    if (std::ranges::find(known, bits) == std::end(known) || (fields && bits != 16 && bits != 32))
      return fmt::format("it has {} bits a pixel{}", bits, fields ? " in bit fields" : "");
    if (bits <= 8 && colors > (uint64_t{1} << bits))
      return fmt::format("it has {} colours of {} bits", colors, bits);
    return "";
  }
};

// A channel of a pixel: its bits under the mask, scaled to 0 … 255; `without` if the mask is 0.
uint8_t channel(uint32_t value, uint32_t mask, uint8_t without) {
  if (mask == 0) return without;
  const uint64_t most = mask >> std::countr_zero(mask), code = (value & mask) >> std::countr_zero(mask);
  return uint8_t((code * 255 + most / 2) / most);
}

std::array<uint32_t, 4> masks_of(std::string_view bytes, const Header& header) {
  if (header.compression == plain)
    return header.bits == 16 ? std::array<uint32_t, 4>{0x7c00, 0x3e0, 0x1f, 0}
                             : std::array<uint32_t, 4>{0xff0000, 0xff00, 0xff, 0};
  std::array<uint32_t, 4> masks{};
  for (size_t i = 0; i < (header.has_alpha_mask() ? 4 : 3); ++i)
    masks[i] = number_at(bytes, header.masks_at() + 4 * i, 4);
  return masks;
}

// Adds warnings about the fields that define the colours.
void note_colors(std::string_view bytes, const Header& header, std::vector<std::string>& warnings) {
  if (header.size == core_header) return;
  const uint32_t across = number_at(bytes, file_header + 24, 4), down = number_at(bytes, file_header + 28, 4);
  if (across > 0 && down > 0 && across != down)
    warnings.push_back(
        fmt::format("its pixels are not square ({} and {} a metre), which is ignored", across, down));
  if (header.size < 108) return;
  constexpr uint32_t calibrated = 0, srgb = 0x73524742, windows = 0x57696e20;
  const uint32_t space = number_at(bytes, file_header + 56, 4);
  if (space == srgb || space == windows) return;
  const bool endpoints = space == calibrated && std::ranges::any_of(bytes.substr(file_header + 60, 48),
                                                                    [](char c) { return c != 0; });
  if (endpoints)
    warnings.emplace_back("its own primaries and gamma are ignored: its colours are read as sRGB");
  if (space != calibrated)
    warnings.emplace_back("its colour profile is ignored: its colours are read as sRGB");
}

}  // namespace

bool is_bmp(std::string_view bytes) {
  return bytes.starts_with("BM") && bytes.size() >= file_header + core_header;
}

BitmapSize bmp_size(std::string_view bytes) {
  const Header header(bytes);
  return {header.width, header.height < 0 ? -header.height : header.height};
}

std::string read_bmp(std::string_view bytes, std::span<Pixel> pixels, std::vector<std::string>& warnings) {
  const Header header(bytes);
  if (std::string fault = header.fault(); !fault.empty()) return fault;
  if (file_header + header.size > bytes.size()) return "it ends early";
  note_colors(bytes, header, warnings);
  const auto width = size_t(header.width), height = pixels.size() / width;
  if (header.pixels_at > bytes.size() || header.row_size() * height > bytes.size() - header.pixels_at)
    return "it ends early";

  const std::array<uint32_t, 4> masks = masks_of(bytes, header);
  for (size_t y = 0; y < height; ++y) {
    const uint64_t row = header.pixels_at + y * header.row_size();
    Pixel* out = pixels.data() + (header.height < 0 ? y : height - 1 - y) * width;
    for (size_t x = 0; x < width; ++x) {
      if (header.bits > 8) {
        const uint32_t value = number_at(bytes, row + x * header.bits / 8, header.bits / 8);
        out[x] = {channel(value, masks[0], 0), channel(value, masks[1], 0), channel(value, masks[2], 0),
                  channel(value, masks[3], 255)};
        continue;
      }
      const uint64_t bit = x * header.bits;
      const uint64_t index =
          number_at(bytes, row + bit / 8, 1) >> (8 - header.bits - bit % 8) & ((1U << header.bits) - 1);
      const uint64_t at = header.palette_at() + index * header.color_size();
      if (index >= header.colors || at + 3 > bytes.size())
        return fmt::format("a pixel has colour number {}, but the palette has {} colours", index,
                           header.colors);
      for (size_t c = 0; c < 3; ++c) out[x][c] = uint8_t(bytes[size_t(at + 2 - c)]);
      out[x][3] = 255;
    }
  }
  return "";
}

}  // namespace eyeray::engine::image
