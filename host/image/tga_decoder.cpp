#include <fmt/format.h>

#include <algorithm>

#include "host/image/bitmap_rows.hpp"

namespace eyeray::engine::image {

namespace {

using Pixel = std::array<uint8_t, 4>;

constexpr size_t header_size = 18, footer_size = 26, extension_size = 495;

// The header: the first 18 bytes of a file.
struct Header {
  uint64_t id_size, map_type, type, map_first, map_count, map_bits, width, height, bits, descriptor;

  explicit Header(std::string_view bytes)
      : id_size(number_at(bytes, 0, 1)),
        map_type(number_at(bytes, 1, 1)),
        type(number_at(bytes, 2, 1)),
        map_first(number_at(bytes, 3, 2)),
        map_count(number_at(bytes, 5, 2)),
        map_bits(number_at(bytes, 7, 1)),
        width(number_at(bytes, 12, 2)),
        height(number_at(bytes, 14, 2)),
        bits(number_at(bytes, 16, 1)),
        descriptor(number_at(bytes, 17, 1)) {}

  bool in_runs() const { return type >= 9; }
  bool is_mapped() const { return (type & 7) == 1; }
  bool is_grey() const { return (type & 7) == 3; }
  uint64_t alpha_bits() const { return descriptor & 15; }
  bool from_right() const { return (descriptor & 16) != 0; }
  bool from_top() const { return (descriptor & 32) != 0; }
  bool interleaved() const { return (descriptor & 0xc0) != 0; }
  uint64_t map_bytes() const { return map_type == 1 ? map_count * ((map_bits + 7) / 8) : 0; }

  bool possible() const {
    const auto one_of = [](uint64_t x, std::initializer_list<uint64_t> known) {
      return std::ranges::find(known, x) != known.end();
    };
    if (map_type > 1 || !one_of(type, {1, 2, 3, 9, 10, 11})) return false;
    if (map_type == 1 && !one_of(map_bits, {15, 16, 24, 32})) return false;
    if (is_mapped()) return map_type == 1 && map_count > 0 && one_of(bits, {8, 16});
    return is_grey() ? one_of(bits, {8, 16}) : one_of(bits, {15, 16, 24, 32});
  }
};

uint8_t five_bits(uint32_t value) {
  return uint8_t(((value & 31) * 255 + 15) / 31);
}

// Reads a colour of 15, 16, 24 or 32 bits. `alpha`: whether the bits beyond three channels are alpha.
Pixel color(std::string_view bytes, uint64_t at, uint64_t bits, bool alpha) {
  if (bits <= 16) {
    const uint32_t value = number_at(bytes, at, 2);
    return {five_bits(value >> 10), five_bits(value >> 5), five_bits(value),
            uint8_t(alpha && (value & 0x8000) == 0 ? 0 : 255)};
  }
  const auto channel = [&](uint64_t i) { return uint8_t(number_at(bytes, at + i, 1)); };
  return {channel(2), channel(1), channel(0), bits == 32 && alpha ? channel(3) : uint8_t(255)};
}

class TgaReader {
 public:
  explicit TgaReader(std::string_view bytes) : bytes_(bytes), header_(bytes) {}

  std::string read(std::span<Pixel> pixels, std::vector<std::string>& warnings) {
    if (header_.interleaved()) return "its rows are interleaved, which TGA 2 forbids";
    map_ = header_size + header_.id_size;
    at_ = map_ + header_.map_bytes();
    look_at_extension(warnings);
    for (size_t i = 0; i < pixels.size();) {
      uint64_t count = 1;
      bool same = false;
      if (header_.in_runs()) {
        if (at_ >= bytes_.size()) return "it ends early";
        const uint32_t packet = number_at(bytes_, at_++, 1);
        count = std::min<uint64_t>((packet & 127) + 1, pixels.size() - i);
        same = packet >= 128;
      }
      for (uint64_t k = 0; k < count; ++k, ++i) {
        const uint64_t size = (header_.bits + 7) / 8;
        if (at_ > bytes_.size() || size > bytes_.size() - at_) return "it ends early";
        const uint64_t index = header_.is_mapped() ? number_at(bytes_, at_, size) : 0;
        if (header_.is_mapped() &&
            (index < header_.map_first || index - header_.map_first >= header_.map_count))
          return fmt::format("a pixel has colour number {}, but the palette begins at {} and has {} colours",
                             index, header_.map_first, header_.map_count);
        pixel_at(pixels, i) = pixel(index);
        if (!same || k + 1 == count) at_ += size;
      }
    }
    return "";
  }

