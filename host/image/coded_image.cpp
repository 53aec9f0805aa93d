#include "host/image/coded_image.hpp"

#include <stb_image.h>

#include <memory>
#include <string_view>

#include "host/image/exif.hpp"
#include "host/image/png_rows.hpp"

namespace eyeray::image {

namespace {

// The most pixels that a byte of a file can stand for. Of a PNG: deflate makes at most 1032 bytes of one (RFC
// 1951), and a byte holds at most 8 pixels. A JPEG spends at least a bit on each block of 8 · 8 samples of a
// channel; a channel may be coarser than the picture by 4 in one direction, if another is fine in that one.
constexpr int64_t most_png_pixels_a_byte = 1032 * 8;
constexpr int64_t most_jpeg_pixels_a_byte = 8 * 256;

bool is_png(std::string_view bytes) {
  return bytes.starts_with("\x89PNG\r\n\x1a\n");
}

bool is_jpeg(std::string_view bytes) {
  return bytes.starts_with("\xff\xd8\xff");
}

struct Free {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

}  // namespace

void PixelBudget::take(int width, int height, const std::string& name) {
  const int64_t pixels = int64_t{width} * height;
  if (pixels > left)
    throw TooManyPixels(
        ExitCode::file_io,
        "cannot read {}: it has {}×{} pixels; of the 2^28 that all images of a scene may have together, {} "
        "are left",
        name, width, height, left);
  left -= pixels;
}

CodedImage decode_coded_image(std::span<const std::byte> bytes, const std::string& name,
                              PixelBudget& budget) {
  const auto fail = [&](const std::string& why) {
    return Error(ExitCode::file_io, "cannot read {}: {}", name, why);
  };

  // Look at the size before memory is taken for it.
  if (bytes.size() > most_coded_bytes)
    throw fail(fmt::format("it has {} bytes; the most is {} (1 GiB)", bytes.size(), most_coded_bytes));
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!is_png(text) && !is_jpeg(text)) throw fail("it is neither a PNG nor a JPEG");
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = int(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels))
    throw fail(fmt::format("it is damaged ({})", stbi_failure_reason()));
  if (width < 1 || height < 1 || width > most_coded_side || height > most_coded_side)
    throw fail(fmt::format("it has {}×{} pixels; the most is {} a side", width, height, most_coded_side));
  const int64_t pixels = int64_t{width} * height;
  if (pixels > (is_png(text) ? most_png_pixels_a_byte : most_jpeg_pixels_a_byte) * size)
    throw fail("it ends early");
  budget.take(width, height, name);

  // Decode it, always to four channels.
  CodedImage image{width, height, {}};
  if (is_png(text)) {
    image.pixels.resize(size_t(pixels));
    if (const std::string fault = read_png_rows(bytes, image.pixels); !fault.empty())
      throw fail(fmt::format("it is damaged ({})", fault));
  } else {
    const std::unique_ptr<stbi_uc, Free> codes(
        stbi_load_from_memory(data, size, &width, &height, &channels, 4));
    if (!codes) throw fail(fmt::format("it is damaged ({})", stbi_failure_reason()));
    const auto* first = reinterpret_cast<const std::array<uint8_t, 4>*>(codes.get());
    image.pixels.assign(first, first + pixels);
    image = upright(std::move(image), exif_orientation(bytes));
  }
  return image;
}

}  // namespace eyeray::image
