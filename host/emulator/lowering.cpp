#include "host/emulator/lowering.hpp"

#include <algorithm>

#include "host/core/error.hpp"
#include "host/emulator/block_order.hpp"
#include "host/emulator/emulator.hpp"

namespace eyeray::engine::emulator {
namespace {

// The limits of a kernel.
constexpr uint64_t most_registers = 1 << 24;    // words of one invocation
constexpr uint64_t most_group_words = 1 << 26;  // words of registers of a work group
constexpr uint64_t most_constants = 1 << 24;    // words
constexpr uint64_t most_invocations = 4096;     // in a work group

}  // namespace

void check_limit(uint64_t count, uint64_t most, const char* of) {
  if (count > most)
    throw Error(ExitCode::bad_input, "the emulator has at most {} {}, and the kernel needs {}", most, of,
                count);
}

Program lower(std::span<const uint32_t> spirv) {
  return Lowering(spirv).run();
}

Location Lowering::location(const spirv::Instruction& i) const {
  bool has_result = false, has_type = false;
  const spv::Op op = spirv::opcode_of(i);
  spv::HasResultAndType(op, &has_result, &has_type);
  const uint32_t id = has_result ? i[has_type ? 2 : 1] : 0;
  return {.opcode = uint32_t(op), .id = id, .file = file_, .line = line_, .column = column_};
}

void Lowering::refuse(const spirv::Instruction& i) const {
  throw Error(ExitCode::bad_input, "the emulator does not have the instruction {}",
              describe(location(i), program_.files));
}

const Lowering::Value& Lowering::value(uint32_t id) const {
  const auto found = values_.find(id);
  if (found == values_.end()) throw Error(ExitCode::bad_input, "a kernel's SPIR-V has no value %{}", id);
  return found->second;
}

Source Lowering::part(const Source& source, uint32_t first, uint32_t words) const {
  CHECK_LE(uint64_t{first} + words, source.words);
  return {.at = source.at + first, .words = words, .constant = source.constant};
}

Source Lowering::constant(std::span<const uint32_t> words) {
  const auto at = uint32_t(program_.constants.size());
  check_limit(at + words.size(), most_constants, "words of constants");
  program_.constants.insert(program_.constants.end(), words.begin(), words.end());
  return {.at = at, .words = uint32_t(words.size()), .constant = true};
}

Source Lowering::pointer_to(uint32_t offset) {
  return constant(std::vector<uint32_t>{offset, 0, 0});
}

uint32_t Lowering::registers(uint64_t words) {
  const uint32_t at = program_.registers;
  check_limit(at + words, most_registers, "words of values and variables of an invocation");
  program_.registers += uint32_t(words);
  return at;
}

Program Lowering::run() {
  for (const spirv::Instruction& i : module_.declarations) declare(i);
  for (const auto& [id, decorations] : decorations_) {
    const auto kind = decorations.find(spv::DecorationBuiltIn);
    if (kind == decorations.end() || kind->second != spv::BuiltInWorkgroupSize) continue;
    for (uint32_t axis = 0; axis < 3; ++axis) program_.group[axis] = program_.constants[source(id).at + axis];
  }
  uint64_t invocations = 1;
  for (const uint32_t along : program_.group) {
    invocations *= along;
    check_limit(invocations, most_invocations, "invocations of a work group");
  }
  if (invocations == 0) throw Error(ExitCode::bad_input, "a kernel's work group has no invocations");
  for (const spirv::Function& function : module_.functions) {
    function_index_[function.head[0][2]] = uint32_t(function_index_.size());
    allot(function);
  }
  for (const spirv::Function& function : module_.functions)
    program_.functions.push_back(lower_function(function));
  add_uses();
  check_limit(program_.registers * invocations, most_group_words,
              "words of values and variables of a work group");
  program_.entry = function_index_.at(entry_);
  program_.types = std::make_shared<const Types>(std::move(types_));
  return std::move(program_);
}

// The space of a parameter, which is a pointer or an image.
Space Lowering::space_of(const Type& type) const {
  if (is_image(type) || is_image(types_.at(type.element)) || type.storage == spv::StorageClassImage)
    return Space::image;
  switch (type.storage) {
    case spv::StorageClassStorageBuffer:
    case spv::StorageClassUniform:
      return Space::buffer;
    case spv::StorageClassPushConstant:
      return Space::pushed;
    case spv::StorageClassWorkgroup:
      return Space::shared;
    default:
      return Space::own;
  }
}

// A use of a parameter is one of every argument.
void Lowering::add_uses() {
  for (bool changes = true; changes;) {
    changes = false;
    for (const auto& [parameter, argument] : arguments_) {
      const Use from = uses_[parameter];
      Use& to = uses_[argument];
      const Use both{to.writes || from.writes, std::min(to.unit, from.unit)};
      changes = changes || both.writes != to.writes || both.unit != to.unit;
      to = both;
    }
  }
  for (const auto& [root, use] : uses_) {
    const Root& of = program_.roots[root];
    if (of.at == no_root || (of.space != Space::buffer && of.space != Space::image)) continue;
    Use& to = program_.uses[of.at];
    to = {to.writes || use.writes, of.space == Space::image ? Format().bytes() : std::min(to.unit, use.unit)};
  }
}

// Gives every value of the function its register, since a phi may name values of later blocks.
void Lowering::allot(const spirv::Function& function) {
  const auto give = [&](const spirv::Instruction& i) {
    bool has_result = false, has_type = false;
    spv::HasResultAndType(spirv::opcode_of(i), &has_result, &has_type);
    if (!has_type) return;
    const Type& type = types_.at(i[1]);
    Value made{.type = i[1]};
    if (type.op == spv::OpTypePointer) {
      made.source = {.at = registers(pointer_words), .words = pointer_words};
    } else if (!is_image(type)) {
      made.source = {.at = registers(type.words), .words = type.words};
    }
    if (spirv::opcode_of(i) == spv::OpVariable) {
      const uint32_t words = types_.at(type.element).words;
      made.source = pointer_to(0);
      made.root = uint32_t(program_.roots.size());
      program_.roots.push_back(
          {.at = registers(words), .size = words, .name = names_[i[2]], .type = type.element});
    }
    values_[i[2]] = made;
  };
  for (const spirv::Instruction& i : function.head) {
    if (spirv::opcode_of(i) != spv::OpFunctionParameter) continue;
    give(i);
    std::vector<uint32_t>& roots = parameter_roots_[function.head[0][2]];
    roots.push_back(no_root);
    const Type& type = types_.at(i[1]);
    if (type.op != spv::OpTypePointer && !is_image(type)) continue;
    values_[i[2]].root = roots.back() = uint32_t(program_.roots.size());
    program_.roots.push_back({.space = space_of(type), .at = no_root});
  }
  for (const spirv::Block& block : function.blocks)
    for (const spirv::Instruction& i : block.body) give(i);
}

Function Lowering::lower_function(const spirv::Function& from) {
  Function function;
  for (const spirv::Instruction& i : from.head)
    if (spirv::opcode_of(i) == spv::OpFunctionParameter) function.parameters.push_back(source(i[2]).at);
  function.roots = parameter_roots_[from.head[0][2]];
  const uint32_t words = types_.at(from.head[0][1]).words;
  function.result = registers(words);

  std::map<uint32_t, const spirv::Block*> blocks;
  for (const spirv::Block& block : from.blocks) blocks[block.label] = &block;
  for (const spirv::Block& block : from.blocks)
    if (const spirv::Instruction& end = block.body.back();
        spirv::opcode_of(end) == spv::OpSwitch && type_of(end[1]).bits == 64)
      refuse(end);
  const std::vector<uint32_t> order = structured_order(from);
  std::map<uint32_t, uint32_t> index_of;
  for (const uint32_t label : order) index_of[label] = uint32_t(index_of.size());
  for (const uint32_t label : order) {
    Block& block = function.blocks.emplace_back();
    for (const spirv::Instruction& i : blocks.at(label)->body) lower_instruction(function, block, i);
    block.effort = 1;
    for (const Operation& each : block.operations) {
      uint64_t moved = each.words;
      for (const Source& operand : each.from) moved += operand.words;
      block.effort += 1 + moved;
    }
    end_block(from, index_of, block, *blocks.at(label));
  }
  uint64_t& start = function.blocks[0].effort;
  start += function.blocks.size();
  for (const auto& [at, count] : function.variables) start += count;
  return function;
}

void Lowering::end_block(const spirv::Function& function, const std::map<uint32_t, uint32_t>& index_of,
                         Block& block, const spirv::Block& from) {
  const spirv::Instruction& end = from.body.back();
  block.end = spirv::opcode_of(end);
  block.location = location(end);
  switch (block.end) {
    case spv::OpReturnValue:
    case spv::OpBranchConditional:
    case spv::OpSwitch:
      block.condition = source(end[1]);
      block.type = value(end[1]).type;
      break;
    case spv::OpReturn:
    case spv::OpBranch:
    case spv::OpUnreachable:
      break;
    default:
      refuse(end);
  }
  if (block.end == spv::OpSwitch)
    for (size_t n = 3; n < end.size(); n += 2)
      block.cases.push_back(end[n] & uint32_t((uint64_t{1} << type_of(end[1]).bits) - 1));
  for (const uint32_t label : successors(end)) {
    Way& way = block.ways.emplace_back();
    way.block = index_of.at(label);
    const auto target = std::ranges::find(function.blocks, label, &spirv::Block::label);
    for (const spirv::Instruction& phi : target->body) {
      if (spirv::opcode_of(phi) == spv::OpLine || spirv::opcode_of(phi) == spv::OpNoLine) continue;
      if (spirv::opcode_of(phi) != spv::OpPhi) break;
      for (size_t n = 3; n + 1 < phi.size(); n += 2)
        if (phi[n + 1] == from.label) way.moves.push_back({source(phi[2]).at, source(phi[n])});
    }
  }
}

}  // namespace eyeray::engine::emulator
