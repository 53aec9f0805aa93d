#include "host/formula/execution.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::formula {
namespace {

// Limit on the instructions followed, counted anew in each iteration, plus the effort to copy memories.
constexpr size_t most_effort = 400'000;
// Copying this many numbers of a memory takes no longer than following an instruction.
constexpr size_t effortless = 64;
constexpr size_t most_steps = 20'000;   // steps written down, unused ones too
constexpr int most_iterations = 1'000;  // most iterations of one loop

}  // namespace

Execution::Execution(const Module& module, Expression& expression)
    : module_(module), expression_(expression) {
  for (const Instruction& global : module.constants) {
    const auto held = module.held.find(global.result);
    if (held == module.held.end()) continue;
    const uint32_t variable = new_variable(module.type(module.type(global.type).members[0]));
    memory_[variable] = constant(held->second);
    globals_[global.result] = {variable, 0};
  }
}

Value Execution::constant(uint32_t id) const {
  const Type* scalar = &module_.type_of(id);
  while (!scalar->members.empty()) scalar = &module_.type(scalar->members[0]);
  Value value;
  for (const uint32_t bits : module_.constant_bits(id))
    value.push_back(scalar->op == spv::OpTypeBool ? expression_.truth(bits != 0)
                    : scalar->op == spv::OpTypeFloat
                        ? expression_.constant(double(__builtin_bit_cast(float, bits)))
                        : expression_.constant(scalar->is_signed ? double(int32_t(bits)) : double(bits)));
  return value;
}

Term Execution::run(std::string_view name) {
  const Function& function = *module_.named(name);
  const Value p{expression_.input(0), expression_.input(1), expression_.input(2)};
  Call caller{.function = function};
  constexpr uint32_t argument = 0;  // not an id of the module
  if (module_.type_of(function.parameters[0]).op == spv::OpTypePointer) {
    memory_[++variables_] = p;
    caller.pointers[argument] = {variables_, 0};
  } else {
    caller.values[argument] = p;
  }
  return call(function, {argument}, caller)[0];
}

Value Execution::call(const Function& function, const std::vector<uint32_t>& arguments, const Call& caller) {
  Call call{.function = function};
  for (size_t i = 0; i < arguments.size(); ++i) {
    if (caller.pointers.contains(arguments[i]) || globals_.contains(arguments[i]))
      call.pointers[function.parameters[i]] = pointer(caller, arguments[i]);
    else
      call.values[function.parameters[i]] = value(caller, arguments[i]);
  }
  const uint32_t outer = variables_;
  call.condition = expression_.truth(true);
  go(call, function.blocks[0].label, call.condition);
  run_blocks(call, 0, function.blocks.size());
  Value returned;
  join(call.returns, returned);
  for (auto local = memory_.upper_bound(outer); local != memory_.end(); local = memory_.erase(local))
    memory_size_ -= local->second.size();
  return returned;
}

// The function's blocks stand in the order in which they are reached. The blocks of a loop stand between its
// header and its merge block.
void Execution::run_blocks(Call& call, size_t first, size_t end) {
  for (size_t i = first; i < end; ++i) {
    const Block& block = call.function.blocks[i];
    if (!call.ways.contains(block.label)) continue;
    if (block.merge == 0) {
      run_block(call, block);
    } else {
      run_loop(call, i);
      i = call.function.block_of.at(block.merge) - 1;
    }
  }
}

void Execution::run_loop(Call& call, size_t header) {
  const Block& block = call.function.blocks[header];
  const size_t end = call.function.block_of.at(block.merge);
  for (int iterations = 0; call.ways.contains(block.label); ++iterations) {
    if (iterations == most_iterations)
      refuse(block.instructions.back(),
             fmt::format("this loop has more than {} iterations, or a number of them that depends on p",
                         most_iterations));
    run_block(call, block);
    run_blocks(call, header + 1, end);
  }
}

