#include "host/gpu/selection_flattener.hpp"

#include <spirv/unified1/GLSL.std.450.h>

#include <algorithm>
#include <iterator>
#include <unordered_map>

#include "host/core/error.hpp"
#include "host/spirv/module.hpp"

namespace eyeray::engine::gpu {
namespace {

using Instruction = spirv::Instruction;
using Block = spirv::Block;

// True if a function of GLSL.std.450, the only set of functions that shaders use, takes only values. Modf
// writes through a pointer, as some of the functions after FMix do.
bool is_function_of_values(uint32_t function) {
  return function <= GLSLstd450FMix && function != GLSLstd450Modf;
}

// True if the instruction may run even if its result is not needed. An integer division, which may be by
// zero, and a load from an unknown address may not.
bool is_harmless(const Instruction& instruction) {
  const spv::Op opcode = spirv::opcode_of(instruction);
  switch (opcode) {
    case spv::OpUndef:
    case spv::OpVectorShuffle:
    case spv::OpCompositeConstruct:
    case spv::OpCompositeExtract:
    case spv::OpCompositeInsert:
    case spv::OpCopyObject:
      return true;
    case spv::OpExtInst:
      return is_function_of_values(instruction[4]);
    case spv::OpUDiv:
    case spv::OpSDiv:
    case spv::OpUMod:
    case spv::OpSRem:
    case spv::OpSMod:
      return false;
    default:
      // Conversions and OpBitcast, arithmetic, comparisons and bits.
      return (opcode >= spv::OpConvertFToU && opcode <= spv::OpFConvert) || opcode == spv::OpBitcast ||
             (opcode >= spv::OpSNegate && opcode <= spv::OpDot) ||
             (opcode >= spv::OpAny && opcode <= spv::OpFUnordGreaterThanEqual) ||
             (opcode >= spv::OpShiftRightLogical && opcode <= spv::OpBitCount);
  }
}

// The types between which OpSelect can choose, and the types of their conditions.
class Types {
 public:
  explicit Types(spirv::Module& module) : module_(module) {
    for (const Instruction& instruction : module.declarations) see(instruction);
  }

  // The number of components of a scalar or vector type; 0 for any other type.
  uint32_t components(uint32_t type) const {
    const auto found = components_.find(type);
    return found == components_.end() ? 0 : found->second;
  }

  // The condition `scalar` for so many components. Its instructions go to `before`.
  uint32_t condition(uint32_t scalar, uint32_t components, std::vector<Instruction>& before) {
    if (components == 1) return scalar;
    const uint32_t all = module_.new_id();
    Instruction construct = spirv::instruction(spv::OpCompositeConstruct, {vector_of_bool(components), all});
    construct.insert(construct.end(), components, scalar);
    construct[0] += components << spv::WordCountShift;
    before.push_back(std::move(construct));
    return all;
  }

 private:
  void see(const Instruction& instruction) {
    switch (spirv::opcode_of(instruction)) {
      case spv::OpTypeBool:
        bool_ = instruction[1];
        components_[bool_] = 1;
        break;
      case spv::OpTypeInt:
      case spv::OpTypeFloat:
        components_[instruction[1]] = 1;
        break;
      case spv::OpTypeVector:
        components_[instruction[1]] = instruction[3];
        if (instruction[2] == bool_) vectors_of_bool_[instruction[3]] = instruction[1];
        break;
      default:
        break;
    }
  }

  uint32_t vector_of_bool(uint32_t components) {
    uint32_t& type = vectors_of_bool_[components];
    if (type == 0) {
      type = module_.new_id();
      module_.declarations.push_back(spirv::instruction(spv::OpTypeVector, {type, bool_, components}));
    }
    return type;
  }

  spirv::Module& module_;
  uint32_t bool_ = 0;
  std::unordered_map<uint32_t, uint32_t> components_;
  std::unordered_map<uint32_t, uint32_t> vectors_of_bool_;
};

class Flattener {
 public:
  Flattener(std::vector<Block>& blocks, Types& types) : blocks_(blocks), types_(types) {
    for (size_t i = 0; i < blocks.size(); ++i) places_[blocks[i].label] = i;
    for (const Block& block : blocks) count(block);
  }

  void flatten() {
    for (bool changed = true; changed;) {
      changed = false;
      for (Block& block : blocks_)
        while (!block.body.empty() && flatten_at(block)) changed = true;
    }
    for (Block& block : blocks_)
      for (Instruction& instruction : block.body)
        if (spirv::opcode_of(instruction) == spv::OpPhi)
          for (size_t i = 4; i < instruction.size(); i += 2) instruction[i] = now(instruction[i]);
    std::erase_if(blocks_, [](const Block& block) { return block.body.empty(); });
  }

