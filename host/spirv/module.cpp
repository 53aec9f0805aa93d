#include "host/spirv/module.hpp"

#include "host/spirv/words.hpp"

namespace eyeray::engine::spirv {

Module read(std::span<const uint32_t> spirv) {
  Module module;
  bool ended = true;  // whether the last function has ended
  for_each_instruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> words) {
    Instruction instruction(words.begin(), words.end());
    if (opcode == spv::OpFunction) {
      module.functions.emplace_back();
      ended = false;
    }
    if (opcode == spv::OpFunctionEnd) {
      ended = true;
    } else if (ended) {
      module.declarations.push_back(std::move(instruction));
    } else if (Function& function = module.functions.back(); opcode == spv::OpLabel) {
      function.blocks.push_back({instruction[1], {}});
    } else {
      auto& list = function.blocks.empty() ? function.head : function.blocks.back().body;
      list.push_back(std::move(instruction));
    }
  });
  module.header.assign(spirv.begin(), spirv.begin() + header_words);
  return module;
}

std::vector<uint32_t> write(const Module& module) {
  std::vector<uint32_t> words = module.header;
  const auto append = [&](const std::vector<Instruction>& instructions) {
    for (const Instruction& i : instructions) words.insert(words.end(), i.begin(), i.end());
  };
  append(module.declarations);
  for (const Function& function : module.functions) {
    append(function.head);
    for (const Block& block : function.blocks) {
      append({instruction(spv::OpLabel, {block.label})});
      append(block.body);
    }
    append({instruction(spv::OpFunctionEnd, {})});
  }
  return words;
}

}  // namespace eyeray::engine::spirv