void Execution::run_block(Call& call, const Block& block) {
  const std::vector<Way> ways = std::move(call.ways.at(block.label));
  call.ways.erase(block.label);
  Value unused;
  call.condition = join(ways, unused);
  call.from.clear();
  call.conditions.clear();
  for (const Way& way : ways) {
    call.from.push_back(way.from);
    call.conditions.push_back(way.condition);
  }
  call.block = block.label;
  for (const Instruction& instruction : block.instructions) run_instruction(call, instruction);
}

Value Execution::choose(Term condition, const Value& x, const Value& y) {
  Value result(x.size());
  for (size_t i = 0; i < x.size(); ++i) result[i] = expression_.apply(Op::choose, condition, x[i], y[i]);
  return result;
}

Term Execution::join(const std::vector<Way>& ways, Value& returned) {
  if (ways.empty()) return expression_.truth(false);
  memory_ = ways.back().memory;
  returned = ways.back().returned;
  Term condition = ways.back().condition;
  for (size_t i = ways.size() - 1; i-- > 0;) {
    const Way& way = ways[i];
    for (auto& [variable, value] : memory_)
      if (const auto other = way.memory.find(variable); other != way.memory.end())
        value = choose(way.condition, other->second, value);
    returned = choose(way.condition, way.returned, returned);
    condition = expression_.apply(Op::either, way.condition, condition);
  }
  return condition;
}

void Execution::go(Call& call, uint32_t to, Term condition) {
  if (expression_.is(condition, 0)) return;
  effort_ += memory_size_ / effortless;
  call.ways[to].push_back({call.block, condition, memory_, {}});
}

void Execution::run_instruction(Call& call, const Instruction& instruction) {
  if (++effort_ > most_effort || expression_.steps().size() > most_steps)
    refuse(instruction, "with all iterations of its loops the function is too long");
  if (run_memory(call, instruction) || run_composite(call, instruction) || run_branch(call, instruction))
    return;

  // All other instructions compute a value.
  const Type& type = module_.type(instruction.type);
  std::optional<Value> result;
  if (instruction.op == spv::OpExtInst) {
    std::vector<Value> from;
    for (size_t i = 2; i < instruction.words.size(); ++i) {
      if (call.pointers.contains(instruction.words[i]))
        refuse(instruction, "this function is not supported here: modf and the like");
      from.push_back(value(call, instruction.words[i]));
    }
    result = glsl_function(expression_, instruction.words[1], from);
    if (!result) refuse(instruction, "this function is not supported here");
  } else {
    std::vector<Value> from;
    for (const uint32_t id : instruction.words) from.push_back(value(call, id));
    const Type& component = type.members.empty() ? type : module_.type(type.members[0]);
    result = arithmetic(expression_, instruction.op, from, type.size);
    if (!result) result = whole_arithmetic(expression_, instruction.op, from, component.is_signed);
    if (!result)
      refuse(instruction,
             component.op == spv::OpTypeInt
                 ? "a whole number is computed from p"
                 : fmt::format("instruction {} of SPIR-V is not supported here", int(instruction.op)));
  }
  call.values[instruction.result] = *result;
}

const Value& Execution::value(const Call& call, uint32_t id) {
  const auto found = call.values.find(id);
  if (found != call.values.end()) return found->second;
  const auto [known, is_new] = constants_.try_emplace(id);
  if (is_new) known->second = constant(id);
  return known->second;
}
const Execution::Pointer& Execution::pointer(const Call& call, uint32_t id) const {
  const auto found = call.pointers.find(id);
  return found != call.pointers.end() ? found->second : globals_.at(id);
}

uint32_t Execution::new_variable(const Type& type) {
  Value value(type.size, expression_.constant(0));
  if (type.op == spv::OpTypeBool) value[0] = expression_.truth(false);
  memory_[++variables_] = value;
  memory_size_ += value.size();
  return variables_;
}

uint32_t Execution::index(const Call& call, uint32_t id, const Instruction& instruction) {
  const Term term = value(call, id)[0];
  if (!expression_.known(term)) refuse(instruction, "an array's or vector's index is computed from p");
  return uint32_t(int64_t(expression_.value(term)));
}

void Execution::refuse(const Instruction& instruction, const std::string& what) const {
  throw InputError({{Severity::error, instruction.where, what, ""}});
}

}  // namespace eyeray::engine::formula
