// The comparison of a buffer of a kernel that a user brings (docs/kernel-files.md).
#pragma once

#include <cstdint>
#include <string>

namespace eyeray::engine::compare {

struct BufferResult {
  char gate = 'A';           // A: two executors; S: two orders; G: a file; K: another kernel
  std::string value, other;  // their names
  std::string buffer;
  uint64_t numbers = 0;
  uint64_t different = 0;      // numbers that differ in their bits; NaNs of all bits are equal
  uint64_t beyond = 0;         // numbers that differ by more than is allowed
  uint64_t largest = 0;        // the largest distance of reals, in units in the last place
  uint64_t ulp = 0;            // the allowed distance
  double absolute = 0;         // the allowed difference
  std::string first{};         // the first number beyond: ".data[3]: 0.5 against 0.25, 8388608 ULP"
  std::string incomparable{};  // why nothing was compared; empty if everything was

  bool passes() const { return beyond == 0 && incomparable.empty(); }
};

// "gate A passed gpu = emulator, Target: 0 of 4096 numbers differ".
std::string to_text(const BufferResult& result);
// The failure as a sentence; the result must fail.
std::string failure_of(const BufferResult& result);

}  // namespace eyeray::engine::compare
