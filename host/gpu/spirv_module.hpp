// A SPIR-V module as instructions and blocks, to be changed and written again.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <spirv/unified1/spirv.hpp>
#include <vector>

namespace eyeray::engine::gpu {

using SpirvInstruction = std::vector<uint32_t>;  // the first word holds opcode and length

inline spv::Op opcode_of(const SpirvInstruction& instruction) {
  return spv::Op(instruction[0] & spv::OpCodeMask);
}

inline SpirvInstruction spirv_instruction(spv::Op opcode, std::initializer_list<uint32_t> operands) {
  SpirvInstruction instruction{uint32_t(operands.size() + 1) << spv::WordCountShift | uint32_t(opcode)};
  instruction.insert(instruction.end(), operands);
  return instruction;
}

struct SpirvBlock {
  uint32_t label;
  std::vector<SpirvInstruction> body;  // the last is the terminator
};

struct SpirvFunction {
  std::vector<SpirvInstruction> head;  // OpFunction and its parameters
  std::vector<SpirvBlock> blocks;
};

struct SpirvModule {
  std::vector<uint32_t> header;
  std::vector<SpirvInstruction> declarations;  // all before the first function
  std::vector<SpirvFunction> functions;

  // Returns an unused id.
  uint32_t new_id() { return header[3]++; }
};

// Error (bad_input) for words that are not SPIR-V.
SpirvModule read_spirv(std::span<const uint32_t> spirv);

std::vector<uint32_t> write_spirv(const SpirvModule& module);

}  // namespace eyeray::engine::gpu