 private:
  void count(const Block& block) {
    const Instruction& last = block.body.back();
    switch (spirv::opcode_of(last)) {
      case spv::OpBranch:
        ++edges_[last[1]];
        break;
      case spv::OpBranchConditional:
        ++edges_[last[2]];
        ++edges_[last[3]];
        break;
      case spv::OpSwitch:
        ++edges_[last[2]];
        for (size_t i = 4; i < last.size(); i += 2) ++edges_[last[i]];
        break;
      default:
        break;
    }
    if (block.body.size() < 2) return;
    const Instruction& merge = block.body[block.body.size() - 2];
    if (spirv::opcode_of(merge) == spv::OpSelectionMerge || spirv::opcode_of(merge) == spv::OpLoopMerge)
      ++merges_[merge[1]];
    if (spirv::opcode_of(merge) == spv::OpLoopMerge) ++merges_[merge[2]];
  }

  Block& at(uint32_t label) { return blocks_[places_.at(label)]; }

  // The label of the block that now contains the instructions of the block `label`.
  uint32_t now(uint32_t label) const {
    for (auto found = joined_.find(label); found != joined_.end(); found = joined_.find(label))
      label = found->second;
    return label;
  }

  // True if the arm has only harmless instructions, and then branches to the end of the selection.
  bool is_harmless_arm(uint32_t label, uint32_t end) {
    if (label == end) return true;
    const std::vector<Instruction>& body = at(label).body;
    if (edges_[label] != 1 || merges_[label] != 0 || spirv::opcode_of(body.back()) != spv::OpBranch ||
        body.back()[1] != end)
      return false;
    return std::all_of(body.begin(), body.end() - 1, is_harmless);
  }

  // The value that a phi of two blocks has if control came from the block `label`.
  uint32_t value_from(const Instruction& phi, uint32_t label) const {
    CHECK_EQ(phi.size(), 7u);
    return now(phi[4]) == label ? phi[3] : phi[5];
  }

  // Flattens the selection that a block ends with, if it ends with one and both arms are harmless. Returns
  // true if it did.
  bool flatten_at(Block& head) {
    if (head.body.size() < 2) return false;
    const Instruction branch = head.body.back(), merge = head.body[head.body.size() - 2];
    if (spirv::opcode_of(branch) != spv::OpBranchConditional ||
        spirv::opcode_of(merge) != spv::OpSelectionMerge)
      return false;
    const uint32_t condition = branch[1], yes = branch[2], no = branch[3], end = merge[1];
    if (yes == no || edges_[end] != 2 || !is_harmless_arm(yes, end) || !is_harmless_arm(no, end))
      return false;

    // Make selects that choose the same values as the phis.
    std::vector<Instruction>& rest = at(end).body;
    const auto phis_end =
        std::ranges::find_if(rest, [](const auto& i) { return spirv::opcode_of(i) != spv::OpPhi; });
    if (std::any_of(rest.begin(), phis_end, [&](const auto& phi) { return types_.components(phi[1]) == 0; }))
      return false;
    std::vector<Instruction> chosen;
    for (auto phi = rest.begin(); phi != phis_end; ++phi) {
      const uint32_t type = (*phi)[1], result = (*phi)[2];
      const uint32_t by = types_.condition(condition, types_.components(type), chosen);
      chosen.push_back(spirv::instruction(spv::OpSelect,
                                          {type, result, by, value_from(*phi, yes == end ? head.label : yes),
                                           value_from(*phi, no == end ? head.label : no)}));
    }

    // Move into the head both arms, the selects and, if no other construct ends at `end`, the rest of that
    // block.
    head.body.resize(head.body.size() - 2);
    for (const uint32_t arm : {yes, no}) {
      if (arm == end) continue;
      std::vector<Instruction>& body = at(arm).body;
      std::move(body.begin(), body.end() - 1, std::back_inserter(head.body));
      body.clear();
    }
    std::move(chosen.begin(), chosen.end(), std::back_inserter(head.body));
    rest.erase(rest.begin(), phis_end);
    edges_[end] = 1;
    if (--merges_[end] == 0) {
      std::move(rest.begin(), rest.end(), std::back_inserter(head.body));
      rest.clear();
      joined_[end] = head.label;
    } else {
      head.body.push_back(spirv::instruction(spv::OpBranch, {end}));
    }
    return true;
  }

  std::vector<Block>& blocks_;
  Types& types_;
  std::unordered_map<uint32_t, size_t> places_;  // the index of each label's block
  std::unordered_map<uint32_t, int> edges_;      // the number of edges into each block
  std::unordered_map<uint32_t, int> merges_;  // the number of constructs that end or continue at each block
  std::unordered_map<uint32_t, uint32_t> joined_;  // the block that each merged block became a part of
};

}  // namespace

std::vector<uint32_t> flatten_selections(std::span<const uint32_t> spirv) {
  spirv::Module module = spirv::read(spirv);
  Types types(module);
  for (spirv::Function& function : module.functions) Flattener(function.blocks, types).flatten();
  return spirv::write(module);
}

}  // namespace eyeray::engine::gpu
