#include "host/image/exif.hpp"

#include <optional>

namespace eyeray::engine::image {

namespace {

// Numbers of a TIFF block, in its order of bytes; 0 beyond its end.
struct Tiff {
  std::string_view bytes;

  uint64_t number(uint64_t at, uint64_t size) const {
    if (at > bytes.size() || size > bytes.size() - at) return 0;
    const bool little = bytes.starts_with("II");
    uint64_t value = 0;
    for (uint64_t i = 0; i < size; ++i)
      value = value << 8 | uint8_t(bytes[size_t(at + (little ? size - 1 - i : i))]);
    return value;
  }
};

int orientation_of(const Tiff& tiff) {
  constexpr uint64_t magic = 42, entry_size = 12, orientation_tag = 0x0112;
  if (tiff.number(2, 2) != magic) return 1;
  const uint64_t directory = tiff.number(4, 4), count = tiff.number(directory, 2);
  for (uint64_t i = 0; i < count; ++i) {
    const uint64_t entry = directory + 2 + i * entry_size;
    if (tiff.number(entry, 2) != orientation_tag) continue;
    const uint64_t value = tiff.number(entry + 8, 2);
    return value >= 1 && value <= 8 ? int(value) : 1;
  }
  return 1;
}

}  // namespace

int exif_orientation(std::span<const std::byte> jpeg) {
  constexpr std::string_view exif("Exif\0\0", 6);
  constexpr uint32_t app1 = 0xe1;
  std::optional<int> orientation;
  for_each_jpeg_segment({reinterpret_cast<const char*>(jpeg.data()), jpeg.size()},
                        [&](uint32_t marker, std::string_view content) {
                          if (!orientation && marker == app1 && content.starts_with(exif))
                            orientation = tiff_orientation(content.substr(exif.size()));
                        });
  return orientation.value_or(1);
}

int tiff_orientation(std::string_view tiff) {
  return orientation_of({tiff});
}

void for_each_jpeg_segment(std::string_view jpeg,
                           const std::function<void(uint32_t, std::string_view)>& visit) {
  const auto byte = [&](size_t at) { return size_t{uint8_t(jpeg[at])}; };
  // Each segment is FF, a marker, a length that includes its own bytes, and content. Pixels begin at FF DA.
  for (size_t at = 2; at + 4 <= jpeg.size() && byte(at) == 0xff && byte(at + 1) != 0xda;) {
    const size_t length = byte(at + 2) << 8 | byte(at + 3);
    if (length < 2 || length > jpeg.size() - at - 2) break;
    visit(uint32_t(byte(at + 1)), jpeg.substr(at + 4, length - 2));
    at += 2 + length;
  }
}

bool has_jpeg_end(std::string_view jpeg) {
  const auto byte = [&](size_t at) { return size_t{uint8_t(jpeg[at])}; };
  for (size_t at = 2; at + 2 <= jpeg.size();) {
    const size_t marker = byte(at + 1);
    if (byte(at) != 0xff || marker == 0xff) {
      ++at;  // coded pixels, or a fill byte
    } else if (marker == 0xd9) {
      return true;
    } else if (marker == 0 || marker == 1 || (marker >= 0xd0 && marker <= 0xd8)) {
      at += 2;  // a marker without a length
    } else if (at + 4 <= jpeg.size()) {
      at += 2 + (byte(at + 2) << 8 | byte(at + 3));
    } else {
      break;
    }
  }
  return false;
}

CodedImage upright(CodedImage image, int orientation) {
  if (orientation == 1) return image;
  const bool turned = orientation >= 5;  // rows become columns
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_bottom = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  CodedImage seen{turned ? image.height : image.width, turned ? image.width : image.height, {}};
  seen.pixels.reserve(image.pixels.size());
  for (int y = 0; y < seen.height; ++y)
    for (int x = 0; x < seen.width; ++x) {
      int column = turned ? y : x, row = turned ? x : y;
      if (from_right) column = image.width - 1 - column;
      if (from_bottom) row = image.height - 1 - row;
      seen.pixels.push_back(image.pixels[size_t(row) * size_t(image.width) + size_t(column)]);
    }
  return seen;
}

}  // namespace eyeray::engine::image
