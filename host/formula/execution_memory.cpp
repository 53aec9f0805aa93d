// Runs the instructions that move numbers, and those that end a block.
#include <algorithm>

#include "host/formula/execution.hpp"

namespace eyeray::engine::formula {

bool Execution::run_memory(Call& call, const Instruction& instruction) {
  const std::vector<uint32_t>& words = instruction.words;
  switch (instruction.op) {
    case spv::OpVariable: {
      const uint32_t variable = new_variable(module_.type(module_.type(instruction.type).members[0]));
      if (words.size() > 1) memory_[variable] = value(call, words[1]);
      call.pointers[instruction.result] = {variable, 0};
      return true;
    }
    case spv::OpAccessChain:
    case spv::OpInBoundsAccessChain: {
      Pointer at = pointer(call, words[0]);
      const Type* type = &module_.type(module_.type_of(words[0]).members[0]);
      for (size_t i = 1; i < words.size(); ++i) {
        const uint32_t member = index(call, words[i], instruction);
        if (member >= type->members.size())
          refuse(instruction, "an array's or vector's index is out of its bounds");
        at.offset += type->member_offset(module_.types, member);
        type = &module_.type(type->members[member]);
      }
      call.pointers[instruction.result] = at;
      return true;
    }
    case spv::OpLoad: {
      const Pointer& at = pointer(call, words[0]);
      const Value& variable = memory_.at(at.variable);
      const auto first = variable.begin() + at.offset;
      call.values[instruction.result] = Value(first, first + module_.type(instruction.type).size);
      return true;
    }
    case spv::OpStore: {
      const Pointer& at = pointer(call, words[0]);
      const Value& stored = value(call, words[1]);
      std::copy(stored.begin(), stored.end(), memory_.at(at.variable).begin() + at.offset);
      return true;
    }
    case spv::OpFunctionCall: {
      const uint32_t block = call.block;
      call.values[instruction.result] =
          this->call(module_.function(words[0]), {words.begin() + 1, words.end()}, call);
      call.block = block;
      return true;
    }
    default:
      return false;
  }
}

bool Execution::run_composite(Call& call, const Instruction& instruction) {
  const std::vector<uint32_t>& words = instruction.words;
  // Follows the literal indices from words[first] on to a member. Returns the index of its first number, and
  // its count of numbers.
  const auto range_of = [&](const Type& whole, size_t first) {
    const Type* type = &whole;
    uint32_t offset = 0;
    for (size_t i = first; i < words.size(); ++i) {
      offset += type->member_offset(module_.types, words[i]);
      type = &module_.type(type->members[words[i]]);
    }
    return std::pair(offset, type->size);
  };
  Value result;
  switch (instruction.op) {
    case spv::OpCompositeConstruct:
      for (const uint32_t id : words) {
        const Value& part = value(call, id);
        result.insert(result.end(), part.begin(), part.end());
      }
      break;
    case spv::OpVectorShuffle: {
      const Value& a = value(call, words[0]);
      const Value& b = value(call, words[1]);
      for (size_t i = 2; i < words.size(); ++i)
        result.push_back(words[i] < a.size()              ? a[words[i]]
                         : words[i] - a.size() < b.size() ? b[words[i] - a.size()]
                                                          : a[0]);
      break;
    }
    case spv::OpCompositeExtract: {
      const Value& whole = value(call, words[0]);
      const auto [first, count] = range_of(module_.type_of(words[0]), 1);
      result.assign(whole.begin() + first, whole.begin() + first + count);
      break;
    }
    case spv::OpCompositeInsert: {
      result = value(call, words[1]);
      const Value& part = value(call, words[0]);
      std::copy(part.begin(), part.end(), result.begin() + range_of(module_.type(instruction.type), 2).first);
      break;
    }
    case spv::OpVectorExtractDynamic: {
      const Value& whole = value(call, words[0]);
      const uint32_t i = index(call, words[1], instruction);
      if (i >= whole.size()) refuse(instruction, "an array's or vector's index is out of its bounds");
      result = {whole[i]};
      break;
    }
    case spv::OpCopyObject:
      result = value(call, words[0]);
      break;
    case spv::OpUndef:
      result.assign(module_.type(instruction.type).size, expression_.constant(0));
      break;
    case spv::OpPhi: {
      // The words are pairs, one for each way: a value, and the block from which the way comes.
      const auto coming_from = [&](uint32_t block) -> const Value& {
        for (size_t i = 0; i + 1 < words.size(); i += 2)
          if (words[i + 1] == block) return value(call, words[i]);
        refuse(instruction, "a value is used where it is not defined");
      };
      result = coming_from(call.from.back());
      for (size_t i = call.from.size() - 1; i-- > 0;)
        result = choose(call.conditions[i], coming_from(call.from[i]), result);
      break;
    }
    default:
      return false;
  }
  call.values[instruction.result] = result;
  return true;
}

bool Execution::run_branch(Call& call, const Instruction& instruction) {
  const std::vector<uint32_t>& words = instruction.words;
  const auto under = [&](Term condition) { return expression_.apply(Op::both, call.condition, condition); };
  switch (instruction.op) {
    case spv::OpBranch:
      go(call, words[0], call.condition);
      return true;
    case spv::OpBranchConditional: {
      const Term condition = value(call, words[0])[0];
      go(call, words[1], under(condition));
      go(call, words[2], under(expression_.apply(Op::opposite, condition)));
      return true;
    }
    case spv::OpSwitch: {
      const Term selector = value(call, words[0])[0];
      Term other = expression_.truth(true);
      for (size_t i = 2; i + 1 < words.size(); i += 2) {
        const Term equal =
            expression_.apply(Op::equal, selector, expression_.constant(double(int32_t(words[i]))));
        go(call, words[i + 1], under(equal));
        other = expression_.apply(Op::both, other, expression_.apply(Op::opposite, equal));
      }
      go(call, words[1], under(other));
      return true;
    }
    case spv::OpReturn:
      call.returns.push_back({call.block, call.condition, memory_, {}});
      return true;
    case spv::OpReturnValue:
      call.returns.push_back({call.block, call.condition, memory_, value(call, words[0])});
      return true;
    case spv::OpUnreachable:
      return true;
    case spv::OpKill:
    case spv::OpTerminateInvocation:
      refuse(instruction, "discard has no meaning here");
    default:
      return false;
  }
}

}  // namespace eyeray::engine::formula
