// Locations of instructions in a kernel. Private to this layer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace eyeray::engine::emulator {

struct Location {
  uint32_t opcode = 0;
  uint32_t id = 0;                // the result; 0 if the instruction has none
  uint32_t file = 0;              // index
  uint32_t line = 0, column = 0;  // from 1; 0 if the SPIR-V has no lines
};

// "blur.comp:12:5 (OpFAdd %17)", or the instruction alone.
std::string describe(const Location& location, const std::vector<std::string>& files);

}  // namespace eyeray::engine::emulator
