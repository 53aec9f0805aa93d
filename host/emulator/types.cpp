#include "host/emulator/types.hpp"

#include <algorithm>

#include "host/core/error.hpp"
#include "host/spirv/words.hpp"

namespace eyeray::engine::emulator {
namespace {

// Words of one type at most. Sums and products of sizes then fit 32 bits.
constexpr uint64_t most_words = 1 << 20;

}  // namespace

bool is_image(const Type& type) {
  return type.op == spv::OpTypeImage || type.op == spv::OpTypeSampledImage || type.op == spv::OpTypeSampler;
}

void Types::decorate(const spirv::Instruction& i) {
  if (spirv::opcode_of(i) == spv::OpDecorate && i[2] == spv::DecorationArrayStride) strides_[i[1]] = i[3];
  if (spirv::opcode_of(i) == spv::OpMemberName) names_[i[1]][i[2]] = spirv::string_at(i, 3);
  if (spirv::opcode_of(i) != spv::OpMemberDecorate) return;
  Placement& member = placements_[i[1]][i[2]];
  if (i[3] == spv::DecorationOffset) member.offset = i[4];
  if (i[3] == spv::DecorationMatrixStride) member.matrix_stride = i[4];
  if (i[3] == spv::DecorationRowMajor) member.row_major = true;
}

void Types::add(const spirv::Instruction& i, const std::map<uint32_t, uint64_t>& constants) {
  Type type{.op = spirv::opcode_of(i)};
  uint64_t words = 0;
  const auto repeat = [&](uint32_t element, uint64_t count) {
    type.element = element;
    type.count = uint32_t(std::min<uint64_t>(count, UINT32_MAX));
    type.bits = at(element).bits;
    type.real = at(element).real;
    words = at(element).words * count;
  };
  switch (type.op) {
    case spv::OpTypeInt:
    case spv::OpTypeFloat:
      type.bits = i[2];
      type.real = type.op == spv::OpTypeFloat;
      type.is_signed = type.op == spv::OpTypeInt && i[3] != 0;
      words = type.number_words();
      break;
    case spv::OpTypeBool:
      words = 1;
      break;
    case spv::OpTypeVector:
    case spv::OpTypeMatrix:
      repeat(i[2], i[3]);
      break;
    case spv::OpTypeArray: {
      const auto length = constants.find(i[3]);
      if (length == constants.end())
        throw Error(ExitCode::bad_input, "the emulator needs a constant as the length of array type %{}",
                    i[1]);
      if (length->second > most_words)
        throw Error(ExitCode::bad_input, "the emulator has arrays of at most {} elements, not {}", most_words,
                    length->second);
      repeat(i[2], length->second);
      break;
    }
    case spv::OpTypeRuntimeArray:
      repeat(i[2], 0);
      break;
    case spv::OpTypeStruct:
      type.members.assign(i.begin() + 2, i.end());
      for (uint32_t n = 0; n < type.members.size(); ++n) {
        words += at(type.members[n]).words;
        type.placements.push_back(placements_[i[1]][n]);
        type.names.push_back(names_[i[1]][n]);
      }
      break;
    case spv::OpTypePointer:
      type.storage = spv::StorageClass(i[2]);
      type.element = i[3];
      break;
    case spv::OpTypeImage:
      type.dim = spv::Dim(i[3]);
      type.arrayed = i[5] != 0;
      type.element = i[2];
      if (i[6] != 0 || (type.dim > spv::Dim3D && type.dim != spv::DimBuffer))
        throw Error(ExitCode::bad_input,
                    "the emulator has images of one, two and three dimensions, arrays of them and texel "
                    "buffers: no cubes, and no images of several samples");
      break;
    case spv::OpTypeSampledImage:
      type.element = i[2];
      break;
    case spv::OpTypeVoid:
    case spv::OpTypeFunction:
    case spv::OpTypeSampler:
      break;
    default:
      throw Error(ExitCode::bad_input, "the emulator has no type of opcode {}", uint32_t(type.op));
  }
  if (words > most_words)
    throw Error(ExitCode::bad_input, "the emulator has types of at most {} numbers, not {}", most_words,
                words);
  type.words = uint32_t(words);
  if (const auto stride = strides_.find(i[1]); stride != strides_.end()) type.stride = stride->second;
  types_[i[1]] = std::move(type);
}

const Type& Types::at(uint32_t id) const {
  const auto found = types_.find(id);
  if (found == types_.end()) throw Error(ExitCode::bad_input, "a kernel's SPIR-V has no type %{}", id);
  return found->second;
}

uint32_t Types::words_before(const Type& type, uint32_t member) const {
  uint32_t words = 0;
  for (uint32_t n = 0; n < member; ++n) words += at(type.members[n]).words;
  return words;
}

std::vector<Cell> Types::cells(uint32_t id, const Placement& placement) const {
  const Type& type = at(id);
  std::vector<Cell> cells;
  const auto add = [&](const std::vector<Cell>& part, uint64_t start) {
    for (Cell each : part) {
      each.byte += uint32_t(start);
      cells.push_back(each);
    }
  };
  const uint32_t size = type.bits / 8;
  switch (type.op) {
    case spv::OpTypeVector: {
      // A row-major matrix has its column's numbers a stride apart.
      const uint64_t step = placement.row_major && placement.matrix_stride ? placement.matrix_stride : size;
      for (uint32_t n = 0; n < type.count; ++n) add(this->cells(type.element), n * step);
      break;
    }
    case spv::OpTypeMatrix:
      for (uint32_t column = 0; column < type.count; ++column)
        add(this->cells(type.element, placement),
            uint64_t{column} * (placement.row_major ? size : placement.matrix_stride));
      break;
    case spv::OpTypeArray:
      for (uint32_t n = 0; n < type.count; ++n)
        add(this->cells(type.element, placement), uint64_t{n} * type.stride);
      break;
    case spv::OpTypeStruct:
      for (size_t n = 0; n < type.members.size(); ++n)
        add(this->cells(type.members[n], type.placements[n]), type.placements[n].offset);
      break;
    default: {
      const uint32_t real_bits = type.real ? type.bits : 0;
      if (size == 8)
        cells = {{.byte = 0, .size = 4}, {.byte = 4, .size = 4, .real_bits = real_bits}};
      else
        cells = {{.byte = 0, .size = size, .real_bits = real_bits}};
    }
  }
  return cells;
}

}  // namespace eyeray::engine::emulator
