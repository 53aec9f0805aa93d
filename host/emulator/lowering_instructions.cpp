#include <algorithm>
#include <bit>

#include <spirv/unified1/GLSL.std.450.h>

#include "host/core/error.hpp"
#include "host/emulator/executes.hpp"
#include "host/emulator/lowering.hpp"

namespace eyeray::engine::emulator {

Operation Lowering::operation(const spirv::Instruction& i) const {
  Operation made{.location = location(i)};
  bool has_result = false, has_type = false;
  spv::HasResultAndType(spirv::opcode_of(i), &has_result, &has_type);
  if (!has_type) return made;
  const Source to = source(i[2]);
  made.to = to.at;
  made.words = to.words;
  made.type = i[1];
  return made;
}

std::pair<uint32_t, uint32_t> Lowering::find_part(uint32_t id, std::span<const uint32_t> indices) const {
  uint32_t first = 0;
  for (const uint32_t index : indices) {
    const Type& type = types_.at(id);
    if (type.op == spv::OpTypeStruct) {
      first += types_.words_before(type, index);
      id = type.members.at(index);
    } else {
      id = type.element;
      first += index * types_.at(id).words;
    }
  }
  return {first, id};
}

void Lowering::lower_instruction(Function& function, Block& block, const spirv::Instruction& i) {
  switch (spirv::opcode_of(i)) {
    case spv::OpLine:
      file_ = files_.at(i[1]);
      line_ = i[2];
      column_ = i[3];
      return;
    case spv::OpNoLine:
      line_ = column_ = 0;
      return;
    case spv::OpNop:
    case spv::OpPhi:
    case spv::OpSelectionMerge:
    case spv::OpLoopMerge:
    case spv::OpBranch:
    case spv::OpBranchConditional:
    case spv::OpSwitch:
    case spv::OpReturn:
    case spv::OpReturnValue:
    case spv::OpUnreachable:
      return;  // end_block
    case spv::OpVariable:
      return lower_variable(function, block, i);
    case spv::OpAccessChain:
    case spv::OpInBoundsAccessChain:
      return lower_chain(block, i);
    case spv::OpCompositeExtract:
    case spv::OpCompositeConstruct:
    case spv::OpCompositeInsert:
    case spv::OpVectorShuffle:
    case spv::OpCopyObject:
    case spv::OpCopyLogical:
    case spv::OpUndef:
      return lower_composite(block, i);
    case spv::OpFunctionCall:
      return lower_call(block, i);
    default:
      if (!lower_memory(block, i) && !lower_atomic(block, i) && !lower_image(block, i))
        lower_arithmetic(block, i);
  }
}

void Lowering::lower_variable(Function& function, Block& block, const spirv::Instruction& i) {
  const Root& root = program_.roots[value(i[2]).root];
  function.variables.emplace_back(root.at, root.size);
  if (i.size() <= 4) return;
  block.operations.push_back({.execute = concatenate,
                              .to = root.at,
                              .words = root.size,
                              .type = root.type,
                              .from = {source(i[4])},
                              .root = value(i[2]).root,
                              .location = location(i)});
}

// Sums the constant indices up; the others are steps.
void Lowering::lower_chain(Block& block, const spirv::Instruction& i) {
  const Value base = value(i[3]);
  Value& made = values_.at(i[2]);
  made.root = base.root;
  made.placement = base.placement;
  const Space space = program_.roots[base.root].space;
  const bool bytes = space == Space::buffer || space == Space::pushed;
  uint32_t id = types_.at(base.type).element;
  uint64_t offset = 0;
  Operation chain = operation(i);
  for (const uint32_t index : std::span(i).subspan(4)) {
    const Type& type = types_.at(id);
    const auto known = whole_constants_.find(index);
    if (type.op == spv::OpTypeStruct) {
      const auto member = uint32_t(known->second);
      offset += bytes ? type.placements.at(member).offset : types_.words_before(type, member);
      made.placement = type.placements.at(member);
      id = type.members.at(member);
      continue;
    }
    uint32_t stride = types_.at(type.element).words;
    const Placement& in = made.placement;
    if (bytes && type.op == spv::OpTypeMatrix) {
      stride = in.row_major ? type.bits / 8 : in.matrix_stride;
    } else if (bytes && type.op == spv::OpTypeVector) {
      stride = in.row_major && in.matrix_stride ? in.matrix_stride : type.bits / 8;
    } else if (bytes) {
      stride = type.stride;
    }
    if (known != whole_constants_.end() && known->second < type.count) {
      offset += known->second * stride;
    } else {
      chain.steps.push_back(
          {source(index), type_of(index).signed_bits(), stride, type.count, uint32_t(offset)});
    }
    id = type.element;
  }
  chain.execute = memory_operation(spv::OpAccessChain);
  chain.root = base.root;
  chain.from = {base.source};
  chain.literals = {uint32_t(offset)};
  // Without steps and from a variable's start the pointer is a constant.
  if (chain.steps.empty() && base.source.constant) {
    const uint32_t sum = program_.constants[base.source.at] + uint32_t(offset);
    made.source = pointer_to(sum);
    return;
  }
  block.operations.push_back(std::move(chain));
}

// Parts of values that are known never move: they are where the whole is.
void Lowering::lower_composite(Block& block, const spirv::Instruction& i) {
  Value& made = values_.at(i[2]);
  Operation whole = operation(i);
  whole.execute = concatenate;
  switch (spirv::opcode_of(i)) {
    case spv::OpCompositeExtract:
      made.source =
          part(source(i[3]), find_part(value(i[3]).type, std::span(i).subspan(4)).first, whole.words);
      return;
    case spv::OpCopyObject:
      made = {.type = made.type,
              .source = source(i[3]),
              .root = value(i[3]).root,
              .placement = value(i[3]).placement};
      return;
    case spv::OpCopyLogical:
      made.source = source(i[3]);
      return;
    case spv::OpUndef:
      return program_.privates.emplace_back(whole.to, whole.words), void();
    case spv::OpCompositeConstruct:
      for (const uint32_t id : std::span(i).subspan(3)) whole.from.push_back(source(id));
      break;
    case spv::OpCompositeInsert: {
      const Source object = source(i[3]), all = source(i[4]);
      const uint32_t first = find_part(made.type, std::span(i).subspan(5)).first,
                     after = first + object.words;
      whole.from = {part(all, 0, first), object, part(all, after, all.words - after)};
      break;
    }
    default: {  // OpVectorShuffle
      const Source a = source(i[3]), b = source(i[4]);
      const uint32_t words = type_of(i[3]).number_words();
      for (const uint32_t n : std::span(i).subspan(5)) {
        const uint32_t first = n == UINT32_MAX ? 0 : n * words;  // any value will do
        whole.from.push_back(first < a.words ? part(a, first, words) : part(b, first - a.words, words));
      }
    }
  }
  block.operations.push_back(std::move(whole));
}

void Lowering::lower_call(Block& block, const spirv::Instruction& i) {
  Operation call = operation(i);
  const auto index = function_index_.find(i[3]);
  if (index == function_index_.end()) refuse(i);
  call.execute = nullptr;  // the machine's own
  call.literals = {index->second};
  const std::vector<uint32_t>& parameters = parameter_roots_[i[3]];
  for (const uint32_t id : std::span(i).subspan(4)) {
    const uint32_t root = value(id).root;
    if (const uint32_t parameter = parameters.at(call.from.size()); parameter != no_root) {
      if (root == no_root) refuse(i);
      arguments_.emplace(parameter, root);
    }
    call.from.push_back(source(id));
    call.literals.push_back(root);
  }
  block.operations.push_back(std::move(call));
}

Execute Lowering::execute_of(const spirv::Instruction& i) const {
  const spv::Op op = spirv::opcode_of(i);
  const bool is_group = op >= spv::OpGroupNonUniformElect && op <= spv::OpGroupNonUniformQuadSwap;
  const size_t scope = is_group ? 1 : 0;
  const bool has_operation = op >= spv::OpGroupNonUniformIAdd && op <= spv::OpGroupNonUniformLogicalXor;
  const size_t first = 3 + scope + (has_operation || op == spv::OpGroupNonUniformBallotBitCount ? 1 : 0);
  const auto bits_of = [&](uint32_t id) { return values_.contains(id) ? type_of(id).bits : 32; };
  const uint32_t bits = first < i.size() ? bits_of(i[first]) : 32, to = types_.at(i[1]).bits;
  if (is_group) return subgroup_operation(op, bits);
  if (op == spv::OpBitcast) {
    const Type &from_type = type_of(i[3]), &to_type = types_.at(i[1]);
    return bit_cast(bits, to, from_type.real && !(to_type.real && bits == to));
  }
  if (const Execute found = arithmetic(op, bits)) return found;
  if (const Execute found = comparison(op, bits)) return found;
  if (const Execute found = conversion(op, bits, to)) return found;
  return vector_operation(op, bits);
}

// A function that returns one result, and stores another through a pointer.
void Lowering::lower_split(Block& block, const spirv::Instruction& i) {
  const Type& stored = types_.at(type_of(i[6]).element);
  const uint32_t words = types_.at(i[1]).words + stored.words;
  Operation split{.to = registers(words), .words = words, .from = {source(i[5])}, .location = location(i)};
  split.execute = glsl_function(i[4] == GLSLstd450Modf ? GLSLstd450ModfStruct : GLSLstd450FrexpStruct,
                                type_of(i[5]).bits);
  const Source both{.at = split.to, .words = words};
  values_.at(i[2]).source = part(both, 0, words - stored.words);
  Operation store{.execute = memory_operation(spv::OpStore),
                  .from = {part(both, words - stored.words, stored.words)},
                  .location = split.location};
  access(store, i[6], true);
  block.operations.push_back(std::move(split));
  block.operations.push_back(std::move(store));
}

void Lowering::lower_arithmetic(Block& block, const spirv::Instruction& i) {
  const spv::Op op = spirv::opcode_of(i);
  Operation made = operation(i);
  size_t first = 3;  // the first operand that is an id
  if (op == spv::OpExtInst) {
    if (i[3] == debug_ && i[4] == debug_line) {
      file_ = files_.at(i[5]);
      line_ = uint32_t(whole_constants_.at(i[6]));
      column_ = uint32_t(whole_constants_.at(i[8]));
    }
    if (i[3] == debug_ && i[4] == debug_no_line) line_ = column_ = 0;
    if (i[3] != glsl_) return;
    if (i[4] == GLSLstd450Modf || i[4] == GLSLstd450Frexp) return lower_split(block, i);
    first = 5;
    made.execute = glsl_function(i[4], first < i.size() ? type_of(i[first]).bits : 32);
  } else if (i.size() < 3 || !values_.contains(i[2])) {
    refuse(i);
  } else {
    made.execute = execute_of(i);
  }
  if (!made.execute) refuse(i);
  switch (op) {
    case spv::OpBitcast: {
      const Type &from = type_of(i[3]), &to = types_.at(i[1]);
      made.literals = {from.bits, to.bits, from.real && !(to.real && from.bits == to.bits)};
      break;
    }
    case spv::OpMatrixTimesMatrix:
    case spv::OpTranspose: {
      const Type& matrix = type_of(i[3]);
      made.literals = {types_.at(matrix.element).count, matrix.count};
      break;
    }
    case spv::OpVectorExtractDynamic:
    case spv::OpVectorInsertDynamic: {
      const uint32_t index = i[op == spv::OpVectorExtractDynamic ? 4 : 5];
      made.literals = {type_of(i[3]).number_words(), type_of(index).signed_bits()};
      break;
    }
    case spv::OpGroupNonUniformBallotBitCount:
      made.literals = {i[4]};
      first = 5;
      break;
    default:
      if (op >= spv::OpGroupNonUniformIAdd && op <= spv::OpGroupNonUniformLogicalXor) {
        const uint32_t size =
            i.size() > 6 ? program_.constants.at(source(i[6]).at) : 1;  // invocations in a cluster
        if (!std::has_single_bit(size)) refuse(i);
        made.literals = {i[4], size, uint32_t(op)};
        made.from = {source(i[5])};
        first = i.size();
      } else if (op >= spv::OpGroupNonUniformElect && op <= spv::OpGroupNonUniformQuadSwap) {
        first = 4;  // the scope comes first
      }
  }
  for (size_t n = first; n < i.size(); ++n) made.from.push_back(source(i[n]));
  block.operations.push_back(std::move(made));
}

}  // namespace eyeray::engine::emulator
