#include "host/emulator/block_order.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace eyeray::engine::emulator {

std::vector<uint32_t> successors(const spirv::Instruction& terminator) {
  switch (spirv::opcode_of(terminator)) {
    case spv::OpBranch:
      return {terminator[1]};
    case spv::OpBranchConditional:
      return {terminator[2], terminator[3]};
    case spv::OpSwitch: {
      std::vector<uint32_t> labels{terminator[2]};
      for (size_t i = 4; i < terminator.size(); i += 2) labels.push_back(terminator[i]);
      return labels;
    }
    default:
      return {};
  }
}

std::vector<uint32_t> structured_order(const spirv::Function& function) {
  std::map<uint32_t, std::vector<uint32_t>> next;
  for (const spirv::Block& block : function.blocks) {
    std::vector<uint32_t>& labels = next[block.label];
    if (block.body.size() > 1) {
      const spirv::Instruction& merge = block.body[block.body.size() - 2];
      if (spirv::opcode_of(merge) == spv::OpSelectionMerge) labels = {merge[1]};
      if (spirv::opcode_of(merge) == spv::OpLoopMerge) labels = {merge[1], merge[2]};
    }
    const std::vector<uint32_t> more = successors(block.body.back());
    labels.insert(labels.end(), more.begin(), more.end());
  }

  // A depth-first search without recursion, since functions may have any number of blocks.
  struct Visit {
    uint32_t label;
    size_t next = 0;
  };
  std::vector<uint32_t> order;
  std::set<uint32_t> seen{function.blocks.front().label};
  std::vector<Visit> visits{{function.blocks.front().label}};
  while (!visits.empty()) {
    Visit& visit = visits.back();
    const std::vector<uint32_t>& labels = next[visit.label];
    if (visit.next == labels.size()) {
      order.push_back(visit.label);
      visits.pop_back();
    } else if (const uint32_t label = labels[visit.next++]; seen.insert(label).second) {
      visits.push_back({label});
    }
  }
  std::ranges::reverse(order);
  return order;
}

}  // namespace eyeray::engine::emulator
