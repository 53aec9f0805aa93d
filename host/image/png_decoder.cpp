#include <png.h>

#include <csetjmp>
#include <cstring>
#include <new>

#include "host/image/png_rows.hpp"

namespace eyeray::engine::image {

namespace {

// Limit on the bytes of a chunk that holds no pixels.
constexpr png_alloc_size_t most_chunk_bytes = 8'000'000;

// libpng is C, and no exception may pass through it: a failure is returned as a text.
class PngReader {
 public:
  explicit PngReader(std::span<const std::byte> bytes)
      : bytes_(bytes), png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore)) {
    if (png_) info_ = png_create_info_struct(png_);
    if (!info_) throw std::bad_alloc();
    png_set_read_fn(png_, this, take);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  bool read(std::span<std::array<uint8_t, 4>> pixels) {
    if (setjmp(png_jmpbuf(png_))) return false;
    // Checksums are not checked: a JPEG has none either. Chunks that do not affect codes are skipped.
    png_set_crc_action(png_, PNG_CRC_QUIET_USE, PNG_CRC_QUIET_USE);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_chunk_malloc_max(png_, most_chunk_bytes);
    png_read_info(png_, info_);
    png_set_expand(png_);
    png_set_strip_16(png_);
    png_set_gray_to_rgb(png_);
    png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);
    const int passes = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);

    const size_t width = png_get_image_width(png_, info_), height = png_get_image_height(png_, info_);
    if (width * height != pixels.size() || png_get_rowbytes(png_, info_) != 4 * width)
      png_error(png_, "its size differs from that in its header");
    for (int pass = 0; pass < passes; ++pass)
      for (size_t row = 0; row < height; ++row) png_read_row(png_, pixels[row * width].data(), nullptr);
    png_read_end(png_, nullptr);
    return true;
  }

  const char* fault() const { return fault_; }

 private:
  static void take(png_structp png, png_bytep to, size_t count) {
    auto& reader = *static_cast<PngReader*>(png_get_io_ptr(png));
    if (count > reader.bytes_.size()) png_error(png, "it ends early");
    std::memcpy(to, reader.bytes_.data(), count);
    reader.bytes_ = reader.bytes_.subspan(count);
  }
  [[noreturn]] static void fail(png_structp png, png_const_charp why) {
    auto& reader = *static_cast<PngReader*>(png_get_error_ptr(png));
    std::strncpy(reader.fault_, why, sizeof reader.fault_ - 1);
    png_longjmp(png, 1);
  }
  static void ignore(png_structp, png_const_charp) {}

  std::span<const std::byte> bytes_;
  char fault_[200] = {};
  png_structp png_;
  png_infop info_ = nullptr;
};

}  // namespace

std::string read_png_rows(std::span<const std::byte> bytes, std::span<std::array<uint8_t, 4>> pixels) {
  PngReader reader(bytes);
  return reader.read(pixels) ? "" : reader.fault();
}

}  // namespace eyeray::engine::image
