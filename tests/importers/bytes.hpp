// Binary files, written number by number.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

namespace eyeray::engine::test {

class Bytes {
 public:
  explicit Bytes(std::endian order = std::endian::little) : order_(order) {}

  template <typename T>
  Bytes& add(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (order_ != std::endian::native) std::reverse(raw, raw + sizeof(T));
    text_.append(raw, sizeof(T));
    return *this;
  }
  // The value as a number of one of PLY's and glTF's types.
  Bytes& add_as(const std::string& type, double value) {
    if (type == "char" || type == "int8") return add(int8_t(value));
    if (type == "uchar" || type == "uint8") return add(uint8_t(value));
    if (type == "short" || type == "int16") return add(int16_t(value));
    if (type == "ushort" || type == "uint16") return add(uint16_t(value));
    if (type == "int" || type == "int32") return add(int32_t(value));
    if (type == "uint" || type == "uint32") return add(uint32_t(value));
    if (type == "float" || type == "float32") return add(float(value));
    return add(value);
  }
  const std::string& text() const { return text_; }

 private:
  std::endian order_;
  std::string text_;
};

}  // namespace eyeray::engine::test
