// Reads the numbers of a PLY file, one after the other. Private to the importers.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>

#include "host/importers/malformed.hpp"
#include "host/importers/ply_header.hpp"
#include "host/importers/text_number.hpp"

namespace eyeray::engine::importers {

class AsciiValues {
 public:
  // A NUL must follow `bytes`, as it follows those of a string.
  AsciiValues(std::string_view bytes, size_t begin, const std::string& file)
      : bytes_(bytes), at_(begin), file_(file) {}

  double next(PlyType) { return take_number(bytes_, at_, file_); }

  void skip(PlyType type, uint64_t count) {
    for (uint64_t i = 0; i < count; ++i) next(type);
  }

  // The most values that the rest of the file can contain.
  uint64_t room(PlyType) const { return (bytes_.size() - at_ + 1) / 2; }

  [[noreturn]] void fail(const std::string& message) const {
    throw malformed_at(file_, bytes_, at_, message);
  }

 private:
  std::string_view bytes_;
  size_t at_;
  const std::string& file_;
};

template <std::endian order>
class BinaryValues {
 public:
  BinaryValues(std::string_view bytes, size_t begin, const std::string& file)
      : bytes_(bytes), at_(begin), file_(file) {}

  double next(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return take<int8_t>();
      case PlyType::uint8:
        return take<uint8_t>();
      case PlyType::int16:
        return take<int16_t>();
      case PlyType::uint16:
        return take<uint16_t>();
      case PlyType::int32:
        return take<int32_t>();
      case PlyType::uint32:
        return take<uint32_t>();
      case PlyType::float32:
        return static_cast<double>(take<float>());
      case PlyType::float64:
        return take<double>();
    }
    return 0;
  }

  void skip(PlyType type, uint64_t count) {
    if (count > room(type)) fail("the file ends too early");
    at_ += count * size_of(type);
  }

  uint64_t room(PlyType type) const { return (bytes_.size() - at_) / size_of(type); }

  [[noreturn]] void fail(const std::string& message) const { throw malformed(file_, message); }

 private:
  template <typename T>
  T take() {
    if (bytes_.size() - at_ < sizeof(T)) fail("the file ends too early");
    char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + at_, sizeof(T));
    if constexpr (order != std::endian::native) std::reverse(raw, raw + sizeof(T));
    at_ += sizeof(T);
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  std::string_view bytes_;
  size_t at_;
  const std::string& file_;
};

}  // namespace eyeray::engine::importers