 private:
  // The pixel of the picture for the i-th pixel of the file: the header states on which sides the file's rows
  // and columns begin.
  Pixel& pixel_at(std::span<Pixel> pixels, size_t i) const {
    const auto width = size_t(header_.width), height = size_t(header_.height);
    const size_t row = i / width, column = i % width;
    return pixels[(header_.from_top() ? row : height - 1 - row) * width +
                  (header_.from_right() ? width - 1 - column : column)];
  }

  Pixel pixel(uint64_t index) const {
    if (header_.is_mapped()) {
      const uint64_t size = (header_.map_bits + 7) / 8;
      return color(bytes_, map_ + (index - header_.map_first) * size, header_.map_bits, has_alpha_);
    }
    if (!header_.is_grey()) return color(bytes_, at_, header_.bits, has_alpha_);
    const auto grey = uint8_t(number_at(bytes_, at_, 1));
    return {grey, grey, grey,
            header_.bits == 16 && has_alpha_ ? uint8_t(number_at(bytes_, at_ + 1, 1)) : uint8_t(255)};
  }

  // Reads whether the file has alpha, from the header and from TGA 2's extension area. The file's last bytes
  // point to that area. Warns of ignored fields.
  void look_at_extension(std::vector<std::string>& warnings) {
    has_alpha_ = header_.alpha_bits() > 0;
    const uint64_t bits = header_.is_mapped() ? header_.map_bits : header_.bits;
    if (!has_alpha_ && (bits == 32 || (header_.is_grey() && bits == 16)))
      warnings.emplace_back(
          "the header declares no bits of alpha, so that those of its pixels were left out");
    constexpr std::string_view signature("TRUEVISION-XFILE.\0", 18);
    if (bytes_.size() < header_size + footer_size || !bytes_.ends_with(signature)) return;
    const uint64_t at = number_at(bytes_, bytes_.size() - footer_size, 4);
    if (at == 0 || number_at(bytes_, at, 2) < extension_size || at > bytes_.size() - extension_size) return;
    const auto ratio = [&](uint64_t where) {
      const double above = number_at(bytes_, at + where, 2), below = number_at(bytes_, at + where + 2, 2);
      return below > 0 ? above / below : 0;
    };
    if (const double aspect = ratio(474); aspect > 0 && aspect != 1)
      warnings.push_back(
          fmt::format("its pixels are not square ({:.3g} times as wide as high), which is ignored", aspect));
    if (const double gamma = ratio(478); gamma > 0 && gamma != 1)
      warnings.push_back(fmt::format("its gamma of {:.3g} is ignored", gamma));
    switch (number_at(bytes_, at + 494, 1)) {
      case 3:
        break;
      case 4:
        warnings.emplace_back("its colours are multiplied by alpha, which is ignored");
        break;
      default:  // 0: no alpha; 1 and 2: alpha without meaning
        has_alpha_ = false;
    }
  }

  std::string_view bytes_;
  Header header_;
  uint64_t map_ = 0;  // where the palette begins
  uint64_t at_ = 0;   // the next byte to read
  bool has_alpha_ = false;
};

}  // namespace

uint32_t number_at(std::string_view bytes, uint64_t at, uint64_t size) {
  if (at > bytes.size() || size > bytes.size() - at) return 0;
  uint32_t value = 0;
  for (uint64_t i = 0; i < size; ++i) value |= uint32_t(uint8_t(bytes[size_t(at + i)])) << (8 * i);
  return value;
}

bool is_tga(std::string_view bytes) {
  return bytes.size() >= header_size && Header(bytes).possible();
}

BitmapSize tga_size(std::string_view bytes) {
  const Header header(bytes);
  return {int64_t(header.width), int64_t(header.height)};
}

std::string read_tga(std::string_view bytes, std::span<Pixel> pixels, std::vector<std::string>& warnings) {
  return TgaReader(bytes).read(pixels, warnings);
}

}  // namespace eyeray::engine::image
