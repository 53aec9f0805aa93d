#include "host/formula/module.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/spirv/words.hpp"

namespace eyeray::engine::formula {

namespace {

// Limits on the numbers of one type, and of all variables of a module together. They are small enough for
// sums and products in 32 bits.
constexpr uint64_t most_numbers_of_a_type = 1 << 13;
constexpr uint64_t most_numbers_of_variables = 1 << 20;

[[noreturn]] void refuse_size(const SourcePosition& where, std::string_view what, uint64_t most) {
  throw InputError(
      {{Severity::error, where, fmt::format("{} more than {} numbers: use smaller arrays", what, most), ""}});
}

}  // namespace

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
    case spv::OpTypeArray: {
      // Checks the length before anything of that length exists. No type has more numbers than 2^13, so the
      // product fits 64 bits.
      const uint64_t length = constant_bits_.at(words[3]).at(0), numbers = length * types.at(words[2]).size;
      if (length == 0 || length > most_numbers_of_a_type || numbers > most_numbers_of_a_type)
        refuse_size({}, "an array has none or", most_numbers_of_a_type);
      type.members.assign(length, words[2]);
      break;
    }
    case spv::OpTypeStruct:
      type.members.assign(words.begin() + 2, words.end());
      break;
    case spv::OpTypePointer:
      type.members = {words[3]};
      return;
    default:
      return;
  }
  uint64_t numbers = type.size;
  for (const uint32_t member : type.members) numbers += types.at(member).size;
  if (numbers > most_numbers_of_a_type) refuse_size({}, "a type has", most_numbers_of_a_type);
  type.size = uint32_t(numbers);
}

void Module::count_variable(const Instruction& variable) {
  variable_numbers_ += types.at(types.at(variable.type).members[0]).size;
  if (variable_numbers_ > most_numbers_of_variables)
    refuse_size(variable.where, "the formula's variables together have", most_numbers_of_variables);
}

void Module::read_constant(const Instruction& instruction) {
  if (instruction.op == spv::OpVariable) return;
  std::vector<uint32_t>& bits = constant_bits_[instruction.result];
  switch (instruction.op) {
    case spv::OpConstant:
      bits = {instruction.words[0]};
      return;
    case spv::OpConstantTrue:
      bits = {1};
      return;
    case spv::OpConstantComposite:
      for (const uint32_t part : instruction.words) {
        const std::vector<uint32_t>& more = constant_bits(part);
        bits.insert(bits.end(), more.begin(), more.end());
      }
      return;
    default:  // false, null, undefined
      bits.assign(type(instruction.type).size, 0);
  }
}

Module::Module(std::span<const uint32_t> spirv) {
  std::map<uint32_t, std::string> strings;
  SourcePosition where;
  Function* function = nullptr;

  spirv::for_each_instruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> words) {
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
        strings[words[1]] = spirv::string_at(words, 2);
        return;
      case spv::OpLine:
        where = {strings[words[1]], int(words[2]), 0};
        return;
      case spv::OpNoLine:
        return;
      case spv::OpName:
        names_[words[1]] = spirv::string_at(words, 2);
        return;
      case spv::OpFunction:
        function = &functions.emplace_back();
        function->id = words[2];
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
        function->blocks.back().next = words[2];
        return;
      case spv::OpSelectionMerge:
        function->blocks.back().join = words[1];
        return;
      default:
        break;
    }
    if (op == spv::OpVariable) count_variable(instruction);
    if (function) {
      function->blocks.back().instructions.push_back(std::move(instruction));
    } else if (has_type) {
      read_constant(instruction);
      constants.push_back(std::move(instruction));
    } else if (has_result) {
      read_type(op, words);
    }
  });
}

const Function& Module::function(uint32_t id) const {
  const auto found = std::ranges::find(functions, id, &Function::id);
  CHECK(found != functions.end());
  return *found;
}

const Function* Module::named(std::string_view name) const {
  const auto found = std::ranges::find_if(functions, [&](const Function& function) {
    const auto entry = names_.find(function.id);
    return entry != names_.end() && entry->second == name;
  });
  return found == functions.end() ? nullptr : &*found;
}

bool Module::is_zero(uint32_t id) const {
  return is_constant(id) && std::ranges::all_of(constant_bits(id), [](uint32_t bits) { return bits == 0; });
}

uint32_t Module::new_zero(uint32_t type) {
  const uint32_t id = new_ids_++;
  value_types_[id] = type;
  constant_bits_[id].assign(types.at(type).size, 0);
  return id;
}

std::optional<uint32_t> Module::constant(uint32_t id) const {
  if (!is_constant(id) || type_of(id).op != spv::OpTypeInt) return std::nullopt;
  return constant_bits(id)[0];
}

}  // namespace eyeray::engine::formula
