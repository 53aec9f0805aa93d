#define SPV_ENABLE_UTILITY_CODE
#include "derive/module.hpp"

#include "gpu/spirv.hpp"

namespace eyeray::derive {

uint32_t Type::member_offset(const std::map<uint32_t, Type>& types, uint32_t index) const {
  uint32_t offset = 0;
  for (uint32_t i = 0; i < index; ++i) offset += types.at(members[i]).size;
  return offset;
}

void Module::read_type(spv::Op op, std::span<const uint32_t> words) {
  Type& type = types[words[1]];
  type.op = op;
  switch (op) {
    case spv::OpTypeBool:
    case spv::OpTypeFloat:
      type.size = 1;
      break;
    case spv::OpTypeInt:
      type.size = 1;
      type.is_signed = words[3] != 0;
      break;
    case spv::OpTypeVector:
    case spv::OpTypeMatrix:
      type.members.assign(words[3], words[2]);
      break;
    case spv::OpTypeArray:
      type.members.assign(lengths_.at(words[3]), words[2]);
      break;
    case spv::OpTypeStruct:
      type.members.assign(words.begin() + 2, words.end());
      break;
    case spv::OpTypePointer:
      type.members = {words[3]};
      return;
    default:
      return;
  }
  for (const uint32_t member : type.members) type.size += types.at(member).size;
}

Module::Module(std::span<const uint32_t> spirv) {
  std::map<uint32_t, std::string> strings;
  SourcePosition where;
  Function* function = nullptr;

  gpu::for_each_instruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> words) {
    const auto op = spv::Op(opcode);
    bool has_result = false, has_type = false;
    spv::HasResultAndType(op, &has_result, &has_type);
    Instruction instruction{.op = op, .where = where};
    size_t at = 1;
    if (has_type) instruction.type = words[at++];
    if (has_result) instruction.result = words[at++];
    if (has_type) value_types_[instruction.result] = instruction.type;
    instruction.words.assign(words.begin() + ptrdiff_t(at), words.end());

    switch (op) {
      case spv::OpString:
        strings[words[1]] = gpu::spirv_string(words, 2);
        return;
      case spv::OpLine:
        where = {strings[words[1]], int(words[2]), 0};
        return;
      case spv::OpNoLine:
        return;
      case spv::OpEntryPoint:
        entry = words[2];
        return;
      case spv::OpFunction:
        function = &functions[words[2]];
        return;
      case spv::OpFunctionParameter:
        function->parameters.push_back(words[2]);
        return;
      case spv::OpFunctionEnd:
        function = nullptr;
        return;
      case spv::OpLabel:
        function->block_of[words[1]] = function->blocks.size();
        function->blocks.push_back({.label = words[1]});
        return;
      case spv::OpLoopMerge:
        function->blocks.back().merge = words[1];
        return;
      case spv::OpSelectionMerge:
        return;
      default:
        break;
    }
    if (function) {
      function->blocks.back().instructions.push_back(std::move(instruction));
    } else if (has_type) {
      if (op == spv::OpConstant) lengths_[instruction.result] = instruction.words[0];
      constants.push_back(std::move(instruction));
    } else if (has_result) {
      read_type(op, words);
    }
  });
}

}  // namespace eyeray::derive
