// The checks that loads, stores, atomics and texels share. Private to this layer.
#pragma once

#include "host/emulator/bits.hpp"
#include "host/emulator/group.hpp"

namespace eyeray::engine::emulator {

// Reports an access by the pointer o.from[0], whose root has this size: "index 12 of 8 in 'Data'".
void report_outside(Group& group, const Operation& o, uint32_t lane, uint64_t size);

// "texel 12, 3 of 8, 8 in 'picture'".
void report_outside(Group& group, const Operation& o, uint32_t lane, const std::string& what);

// Notes an access to these bytes of memory that invocations share, and reports a race. The bytes count from
// the start of the buffer or image, or of the work group's memory.
void note(Group& group, const Operation& o, uint32_t lane, size_t byte, uint32_t size, bool writes,
          bool atomic);

// A word of a value that leaves the kernel. Reports the birth of a NaN, which it then no longer carries.
inline uint32_t leave(Group& group, const Operation& o, uint32_t lane, uint32_t word, uint32_t real_bits) {
  if (real_bits == 0) return word;
  const uint32_t birth = birth_of(word, real_bits);
  if (birth == 0) return word;
  group.report_birth(o, lane, birth);
  return without_birth(word, real_bits);
}

}  // namespace eyeray::engine::emulator
