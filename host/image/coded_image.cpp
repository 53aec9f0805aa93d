#include "host/image/coded_image.hpp"

#include <stb_image.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

#include "host/image/bitmap_rows.hpp"
#include "host/image/color_fields.hpp"
#include "host/image/exif.hpp"
#include "host/image/png_rows.hpp"
#include "host/image/tiff_rows.hpp"
#include "host/image/webp_rows.hpp"

namespace eyeray::engine::image {

namespace {

// The most pixels that a byte of a file can stand for. PNG: deflate expands a byte to at most 1032 bytes (RFC
// 1951), each of which holds at most 8 pixels. JPEG: each block of 8 · 8 samples of a channel takes at least
// a bit. A channel may be coarser than the picture by a factor of 4 in one direction, if another channel is
// not coarser in that direction. WebP: pixels of one colour take no bits, so a file of any length may have
// 2^24 of them. There is no true bound for larger pictures; we set one. TIFF: the same, since its codecs
// differ. A row of white pixels takes a bit in CCITT's group 4.
constexpr int64_t most_png_pixels_a_byte = 1032 * 8;
constexpr int64_t most_jpeg_pixels_a_byte = 8 * 256;
constexpr int64_t most_webp_pixels_a_byte = 8 * 8192, most_pixels_of_any = int64_t{1} << 24;
constexpr int64_t most_tiff_pixels_a_byte = 8 * most_coded_side;

bool is_png(std::string_view bytes) {
  return bytes.starts_with("\x89PNG\r\n\x1a\n");
}

bool is_jpeg(std::string_view bytes) {
  return bytes.starts_with("\xff\xd8\xff");
}

struct Free {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

// A file's format. The functions below give the facts that are needed before memory is taken for the pixels.
enum class Format { png, jpeg, webp, tiff, bmp, tga, other };

Format format_of(std::string_view bytes) {
  if (is_png(bytes)) return Format::png;
  if (is_jpeg(bytes)) return Format::jpeg;
  if (is_webp(bytes)) return Format::webp;
  if (is_tiff(bytes)) return Format::tiff;
  if (is_bmp(bytes)) return Format::bmp;
  return is_tga(bytes) ? Format::tga : Format::other;
}

// The most pixels of a file with so many bytes.
int64_t most_pixels(Format format, int64_t bytes) {
  switch (format) {
    case Format::png:
      return bytes * most_png_pixels_a_byte;
    case Format::jpeg:
      return bytes * most_jpeg_pixels_a_byte;
    case Format::webp:
      return std::max(most_pixels_of_any, bytes * most_webp_pixels_a_byte);
    case Format::tiff:
      return std::max(most_pixels_of_any, bytes * most_tiff_pixels_a_byte);
    case Format::bmp:
      return bytes * most_bmp_pixels_a_byte;
    default:
      return bytes * most_tga_pixels_a_byte;
  }
}

const stbi_uc* stb_bytes(std::string_view bytes) {
  return reinterpret_cast<const stbi_uc*>(bytes.data());
}

// The size that the header states; empty, with the fault, if the header of a PNG, a JPEG or a TIFF cannot be
// read, 0 × 0 if that of a WebP cannot be.
std::optional<BitmapSize> size_of(std::string_view bytes, Format format, std::string& fault) {
  if (format == Format::webp) return webp_size(bytes);
  if (format == Format::bmp) return bmp_size(bytes);
  if (format == Format::tga) return tga_size(bytes);
  if (format == Format::tiff) {
    const BitmapSize size = tiff_size(bytes, fault);
    return fault.empty() ? std::optional(size) : std::nullopt;
  }
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(stb_bytes(bytes), int(bytes.size()), &width, &height, &channels)) {
    fault = stbi_failure_reason();
    return std::nullopt;
  }
  return BitmapSize{width, height};
}

// Decodes to four channels; returns the fault, or "".
std::string read_jpeg(std::string_view bytes, std::span<std::array<uint8_t, 4>> pixels) {
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, Free> codes(
      stbi_load_from_memory(stb_bytes(bytes), int(bytes.size()), &width, &height, &channels, 4));
  if (!codes) return stbi_failure_reason();
  std::memcpy(pixels.data(), codes.get(), pixels.size_bytes());
  return "";
}

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

CodedImage decode_coded_image(std::span<const std::byte> bytes, const std::string& name, PixelBudget& budget,
                              std::vector<std::string>& warnings) {
  const auto fail = [&](const std::string& why) {
    return Error(ExitCode::file_io, "cannot read {}: {}", name, why);
  };

  // Check the size before allocating memory for it.
  if (bytes.size() > most_coded_bytes)
    throw fail(fmt::format("it has {} bytes; the most is {} (1 GiB)", bytes.size(), most_coded_bytes));
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const Format format = format_of(text);
  if (format == Format::other) throw fail("it is not a PNG, JPEG, WebP, TIFF, BMP or TGA");
  std::string header_fault;
  const auto size = size_of(text, format, header_fault);
  if (!size) throw fail(fmt::format("it is damaged ({})", header_fault));
  const auto [width, height] = *size;
  if (width < 1 || height < 1 || width > most_coded_side || height > most_coded_side)
    throw fail(fmt::format("it has {}×{} pixels; the most is {} a side", width, height, most_coded_side));
  if (width * height > most_pixels(format, int64_t(bytes.size()))) throw fail("it ends early");
  budget.take(int(width), int(height), name);

  // Decode it, always to four channels.
  CodedImage image{int(width), int(height), {}};
  image.pixels.resize(size_t(width * height));
  std::vector<std::string> clauses;
  int orientation = 1;
  const auto damaged = [](const std::string& why) {
    return why.empty() ? why : fmt::format("it is damaged ({})", why);
  };
  const std::string fault = [&] {
    switch (format) {
      case Format::png:
        clauses = png_color_fields(text);
        return damaged(read_png_rows(bytes, image.pixels));
      case Format::jpeg:
        // Check for the end: stb_image since 2.28 accepts a truncated file.
        if (!has_jpeg_end(text)) return std::string("it ends early");
        clauses = jpeg_color_fields(text);
        orientation = exif_orientation(bytes);
        return damaged(read_jpeg(text, image.pixels));
      case Format::webp:
        clauses = webp_color_fields(text);
        return damaged(read_webp(text, image.pixels));
      case Format::tiff:
        return read_tiff(text, image.pixels, orientation, clauses);
      case Format::bmp:
        return read_bmp(text, image.pixels, clauses);
      default:
        return read_tga(text, image.pixels, clauses);
    }
  }();
  if (!fault.empty()) throw fail(fault);
  for (const std::string& clause : clauses) warnings.push_back(fmt::format("{}: {}", name, clause));
  return upright(std::move(image), orientation);
}

}  // namespace eyeray::engine::image
