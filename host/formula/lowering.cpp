// Lowers functions as a whole: notes the uses of values and variables, then goes from block to block.
#include "host/formula/lowering.hpp"

#include <algorithm>

namespace eyeray::engine::formula {

namespace {

// True for instructions that compute nothing: the result is the operands' numbers, rearranged.
bool only_arranges(spv::Op op) {
  return op == spv::OpCompositeConstruct || op == spv::OpCompositeExtract || op == spv::OpVectorShuffle ||
         op == spv::OpCompositeInsert || op == spv::OpCopyObject || op == spv::OpBitcast;
}

bool is_access(spv::Op op) {
  return op == spv::OpAccessChain || op == spv::OpInBoundsAccessChain;
}

}  // namespace

ir::Program lower(const Module& module, std::string_view value, std::string_view other) {
  ir::Program program;
  std::map<uint32_t, uint32_t> numbers;

  // Called functions come first. glslang refuses recursion.
  const auto lower_with_callees = [&](const auto& self, const Function& function) -> void {
    if (numbers.contains(function.id)) return;
    for (const Block& block : function.blocks)
      for (const Instruction& instruction : block.instructions)
        if (instruction.op == spv::OpFunctionCall) self(self, module.function(instruction.words[0]));
    ir::Function lowered = FunctionLowering(module, program, numbers, function).run();
    numbers[function.id] = uint32_t(program.functions.size());
    program.functions.push_back(std::move(lowered));
  };
  const Function* f = module.named(value);
  CHECK(f);
  lower_with_callees(lower_with_callees, *f);
  program.value = numbers.at(f->id);
  if (const Function* g = module.named(other)) {
    lower_with_callees(lower_with_callees, *g);
    program.other.push_back(numbers.at(g->id));
  }
  return program;
}

ir::Program lower(const Module& module, const Instruction& instruction) {
  ir::Program program;
  program.functions.push_back(FunctionLowering(module, program, {}, {}).run(instruction));
  return program;
}

FunctionLowering::FunctionLowering(const Module& module, ir::Program& program,
                                   const std::map<uint32_t, uint32_t>& numbers, const Function& function)
    : module_(module), program_(program), numbers_(numbers), function_(function) {}

ir::Function FunctionLowering::run() {
  look_ahead();
  for (const Instruction& global : module_.constants)
    if (module_.held.contains(global.result) && accesses_.contains(global.result))
      lower_constant_variable(global, out_.body);

  // A parameter that glslang passes by pointer is the variable itself.
  for (const uint32_t id : function_.parameters) {
    const Type& type = module_.type_of(id);
    const bool by_pointer = type.op == spv::OpTypePointer;
    const Type& whole = by_pointer ? module_.type(type.members[0]) : type;
    const ir::Slot slot =
        new_slot(whole, whole.op == spv::OpTypeArray || (by_pointer && accesses_[id].is_indexed));
    const Accesses& accesses = accesses_[id];
    out_.parameters.push_back({slot, by_pointer && (accesses.stores > 0 || accesses.part_writes > 0)});
    if (by_pointer)
      pointers_[id] = {.variable = id, .slot = slot, .type = &whole};
    else
      values_[id] = slot;
  }
  const Type& result = module_.type_of(function_.id);
  if (result.op != spv::OpTypeVoid) out_.result = new_slot(result, result.op == spv::OpTypeArray);

  lower_from(function_.blocks[0].label, 0, out_.body);
  return std::move(out_);
}

ir::Function FunctionLowering::run(const Instruction& instruction) {
  out_.parameters.push_back({});
  lower_instruction(instruction, out_.body);
  out_.result = value(instruction.result);
  return std::move(out_);
}

// ---- Beforehand ----

void FunctionLowering::look_ahead() {
  for (size_t b = 0; b < function_.blocks.size(); ++b)
    for (const Instruction& instruction : function_.blocks[b].instructions)
      if (instruction.result) defined_in_[instruction.result] = b;
  for (size_t b = 0; b < function_.blocks.size(); ++b) count_uses(b);
  note_accesses();
}

// Goes backwards, since the operands of an instruction that only arranges are used as long as its result is.
void FunctionLowering::count_uses(size_t b) {
  const std::vector<Instruction>& all = function_.blocks[b].instructions;
  for (size_t i = all.size(); i-- > 0;) {
    const Instruction& instruction = all[i];
    size_t last = i;
    if (only_arranges(instruction.op)) last = std::max(last, uses_[instruction.result].last);
    if (instruction.op == spv::OpPhi) {
      last = all.size();
      for (size_t k = 0; k + 1 < instruction.words.size(); k += 2)
        phis_[instruction.words[k + 1]].push_back({instruction.result, instruction.words[k]});
    }
    // Some words are not ids of values. If one is taken for an id, a value is kept longer, and no harm is
    // done.
    for (const uint32_t id : instruction.words) {
      const auto defined = defined_in_.find(id);
      if (defined == defined_in_.end()) continue;
      Uses& uses = uses_[id];
      ++uses.count;
      const bool elsewhere = defined->second != b || instruction.op == spv::OpPhi;
      uses.last =
          std::max(uses.last, elsewhere ? function_.blocks[defined->second].instructions.size() : last);
    }
  }
}

void FunctionLowering::note_accesses() {
  std::map<uint32_t, uint32_t> variable_of;  // the variable to which a pointer points
  const auto variable = [&](uint32_t id) {
    const auto found = variable_of.find(id);
    return found == variable_of.end() ? id : found->second;
  };
  for (size_t b = 0; b < function_.blocks.size(); ++b) {
    const std::vector<Instruction>& all = function_.blocks[b].instructions;
    for (size_t i = 0; i < all.size(); ++i) {
      const Instruction& instruction = all[i];
      const auto touch = [&](uint32_t id, bool stores_all) -> Accesses& {
        Accesses& accesses = accesses_[variable(id)];
        if (accesses.blocks.empty()) {
          accesses.first_block = b;
          accesses.first_is_store = stores_all;
        }
        accesses.blocks.insert(b);
        return accesses;
      };
      const auto write = [&](uint32_t id, bool all_of_it) {
        Accesses& accesses = touch(id, all_of_it);
        accesses.writes[b].insert(i);
        ++(all_of_it ? accesses.stores : accesses.part_writes);
      };
      if (is_access(instruction.op)) {
        variable_of[instruction.result] = variable(instruction.words[0]);
        Accesses& accesses = accesses_[variable(instruction.words[0])];
        for (size_t k = 1; k < instruction.words.size(); ++k)
          if (!module_.constant(instruction.words[k])) accesses.is_indexed = true;
      } else if (instruction.op == spv::OpLoad) {
        touch(instruction.words[0], false);
      } else if (instruction.op == spv::OpStore) {
        write(instruction.words[0], !variable_of.contains(instruction.words[0]));
      } else if (instruction.op == spv::OpFunctionCall) {
        for (size_t k = 1; k < instruction.words.size(); ++k)
          if (module_.type_of(instruction.words[k]).op == spv::OpTypePointer)
            write(instruction.words[k], false);
      } else if (instruction.op == spv::OpVariable && instruction.words.size() > 1) {
        write(instruction.result, true);
      }
    }
  }
}

// ---- From block to block ----

bool FunctionLowering::jump(uint32_t label, ir::Block& out) const {
  if (loops_.empty()) return false;
  const LoopLabels& loop = loops_.back();
  if (label == loop.merge)
    out.push_back({ir::Jump::leave});
  else if (label == loop.next && !loop.in_next)
    out.push_back({ir::Jump::next});
  else
    return false;
  return true;
}

void FunctionLowering::lower_from(uint32_t label, uint32_t stop, ir::Block& out) {
  while (label != stop && !jump(label, out)) {
    const Block& block = function_.blocks[function_.block_of.at(label)];
    const bool enters = block.merge != 0 && (loops_.empty() || loops_.back().header != label);
    if (!enters) {
      lower_instructions(block, out);
      if (!lower_branch(block, label, out)) return;
      continue;
    }
    ir::Loop loop;
    loops_.push_back({label, block.merge, block.next});
    lower_instructions(block, loop.body);
    uint32_t after = 0;
    if (lower_branch(block, after, loop.body)) lower_from(after, 0, loop.body);
    if (!loop.body.empty())
      if (const auto* last = std::get_if<ir::Jump>(&loop.body.back().what); last && *last == ir::Jump::next)
        loop.body.pop_back();
    loops_.back().in_next = true;
    lower_from(block.next, label, loop.next);
    loops_.pop_back();
    out.push_back({std::move(loop)});
    label = block.merge;
  }
}

void FunctionLowering::lower_instructions(const Block& block, ir::Block& out) {
  block_ = function_.block_of.at(block.label);
  for (at_ = 0; at_ + 1 < block.instructions.size(); ++at_) lower_instruction(block.instructions[at_], out);
  const auto phis = phis_.find(block.label);
  if (phis == phis_.end()) return;
  for (const auto& [result, id] : phis->second) {
    if (!values_.contains(result)) values_[result] = new_slot(module_.type_of(result), false);
    assign(values_.at(result).numbers, value(id).numbers, out);
  }
}

// Lowers the block's last instruction. Returns true if the caller must continue, at the block `label`.
bool FunctionLowering::lower_branch(const Block& block, uint32_t& label, ir::Block& out) {
  const Instruction& last = block.instructions.back();
  const std::vector<uint32_t>& words = last.words;
  switch (last.op) {
    case spv::OpBranch:
      label = words[0];
      return true;
    case spv::OpBranchConditional: {
      ir::Branch branch{value(words[0]).numbers[0], {}, {}};
      if (block.join) {
        lower_from(words[1], block.join, branch.yes);
        lower_from(words[2], block.join, branch.no);
        label = block.join;
      } else if (jump(words[2], branch.no)) {
        label = words[1];
      } else if (jump(words[1], branch.yes)) {
        label = words[2];
      } else {
        refuse(last, "this branch cannot be followed");
      }
      out.push_back({std::move(branch)});
      return true;
    }
    case spv::OpReturn:
    case spv::OpReturnValue:
    case spv::OpUnreachable:
      give_back(last, out);
      return false;
    default:
      refuse(last, fmt::format("instruction {} of SPIR-V is not supported here", int(last.op)));
  }
}

void FunctionLowering::give_back(const Instruction& terminator, ir::Block& out) {
  if (terminator.op == spv::OpReturnValue) {
    copy(out_.result, value(terminator.words[0]), out);
  } else if (terminator.op == spv::OpUnreachable) {
    for (const ir::Operand number : out_.result.numbers)
      assign({number}, {constant(type_of(number), 0)}, out);
    if (out_.result.is_array)
      out.push_back({ir::Instruction{.op = ir::Op::clear, .array = out_.result.array}});
  }
  out.push_back({ir::Jump::give_back});
}

// ---- Registers and constants ----

ir::Operand FunctionLowering::new_register(ir::Type type) {
  out_.registers.push_back(type);
  return ir::Operand(out_.registers.size() - 1);
}

ir::Operand FunctionLowering::constant(ir::Type type, uint32_t bits) {
  const auto [at, fresh] =
      program_.constant_numbers.try_emplace({type, bits}, uint32_t(program_.constants.size()));
  if (fresh) program_.constants.push_back({type, bits});
  return ~ir::Operand(at->second);
}

ir::Operand FunctionLowering::real(float value) {
  return constant(ir::Type::real, __builtin_bit_cast(uint32_t, value));
}

ir::Type FunctionLowering::scalar(const Type& type) const {
  if (!type.members.empty()) return scalar(module_.type(type.members[0]));
  return type.op == spv::OpTypeFloat ? ir::Type::real
         : type.op == spv::OpTypeInt ? ir::Type::whole
                                     : ir::Type::truth;
}

ir::Type FunctionLowering::type_of(ir::Operand operand) const {
  return operand < 0 ? program_.constants[size_t(~operand)].type : out_.registers[size_t(operand)];
}

ir::Slot FunctionLowering::new_slot(const Type& type, bool as_array) {
  ir::Slot slot;
  if (as_array) {
    out_.arrays.push_back({scalar(type), type.size});
    slot.is_array = true;
    slot.array = ir::ArrayId(out_.arrays.size() - 1);
  } else {
    for (uint32_t i = 0; i < type.size; ++i) slot.numbers.push_back(new_register(scalar(type)));
  }
  return slot;
}

ir::Slot FunctionLowering::constant_slot(uint32_t id) {
  const Type& type = module_.type_of(id);
  const std::vector<uint32_t> bits = module_.constant_bits(id);
  ir::Slot slot;
  if (type.op == spv::OpTypeArray) {
    const ir::Table table{scalar(type), bits};
    const auto known = std::ranges::find(program_.tables, table);
    slot.is_array = true;
    slot.array = ~ir::ArrayId(known - program_.tables.begin());
    if (known == program_.tables.end()) program_.tables.push_back(table);
  } else {
    for (const uint32_t b : bits) slot.numbers.push_back(constant(scalar(type), b));
  }
  return slot;
}

const ir::Slot& FunctionLowering::value(uint32_t id) {
  const auto found = values_.find(id);
  if (found != values_.end()) return found->second;
  CHECK(module_.is_constant(id));
  return values_[id] = constant_slot(id);
}

const FunctionLowering::Pointer& FunctionLowering::pointer(uint32_t id) const {
  const auto found = pointers_.find(id);
  if (found != pointers_.end()) return found->second;
  throw InputError({{Severity::error, {}, "this variable cannot be followed", ""}});
}

void FunctionLowering::refuse(const Instruction& instruction, const std::string& what) const {
  throw InputError({{Severity::error, instruction.where, what, ""}});
}

}  // namespace eyeray::engine::formula
