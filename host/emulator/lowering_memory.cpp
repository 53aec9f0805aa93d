#include <algorithm>

#include "host/core/error.hpp"
#include "host/emulator/executes.hpp"
#include "host/emulator/lowering.hpp"

namespace eyeray::engine::emulator {
namespace {

constexpr uint64_t most_cells = 1 << 22;

}  // namespace

void Lowering::access(Operation& made, uint32_t pointer, bool writes) {
  const Value& to = value(pointer);
  if (to.root == no_root)
    throw Error(ExitCode::bad_input,
                "the emulator needs to know the variable of a pointer, and {} has a pointer that was chosen",
                describe(made.location, program_.files));
  made.root = to.root;
  made.type = types_.at(to.type).element;
  made.from.insert(made.from.begin(), to.source);
  const Root& root = program_.roots[to.root];
  if (root.space == Space::buffer || root.space == Space::pushed)
    made.cells = types_.cells(types_.at(to.type).element, to.placement);
  check_limit(cells_ += made.cells.size(), most_cells, "words of all accesses to buffers");
  Use& use = uses_[to.root];
  use.writes = use.writes || writes;
  for (const Cell& cell : made.cells) use.unit = std::min(use.unit, cell.size);
}

bool Lowering::lower_memory(Block& block, const spirv::Instruction& i) {
  const spv::Op op = spirv::opcode_of(i);
  Operation made = operation(i);
  made.execute = memory_operation(op);
  if (!made.execute) return false;
  switch (op) {
    case spv::OpLoad:
      if (is_image(types_.at(i[1]))) {
        values_.at(i[2]).root = value(i[3]).root;
        return true;
      }
      access(made, i[3], false);
      break;
    case spv::OpStore:
      made.from = {source(i[2])};
      access(made, i[1], true);
      break;
    case spv::OpCopyMemory: {
      // A load and a store.
      const uint32_t words = types_.at(types_.at(value(i[1]).type).element).words;
      Operation load{.execute = memory_operation(spv::OpLoad),
                     .to = registers(words),
                     .words = words,
                     .location = made.location};
      access(load, i[2], false);
      made.execute = memory_operation(spv::OpStore);
      made.from = {Source{.at = load.to, .words = words}};
      access(made, i[1], true);
      block.operations.push_back(std::move(load));
      break;
    }
    case spv::OpArrayLength: {
      const Type& type = types_.at(types_.at(value(i[3]).type).element);
      made.root = value(i[3]).root;
      made.literals = {type.placements.at(i[4]).offset, types_.at(type.members.at(i[4])).stride};
      break;
    }
    case spv::OpControlBarrier:
      made.literals = {source(i[1]).at, source(i[2]).at, source(i[3]).at};
      for (uint32_t& each : made.literals) each = program_.constants.at(each);
      break;
    default:  // OpMemoryBarrier
      made.literals = {program_.constants.at(source(i[1]).at), program_.constants.at(source(i[2]).at)};
  }
  block.operations.push_back(std::move(made));
  return true;
}

// Operands: pointer, scope, semantics, [unequal semantics,] values.
bool Lowering::lower_atomic(Block& block, const spirv::Instruction& i) {
  const spv::Op op = spirv::opcode_of(i);
  const bool stores = op == spv::OpAtomicStore;
  const size_t pointer = stores ? 1 : 3, first = pointer + (op == spv::OpAtomicCompareExchange ? 4 : 3);
  const auto to = pointer < i.size() ? values_.find(i[pointer]) : values_.end();
  if (to == values_.end() || types_.at(to->second.type).op != spv::OpTypePointer) return false;
  const Type& number = types_.at(types_.at(to->second.type).element);
  Operation made = operation(i);
  made.execute = atomic_operation(op, number.bits, number.real);
  if (!made.execute) return false;
  for (size_t n = first; n < i.size(); ++n) made.from.push_back(source(i[n]));
  access(made, i[pointer], op != spv::OpAtomicLoad);
  block.operations.push_back(std::move(made));
  return true;
}

bool Lowering::lower_image(Block& block, const spirv::Instruction& i) {
  const spv::Op op = spirv::opcode_of(i);
  if (op == spv::OpImage || op == spv::OpSampledImage) {
    values_.at(i[2]).root = value(i[3]).root;
    return true;
  }
  Operation made = operation(i);
  made.execute = image_operation(op);
  if (!made.execute) return false;
  const bool writes = op == spv::OpImageWrite, points = op == spv::OpImageTexelPointer;
  made.root = value(i[writes ? 1 : 3]).root;
  if (made.root == no_root) refuse(i);
  Use& use = uses_[made.root];
  use.writes = use.writes || writes;
  if (op == spv::OpImageRead || op == spv::OpImageFetch || writes || points) {
    made.from = {source(i[writes ? 2 : 4])};
    made.literals = {0, 0};
    const size_t mask = points ? i.size() : writes ? 4 : 5;
    if (mask < i.size()) {
      size_t next = mask + 1;
      const auto take = [&](uint32_t bit) {
        if (!(i[mask] & bit)) return 0u;
        made.from.push_back(source(i[next++]));
        return uint32_t(made.from.size() - 1);
      };
      const uint32_t others = spv::ImageOperandsBiasMask | spv::ImageOperandsGradMask |
                              spv::ImageOperandsConstOffsetsMask | spv::ImageOperandsSampleMask |
                              spv::ImageOperandsMinLodMask;
      if (i[mask] & others) refuse(i);
      made.literals[0] = take(spv::ImageOperandsLodMask);
      made.literals[1] = take(spv::ImageOperandsConstOffsetMask | spv::ImageOperandsOffsetMask);
    }
    if (writes) {
      made.from.push_back(source(i[3]));
      made.type = value(i[3]).type;
    }
  }
  if (points) values_.at(i[2]).root = made.root;
  const Type* image = &type_of(i[writes ? 1 : 3]);
  while (image->op == spv::OpTypePointer || image->op == spv::OpTypeSampledImage)
    image = &types_.at(image->element);
  if (types_.at(image->element).bits != 32) refuse(i);
  block.operations.push_back(std::move(made));
  return true;
}

}  // namespace eyeray::engine::emulator
