// A SPIR-V module as instructions and blocks, to be changed and written again.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <spirv/unified1/spirv.hpp>
#include <vector>

namespace eyeray::engine::spirv {

using Instruction = std::vector<uint32_t>;  // the first word holds opcode and length

inline spv::Op opcode_of(const Instruction& instruction) {
  return spv::Op(instruction[0] & spv::OpCodeMask);
}

inline Instruction instruction(spv::Op opcode, std::initializer_list<uint32_t> operands) {
  Instruction instruction{uint32_t(operands.size() + 1) << spv::WordCountShift | uint32_t(opcode)};
  instruction.insert(instruction.end(), operands);
  return instruction;
}

struct Block {
  uint32_t label;
  std::vector<Instruction> body;  // the last is the terminator
};

struct Function {
  std::vector<Instruction> head;  // OpFunction and its parameters
  std::vector<Block> blocks;
};

struct Module {
  std::vector<uint32_t> header;
  std::vector<Instruction> declarations;  // all before the first function
  std::vector<Function> functions;

  // Returns an unused id.
  uint32_t new_id() { return header[3]++; }
};

// Error (bad_input) for words that are not SPIR-V.
Module read(std::span<const uint32_t> spirv);

std::vector<uint32_t> write(const Module& module);

}  // namespace eyeray::engine::spirv
