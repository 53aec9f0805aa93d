#include "host/formula/folding.hpp"

#include <algorithm>
#include <set>
#include <span>

#include "host/formula/lowering.hpp"
#include "host/formula/machine.hpp"

namespace eyeray::engine::formula {

namespace {

bool is_access(spv::Op op) {
  return op == spv::OpAccessChain || op == spv::OpInBoundsAccessChain;
}

// True if the instruction does nothing but compute a result from its operands.
bool computes(const Instruction& instruction) {
  switch (instruction.op) {
    case spv::OpVariable:
    case spv::OpLoad:
    case spv::OpAccessChain:
    case spv::OpInBoundsAccessChain:
    case spv::OpFunctionCall:
    case spv::OpPhi:
    case spv::OpUndef:
      return false;
    default:
      return instruction.type != 0 && instruction.result != 0;
  }
}

// The words of the instruction that are ids of values.
std::span<const uint32_t> operands(const Instruction& instruction) {
  const std::span<const uint32_t> words = instruction.words;
  switch (instruction.op) {
    case spv::OpExtInst:
      return words.subspan(2);
    case spv::OpCompositeExtract:
      return words.first(1);
    case spv::OpCompositeInsert:
    case spv::OpVectorShuffle:
      return words.first(2);
    default:
      return words;
  }
}

class Folding {
 public:
  explicit Folding(Module& module) : module_(module) {}

  void run() {
    for (const Instruction& global : module_.constants)
      if (global.op == spv::OpVariable && global.words[0] == uint32_t(spv::StorageClassPrivate))
        module_.held[global.result] = global.words.size() > 1
                                          ? global.words[1]
                                          : module_.new_zero(module_.type(global.type).members[0]);
    const Function* main = module_.named("main");
    CHECK(main);
    initialise(*main);
    for (Function& function : module_.functions)
      if (&function != main) fold(function);
  }

 private:
  // Follows main, which begins with the initial values of global variables, as far as constants decide its
  // branches. Initial values may branch, as ?: does, but have no loops.
  void initialise(const Function& main) {
    uint32_t label = main.blocks[0].label, from = 0;
    for (;;) {
      const Block& block = main.blocks[main.block_of.at(label)];
      for (const Instruction& instruction : block.instructions) {
        if (instruction.op == spv::OpPhi) {
          for (size_t k = 0; k + 1 < instruction.words.size(); k += 2)
            if (instruction.words[k + 1] == from && module_.is_constant(instruction.words[k]))
              module_.define_constant(instruction.result, module_.constant_bits(instruction.words[k]));
        } else if (instruction.op == spv::OpStore && module_.is_constant(instruction.words[1])) {
          module_.held[instruction.words[0]] = instruction.words[1];
        } else {
          replace(instruction);
        }
      }
      from = label;
      const Instruction& last = block.instructions.back();
      if (last.op == spv::OpBranch)
        label = last.words[0];
      else if (last.op == spv::OpBranchConditional && module_.is_constant(last.words[0]))
        label = last.words[module_.constant_bits(last.words[0])[0] ? 1 : 2];
      else
        return;
    }
  }

  void fold(Function& function) {
    const std::set<uint32_t> once = stored_once(function);
    for (Block& block : function.blocks) {
      std::vector<Instruction> rest;
      for (Instruction& instruction : block.instructions) {
        if (instruction.op == spv::OpStore && once.contains(instruction.words[0]) &&
            module_.is_constant(instruction.words[1]))
          module_.held[instruction.words[0]] = instruction.words[1];
        if (!replace(instruction)) rest.push_back(std::move(instruction));
      }
      block.instructions = std::move(rest);
    }
  }

  // The function's variables that exactly one instruction writes to, by a store of the whole variable.
  std::set<uint32_t> stored_once(const Function& function) const {
    std::set<uint32_t> own, once, others;
    std::map<uint32_t, uint32_t> variable_of;  // the variable that a part belongs to
    const auto write = [&](uint32_t id, bool all_of_it) {
      if (!all_of_it || !own.contains(id) || !once.insert(id).second) others.insert(id);
    };
    for (const Block& block : function.blocks) {
      for (const Instruction& instruction : block.instructions) {
        const std::vector<uint32_t>& words = instruction.words;
        if (instruction.op == spv::OpVariable) {
          own.insert(instruction.result);
          if (words.size() > 1) others.insert(instruction.result);
        } else if (is_access(instruction.op)) {
          const auto whole = variable_of.find(words[0]);
          variable_of[instruction.result] = whole == variable_of.end() ? words[0] : whole->second;
        } else if (instruction.op == spv::OpStore) {
          const auto whole = variable_of.find(words[0]);
          write(whole == variable_of.end() ? words[0] : whole->second, whole == variable_of.end());
        } else if (instruction.op == spv::OpFunctionCall) {
          for (const uint32_t id : std::span(words).subspan(1)) write(id, false);
        }
      }
    }
    std::erase_if(once, [&](uint32_t id) { return others.contains(id); });
    return once;
  }

  // True if the instruction can be dropped, since its result is now a constant or a position in one.
  bool replace(const Instruction& instruction) {
    if (is_access(instruction.op)) {
      return find_part(instruction);
    } else if (instruction.op == spv::OpLoad) {
      const auto found = parts_.find(instruction.words[0]);
      const Part part = found == parts_.end() ? Part{instruction.words[0], 0} : found->second;
      const auto variable = module_.held.find(part.variable);
      if (variable == module_.held.end()) return false;
      const std::vector<uint32_t>& bits = module_.constant_bits(variable->second);
      const auto first = bits.begin() + part.offset;
      module_.define_constant(instruction.result, {first, first + module_.type(instruction.type).size});
      return true;
    } else if (computes(instruction) && std::ranges::all_of(operands(instruction), [&](uint32_t id) {
                 return module_.is_constant(id);
               })) {
      module_.define_constant(instruction.result, Machine(lower(module_, instruction), 0).bits());
      return true;
    }
    return false;
  }

  // Records the part of a known variable that an access with constant indices selects; else returns false.
  // Indices are clamped into their arrays, as in the program (ir.hpp).
  bool find_part(const Instruction& instruction) {
    const std::vector<uint32_t>& words = instruction.words;
    const auto outer = parts_.find(words[0]);
    Part part = outer == parts_.end() ? Part{words[0], 0} : outer->second;
    if (!module_.held.contains(part.variable)) return false;
    const Type* type = &module_.type(module_.type_of(words[0]).members[0]);
    for (const uint32_t word : std::span(words).subspan(1)) {
      const auto index = module_.constant(word);
      if (!index) return false;
      const Type& element = module_.type(type->members[0]);
      const auto last = int64_t(type->members.size()) - 1;
      part.offset += uint32_t(std::clamp<int64_t>(int32_t(*index), 0, last)) * element.size;
      type = &element;
    }
    parts_[instruction.result] = part;
    return true;
  }

  // A part of a variable that constant indices select.
  struct Part {
    uint32_t variable;
    uint32_t offset;
  };

  Module& module_;
  std::map<uint32_t, Part> parts_;  // by the id of the pointer
};

}  // namespace

void fold(Module& module) {
  Folding(module).run();
}

}  // namespace eyeray::engine::formula
