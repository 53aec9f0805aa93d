// Numbers that a kernel loads from a buffer instead of having them in its text, so that other numbers need no
// other kernel.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace eyeray::engine::expression {

class LoadedNumbers {
 public:
  // Adds a number, and returns GLSL that loads it from `uint formula_numbers[]`. A number is added
  // again for each use, so that the text does not show which numbers are equal.
  std::string add_uint(uint32_t value) {
    words_.push_back(value);
    return "formula_numbers[" + std::to_string(words_.size() - 1) + "]";
  }
  std::string add_float(uint32_t bits) { return "uintBitsToFloat(" + add_uint(bits) + ")"; }
  std::string add_float(float value) { return add_float(__builtin_bit_cast(uint32_t, value)); }

  // The buffer's contents.
  const std::vector<uint32_t>& words() const { return words_; }

 private:
  std::vector<uint32_t> words_;
};

}  // namespace eyeray::engine::expression
