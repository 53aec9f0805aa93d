// Lowers variables, accesses to their parts, and calls.
#include <algorithm>

#include "host/formula/lowering.hpp"

namespace eyeray::engine::formula {

bool FunctionLowering::lower_memory(const Instruction& instruction, ir::Block& out) {
  const uint32_t id = instruction.result;
  switch (instruction.op) {
    case spv::OpVariable: {
      const Type& type = module_.type(module_.type(instruction.type).members[0]);
      const Accesses& accesses = accesses_[id];
      if (module_.held.contains(id)) {
        lower_constant_variable(instruction, out);
        return true;
      }
      const bool as_array = type.op == spv::OpTypeArray || accesses.is_indexed;
      pointers_[id] = {.variable = id, .slot = new_slot(type, as_array), .type = &type};
      const ir::Slot& slot = pointers_[id].slot;
      if (instruction.words.size() > 1) copy(slot, value(instruction.words[1]), out);
      // A variable read before it is written is 0.
      if (accesses.first_is_store && (accesses.first_block == 0 || accesses.blocks.size() == 1)) return true;
      if (as_array) out.push_back({ir::Instruction{.op = ir::Op::clear, .array = slot.array}});
      for (const ir::Operand number : slot.numbers) assign({number}, {constant(scalar(type), 0)}, out);
      return true;
    }
    case spv::OpAccessChain:
    case spv::OpInBoundsAccessChain:
      pointers_[id] = index(instruction, out);
      return true;
    case spv::OpLoad:
      load(instruction, out);
      return true;
    case spv::OpStore:
      store(instruction, out);
      return true;
    case spv::OpFunctionCall:
      lower_call(instruction, out);
      return true;
    default:
      return false;
  }
}

void FunctionLowering::lower_constant_variable(const Instruction& variable, ir::Block& out) {
  const Type& type = module_.type(module_.type(variable.type).members[0]);
  Pointer at{.variable = variable.result, .slot = value(module_.held.at(variable.result)), .type = &type};
  if (accesses_[variable.result].is_indexed && !at.slot.is_array) {
    const ir::Slot array = new_slot(type, true);
    copy(array, at.slot, out);
    at.slot = array;
  }
  pointers_[variable.result] = at;
}

// Indices are clamped as Vulkan's robust access does: a negative index becomes 0, one past the end the last.
FunctionLowering::Pointer FunctionLowering::index(const Instruction& instruction, ir::Block& out) {
  Pointer at = pointer(instruction.words[0]);
  for (size_t i = 1; i < instruction.words.size(); ++i) {
    const auto count = uint32_t(at.type->members.size());
    const Type& element = module_.type(at.type->members[0]);
    if (const auto known = module_.constant(instruction.words[i])) {
      const auto clamped = uint32_t(std::clamp<int64_t>(int32_t(*known), 0, int64_t(count) - 1));
      at.offset += clamped * element.size;
    } else {
      CHECK(at.slot.is_array);
      ir::Operand step =
          apply(out, ir::Op::clamp_index, value(instruction.words[i]).numbers[0], whole(count));
      if (element.size > 1) step = apply(out, ir::Op::whole_multiply, step, whole(element.size));
      at.address = at.is_dynamic ? apply(out, ir::Op::whole_add, at.address, step) : step;
      at.is_dynamic = true;
    }
    at.type = &element;
  }
  // Adds the constant offset to the address.
  if (at.is_dynamic && at.offset > 0) {
    at.address = apply(out, ir::Op::whole_add, at.address, whole(at.offset));
    at.offset = 0;
  }
  return at;
}

void FunctionLowering::load(const Instruction& instruction, ir::Block& out) {
  const Pointer& at = pointer(instruction.words[0]);
  const Type& type = module_.type(instruction.type);
  ir::Slot& result = values_[instruction.result];

  // If nothing writes to the variable until the last use of the result, the result is the variable's numbers
  // themselves.
  const Accesses& accesses = accesses_[at.variable];
  const Uses& uses = uses_[instruction.result];
  const auto writes = accesses.writes.find(block_);
  const bool outlives = uses.last >= function_.blocks[block_].instructions.size();
  const bool changes = writes != accesses.writes.end() && [&] {
    const auto next = writes->second.upper_bound(at_);
    return next != writes->second.end() && *next < uses.last;
  }();
  const bool is_kept = (!outlives && !changes) || accesses.writes.empty();

  if (!at.slot.is_array) {
    const auto first = at.slot.numbers.begin() + at.offset;
    const std::vector<ir::Operand> numbers(first, first + type.size);
    if (is_kept) {
      result.numbers = numbers;
    } else {
      result = new_slot(type, false);
      assign(result.numbers, numbers, out);
    }
  } else if (type.op == spv::OpTypeArray) {
    result = at.slot;
    if (!is_kept) {
      result = new_slot(type, true);
      copy(result, at.slot, out);
    }
  } else {
    const ir::Type scalar = this->scalar(type);
    if (type.size == 1) computed_.insert(instruction.result);
    for (uint32_t i = 0; i < type.size; ++i) {
      const ir::Operand address = !at.is_dynamic ? whole(at.offset + i)
                                  : i == 0       ? at.address
                                                 : apply(out, ir::Op::whole_add, at.address, whole(i));
      result.numbers.push_back(new_register(scalar));
      out.push_back({ir::Instruction{
          .op = ir::Op::load, .to = result.numbers.back(), .from = {address}, .array = at.slot.array}});
    }
  }
}

void FunctionLowering::store(const Instruction& instruction, ir::Block& out) {
  const Pointer& at = pointer(instruction.words[0]);
  const uint32_t id = instruction.words[1];
  if (module_.held.contains(at.variable)) return;
  if (at.slot.is_array && module_.is_zero(id) && module_.type_of(id).op == spv::OpTypeArray) {
    out.push_back({ir::Instruction{.op = ir::Op::clear, .array = at.slot.array}});
    return;
  }
  const ir::Slot& stored = value(id);
  if (!at.slot.is_array) {
    const auto first = at.slot.numbers.begin() + at.offset;
    const std::vector<ir::Operand> to(first, first + ptrdiff_t(stored.numbers.size()));
    const bool is_private = computed_.contains(id) && uses_[id].count == 1;
    if (!is_private || !retarget(to, stored.numbers, out)) assign(to, stored.numbers, out);
  } else if (stored.is_array) {
    copy(at.slot, stored, out);
  } else {
    for (uint32_t i = 0; i < stored.numbers.size(); ++i) {
      const ir::Operand address = !at.is_dynamic ? whole(at.offset + i)
                                  : i == 0       ? at.address
                                                 : apply(out, ir::Op::whole_add, at.address, whole(i));
      out.push_back({ir::Instruction{
          .op = ir::Op::store, .from = {address, stored.numbers[i]}, .array = at.slot.array}});
    }
  }
}

void FunctionLowering::lower_call(const Instruction& instruction, ir::Block& out) {
  const uint32_t number = numbers_.at(instruction.words[0]);
  const std::vector<ir::Parameter>& parameters = program_.functions[number].parameters;
  ir::Call call{number, {}, {}};
  std::vector<std::pair<ir::Slot, ir::Slot>> back;  // (to, from), copied after the call
  for (size_t i = 0; i < parameters.size(); ++i) {
    const uint32_t id = instruction.words[i + 1];
    const bool by_pointer = module_.type_of(id).op == spv::OpTypePointer;
    ir::Slot given = by_pointer ? pointer(id).slot : value(id);
    // If only one of argument and parameter is an array, a copy of the parameter's kind is passed. It is
    // copied back if the function writes to it.
    if (given.is_array != parameters[i].slot.is_array) {
      const Type& type = by_pointer ? *pointer(id).type : module_.type_of(id);
      const ir::Slot between = new_slot(type, parameters[i].slot.is_array);
      copy(between, given, out);
      if (parameters[i].written) back.push_back({given, between});
      given = between;
    }
    call.arguments.push_back(std::move(given));
  }
  const Type& type = module_.type(instruction.type);
  if (type.op != spv::OpTypeVoid) call.result = new_slot(type, type.op == spv::OpTypeArray);
  values_[instruction.result] = call.result;
  out.push_back({std::move(call)});
  for (const auto& [to, from] : back) copy(to, from, out);
}

void FunctionLowering::copy(const ir::Slot& to, const ir::Slot& from, ir::Block& out) {
  if (to.is_array && from.is_array) {
    out.push_back({ir::Instruction{.op = ir::Op::copy, .array = to.array, .other = from.array}});
  } else if (to.is_array) {
    for (uint32_t i = 0; i < from.numbers.size(); ++i)
      out.push_back(
          {ir::Instruction{.op = ir::Op::store, .from = {whole(i), from.numbers[i]}, .array = to.array}});
  } else if (from.is_array) {
    for (uint32_t i = 0; i < to.numbers.size(); ++i)
      out.push_back({ir::Instruction{
          .op = ir::Op::load, .to = to.numbers[i], .from = {whole(i)}, .array = from.array}});
  } else {
    assign(to.numbers, from.numbers, out);
  }
}

// Assigns all numbers as if at once: numbers that would be overwritten before they are read are saved first.
void FunctionLowering::assign(const std::vector<ir::Operand>& to, std::vector<ir::Operand> from,
                              ir::Block& out) {
  const auto move = [&](ir::Operand into, ir::Operand source) {
    if (into != source) out.push_back({ir::Instruction{.op = ir::Op::move, .to = into, .from = {source}}});
  };
  for (size_t i = 0; i < from.size(); ++i) {
    const auto written = std::ranges::find(to.begin(), to.begin() + ptrdiff_t(i), from[i]);
    if (written == to.begin() + ptrdiff_t(i)) continue;
    const ir::Operand kept = new_register(type_of(from[i]));
    move(kept, from[i]);
    from[i] = kept;
  }
  for (size_t i = 0; i < from.size(); ++i) move(to[i], from[i]);
}

// Makes the last instructions write to `to` instead of `from`. Returns false, without a change, if they do
// not compute `from`, or if one of them reads a number of `to` that is then already overwritten. Nothing else
// may use `from`.
bool FunctionLowering::retarget(const std::vector<ir::Operand>& to, const std::vector<ir::Operand>& from,
                                ir::Block& out) const {
  if (out.size() < from.size()) return false;
  const size_t first = out.size() - from.size();
  for (size_t i = 0; i < from.size(); ++i) {
    const auto* instruction = std::get_if<ir::Instruction>(&out[first + i].what);
    if (!instruction || instruction->op == ir::Op::store || instruction->op == ir::Op::clear ||
        instruction->op == ir::Op::copy || instruction->to != from[i] || from[i] < 0)
      return false;
    for (size_t k = 0; k < i; ++k)
      if (std::ranges::find(instruction->from, to[k]) != instruction->from.end()) return false;
  }
  for (size_t i = 0; i < from.size(); ++i) std::get<ir::Instruction>(out[first + i].what).to = to[i];
  return true;
}

}  // namespace eyeray::engine::formula
