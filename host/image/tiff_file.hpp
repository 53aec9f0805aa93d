// A TIFF in memory, opened by libtiff, whose messages become the fault of a read. Private to
// tiff_decoder.cpp.
#pragma once

#include <tiffio.h>

#include <memory>
#include <string>
#include <string_view>

namespace eyeray::engine::image {

class TiffFile {
 public:
  // `bytes` must outlive the file.
  explicit TiffFile(std::string_view bytes);
  TiffFile(const TiffFile&) = delete;
  TiffFile& operator=(const TiffFile&) = delete;

  // Null if the file has no readable first page.
  TIFF* get() const { return tiff_.get(); }
  // libtiff's first error, or "".
  const std::string& fault() const { return fault_; }

  // A field's value, or its default by the specification, or 0.
  template <typename Value>
  Value field(uint32_t tag) const {
    Value value{};
    return TIFFGetFieldDefaulted(get(), tag, &value) ? value : Value{};
  }

 private:
  struct Close {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
  };

  static tmsize_t read(thandle_t self, void* to, tmsize_t size);
  static toff_t seek(thandle_t self, toff_t offset, int from);
  static toff_t size(thandle_t self);
  static int map(thandle_t self, void** base, toff_t* size);
  static int take_error(TIFF*, void* self, const char* module, const char* format, va_list values);

  std::string_view bytes_;
  toff_t at_ = 0;
  std::string fault_;
  std::unique_ptr<TIFF, Close> tiff_;  // the last member: libtiff uses the others until it is closed
};

}  // namespace eyeray::engine::image
