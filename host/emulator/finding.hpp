// Findings of the emulator: acts of a kernel that Vulkan leaves undefined.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace eyeray::engine::emulator {

enum class Fault : uint8_t {
  out_of_bounds,      // an access outside of a variable or buffer
  uninitialised,      // a value that was never set decides a branch, an index or a stored number
  race,               // two invocations access a word, one of them writes, and nothing orders the two
  divergent_barrier,  // not all invocations of the work group come to a barrier
  undefined_integer,  // division by 0, shift by 32 or more, conversion of a float beyond the integer's range
  unreachable,        // an invocation comes to OpUnreachable
  not_a_number,       // an operation on numbers gives NaN, which reaches a buffer or an image
};

// "out of bounds".
const char* name(Fault fault);

// The first of its kind at its location.
struct Finding {
  Fault fault = Fault::out_of_bounds;
  std::string kernel{};
  std::string location{};                // "blur.comp:12:5 (OpLoad %17)"
  std::array<uint32_t, 3> invocation{};  // gl_GlobalInvocationID
  std::string detail{};                  // "index 12 of 8 in 'destination'"
  uint64_t count = 0;
};

// "blur.comp:12:5 (OpLoad %17): out of bounds: index 12 of 8 in 'destination', in invocation 3, 0, 0 of
// kernel 'blur'; 4 times"
std::string describe(const Finding& finding);

constexpr size_t most_findings = 1000;

class Findings {
 public:
  // Counts a finding that is known by its kernel, location and fault. A count of 0 is one. The first
  // `most_findings` are kept.
  void add(Finding finding);
  std::vector<Finding> all() const;

 private:
  std::map<std::tuple<std::string, std::string, Fault>, Finding> findings_;
};

}  // namespace eyeray::engine::emulator
