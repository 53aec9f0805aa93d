#include "host/emulator/types.hpp"

#include "host/core/error.hpp"

namespace eyeray::engine::emulator {
namespace {

// Words of one type at most. Sums and products of sizes then fit 32 bits.
constexpr uint64_t most_words = 1 << 20;

constexpr uint64_t bytes_a_word = 4;

}  // namespace

void Types::decorate(const spirv::Instruction& i) {
  if (spirv::opcode_of(i) == spv::OpDecorate && i[2] == spv::DecorationArrayStride) strides_[i[1]] = i[3];
  if (spirv::opcode_of(i) != spv::OpMemberDecorate) return;
  Placement& member = placements_[i[1]][i[2]];
  if (i[3] == spv::DecorationOffset) member.offset = i[4];
  if (i[3] == spv::DecorationMatrixStride) member.matrix_stride = i[4];
  if (i[3] == spv::DecorationRowMajor) member.row_major = true;
}

void Types::add(const spirv::Instruction& i, const std::map<uint32_t, uint32_t>& constants) {
  Type type{.op = spirv::opcode_of(i)};
  uint64_t words = 0;
  const auto repeat = [&](uint32_t element, uint32_t count) {
    type.element = element;
    type.count = count;
    words = uint64_t{at(element).words} * count;
  };
  switch (type.op) {
    case spv::OpTypeInt:
    case spv::OpTypeFloat:
      if (i[2] != 32)
        throw Error(ExitCode::bad_input, "the emulator has no numbers of {} bits: use numbers of 32 bits",
                    i[2]);
      type.is_signed = type.op == spv::OpTypeInt && i[3] != 0;
      words = 1;
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
      }
      break;
    case spv::OpTypePointer:
      type.storage = spv::StorageClass(i[2]);
      type.element = i[3];
      break;
    case spv::OpTypeImage:
      if (i[3] != spv::DimBuffer)
        throw Error(ExitCode::bad_input, "the emulator has no images: use storage buffers or texel buffers");
      type.element = i[2];
      break;
    case spv::OpTypeVoid:
    case spv::OpTypeFunction:
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

std::vector<uint32_t> Types::bytes(uint32_t id, const Placement& placement) const {
  const Type& type = at(id);
  std::vector<uint32_t> bytes;
  const auto add = [&](const std::vector<uint32_t>& part, uint64_t start) {
    for (const uint32_t each : part) bytes.push_back(uint32_t(start + each));
  };
  switch (type.op) {
    case spv::OpTypeVector: {
      // A row-major matrix has its column's numbers a stride apart.
      const uint64_t step =
          placement.row_major && placement.matrix_stride ? placement.matrix_stride : bytes_a_word;
      for (uint32_t n = 0; n < type.count; ++n) add({0}, n * step);
      break;
    }
    case spv::OpTypeMatrix:
      for (uint32_t column = 0; column < type.count; ++column)
        add(this->bytes(type.element, placement),
            column * (placement.row_major ? bytes_a_word : placement.matrix_stride));
      break;
    case spv::OpTypeArray:
      for (uint32_t n = 0; n < type.count; ++n)
        add(this->bytes(type.element, placement), uint64_t{n} * type.stride);
      break;
    case spv::OpTypeStruct:
      for (size_t n = 0; n < type.members.size(); ++n)
        add(this->bytes(type.members[n], type.placements[n]), type.placements[n].offset);
      break;
    default:
      bytes.push_back(0);
  }
  return bytes;
}

}  // namespace eyeray::engine::emulator
