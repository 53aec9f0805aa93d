#include "host/gpu/spirv_module.hpp"

#include "host/gpu/spirv.hpp"

namespace eyeray::engine::gpu {

SpirvModule read_spirv(std::span<const uint32_t> spirv) {
  SpirvModule module;
  bool ended = true;  // whether the last function has ended
  for_each_instruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> words) {
    SpirvInstruction instruction(words.begin(), words.end());
    if (opcode == spv::OpFunction) {
      module.functions.emplace_back();
      ended = false;
    }
    if (opcode == spv::OpFunctionEnd) {
      ended = true;
    } else if (ended) {
      module.declarations.push_back(std::move(instruction));
    } else if (SpirvFunction& function = module.functions.back(); opcode == spv::OpLabel) {
      function.blocks.push_back({instruction[1], {}});
    } else {
      auto& list = function.blocks.empty() ? function.head : function.blocks.back().body;
      list.push_back(std::move(instruction));
    }
  });
  module.header.assign(spirv.begin(), spirv.begin() + spirv_header_words);
  return module;
}

std::vector<uint32_t> write_spirv(const SpirvModule& module) {
  std::vector<uint32_t> words = module.header;
  const auto append = [&](const std::vector<SpirvInstruction>& instructions) {
    for (const SpirvInstruction& i : instructions) words.insert(words.end(), i.begin(), i.end());
  };
  append(module.declarations);
  for (const SpirvFunction& function : module.functions) {
    append(function.head);
    for (const SpirvBlock& block : function.blocks) {
      append({spirv_instruction(spv::OpLabel, {block.label})});
      append(block.body);
    }
    append({spirv_instruction(spv::OpFunctionEnd, {})});
  }
  return words;
}

}  // namespace eyeray::engine::gpu
