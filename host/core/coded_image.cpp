#include "core/coded_image.hpp"

#include <stb_image.h>

#include <cstring>
#include <memory>
#include <string_view>

#include "core/error.hpp"

namespace eyeray {

namespace {

// The most pixels that a byte of a file can stand for: deflate makes at most 1032 bytes of one (RFC 1951),
// and a byte holds at most 8 pixels. A JPEG spends at least a bit on each block, and a block is no more than
// 8 · 8 pixels of one channel, subsampled by at most 4 · 4.
constexpr int64_t most_pixels_a_byte = 1032 * 8;

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

CodedImage decode_coded_image(std::span<const std::byte> bytes, const std::string& name) {
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
  if (int64_t{width} * height > most_pixels_a_byte * size) throw fail("it ends early");

  // Decode it, always to four channels.
  const std::unique_ptr<stbi_uc, Free> codes(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4));
  if (!codes) throw fail(fmt::format("it is damaged ({})", stbi_failure_reason()));
  CodedImage image{width, height, {}};
  image.pixels.resize(size_t(width) * size_t(height));
  std::memcpy(image.pixels.data(), codes.get(), 4 * image.pixels.size());
  return image;
}

}  // namespace eyeray
