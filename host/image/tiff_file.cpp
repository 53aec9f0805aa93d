#include "host/image/tiff_file.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "host/image/tiff_rows.hpp"

namespace eyeray::engine::image {

namespace {

// The most memory that libtiff may take at once: a strip or tile, or the list of all their positions.
constexpr tmsize_t most_tiff_bytes = tmsize_t{1} << 28;

}  // namespace

TiffFile::TiffFile(std::string_view bytes) : bytes_(bytes) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                 TIFFOpenOptionsFree);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), most_tiff_bytes);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), take_error, this);
  // A warning is of a fault that libtiff mends. Returning 1 keeps it from stderr.
  TIFFOpenOptionsSetWarningHandlerExtR(
      options.get(), [](TIFF*, void*, const char*, const char*, va_list) { return 1; }, nullptr);
  const auto write_nothing = [](thandle_t, void*, tmsize_t) { return tmsize_t{0}; };
  const auto close_nothing = [](thandle_t) { return 0; };
  const auto unmap_nothing = [](thandle_t, void*, toff_t) {};
  tiff_.reset(TIFFClientOpenExt("", "r", this, read, write_nothing, seek, close_nothing, size, map,
                                unmap_nothing, options.get()));
}

tmsize_t TiffFile::read(thandle_t self, void* to, tmsize_t size) {
  auto& file = *static_cast<TiffFile*>(self);
  if (file.at_ >= file.bytes_.size() || size <= 0) return 0;
  const size_t count = std::min(size_t(size), file.bytes_.size() - size_t(file.at_));
  std::memcpy(to, file.bytes_.data() + file.at_, count);
  file.at_ += count;
  return tmsize_t(count);
}

toff_t TiffFile::seek(thandle_t self, toff_t offset, int from) {
  auto& file = *static_cast<TiffFile*>(self);
  const toff_t start = from == SEEK_CUR ? file.at_ : (from == SEEK_END ? file.bytes_.size() : 0);
  return file.at_ = start + offset;
}

toff_t TiffFile::size(thandle_t self) {
  return static_cast<TiffFile*>(self)->bytes_.size();
}

int TiffFile::map(thandle_t self, void** base, toff_t* size) {
  const std::string_view bytes = static_cast<TiffFile*>(self)->bytes_;
  *base = const_cast<char*>(bytes.data());  // libtiff only reads it
  *size = bytes.size();
  return 1;
}

int TiffFile::take_error(TIFF*, void* self, const char*, const char* format, va_list values) {
  std::string& fault = static_cast<TiffFile*>(self)->fault_;
  char message[256];
  std::vsnprintf(message, sizeof message, format, values);
  if (fault.empty()) fault = message;
  while (fault.ends_with('.')) fault.pop_back();
  return 1;
}

}  // namespace eyeray::engine::image
