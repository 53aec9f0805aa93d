#include <algorithm>

#include "host/core/error.hpp"
#include "host/emulator/executes.hpp"
#include "host/emulator/lowering.hpp"
#include "host/spirv/words.hpp"

namespace eyeray::engine::emulator {
namespace {

constexpr uint64_t most_shared = 1 << 20;  // words of memory of a work group

}  // namespace

void Lowering::decorate(const spirv::Instruction& i) {
  types_.decorate(i);
  if (spirv::opcode_of(i) == spv::OpDecorate) decorations_[i[1]][i[2]] = i.size() > 3 ? i[3] : 0;
}

void Lowering::declare(const spirv::Instruction& i) {
  switch (const spv::Op op = spirv::opcode_of(i)) {
    case spv::OpString:
      files_[i[1]] = uint32_t(program_.files.size());
      program_.files.push_back(spirv::string_at(i, 2));
      return;
    case spv::OpName:
      names_[i[1]] = spirv::string_at(i, 2);
      return;
    case spv::OpMemberName:
      types_.decorate(i);
      return;
    case spv::OpExtInstImport:
      if (spirv::string_at(i, 2) == "GLSL.std.450") glsl_ = i[1];
      if (spirv::string_at(i, 2) == "NonSemantic.Shader.DebugInfo.100") debug_ = i[1];
      return;
    case spv::OpExtInst:
      if (i[3] == debug_ && i[4] == debug_source) files_[i[2]] = files_.at(i[5]);
      return;
    case spv::OpEntryPoint:
      if (i[1] != spv::ExecutionModelGLCompute)
        throw Error(ExitCode::bad_input, "the emulator runs compute shaders only");
      entry_ = i[2];
      return;
    case spv::OpExecutionMode:
      if (i[2] == spv::ExecutionModeLocalSize) program_.group = {i[3], i[4], i[5]};
      if (i[2] == spv::ExecutionModeDenormFlushToZero || i[2] == spv::ExecutionModeRoundingModeRTZ)
        throw Error(
            ExitCode::bad_input,
            "the emulator rounds to nearest and keeps denormals, and the kernel asks for another way");
      return;
    case spv::OpDecorate:
    case spv::OpMemberDecorate:
      decorate(i);
      return;
    case spv::OpVariable:
      add_global(i);
      return;
    case spv::OpConstant:
    case spv::OpConstantTrue:
    case spv::OpConstantFalse:
    case spv::OpConstantNull:
    case spv::OpConstantComposite:
    case spv::OpSpecConstant:
    case spv::OpSpecConstantTrue:
    case spv::OpSpecConstantFalse:
    case spv::OpSpecConstantComposite:
    case spv::OpUndef:
      add_constant(i);
      return;
    case spv::OpSpecConstantOp:
    case spv::OpTypeForwardPointer:
      refuse(i);
    default: {
      bool has_result = false, has_type = false;
      spv::HasResultAndType(op, &has_result, &has_type);
      if (has_result && !has_type) types_.add(i, whole_constants_);
    }
  }
}

void Lowering::add_constant(const spirv::Instruction& i) {
  const uint32_t words = types_.at(i[1]).words;
  Value made{.type = i[1]};
  switch (spirv::opcode_of(i)) {
    case spv::OpConstant:
    case spv::OpSpecConstant:
      add_number(i, made);
      break;
    case spv::OpConstantTrue:
    case spv::OpSpecConstantTrue:
      made.source = constant(std::vector<uint32_t>{1});
      break;
    case spv::OpConstantComposite:
    case spv::OpSpecConstantComposite: {
      std::vector<uint32_t> all;
      std::vector<Source> parts;
      for (const uint32_t id : std::span(i).subspan(3)) {
        const Source from = parts.emplace_back(source(id));
        for (uint32_t word = from.at; from.constant && word < from.at + from.words; ++word)
          all.push_back(program_.constants[word]);
      }
      if (all.size() == words) {
        made.source = constant(all);
        break;
      }
      // Some parts are undefined.
      made.source = {.at = registers(words), .words = words};
      program_.prelude.push_back(
          {.execute = concatenate, .to = made.source.at, .words = words, .from = parts});
      break;
    }
    case spv::OpUndef:
      // Registers that nothing ever sets.
      made.source = {.at = registers(words), .words = words};
      program_.privates.emplace_back(made.source.at, words);
      break;
    default:
      made.source = constant(std::vector<uint32_t>(words));
  }
  values_[i[2]] = made;
}

void Lowering::add_number(const spirv::Instruction& i, Value& made) {
  const Type& type = types_.at(i[1]);
  uint64_t number = i[3] | (i.size() > 4 ? uint64_t{i[4]} << 32 : 0);
  const std::vector<uint32_t> words{
      uint32_t(number) & uint32_t((uint64_t{1} << std::min(type.bits, 32u)) - 1), uint32_t(number >> 32)};
  made.source = constant(std::span(words).first(type.words));
  if (type.is_signed && type.bits < 64) number = uint64_t(int64_t{int32_t(i[3])});
  whole_constants_[i[2]] = number;
}

void Lowering::add_global(const spirv::Instruction& i) {
  const Type& pointer = types_.at(i[1]);
  const Type& target = types_.at(pointer.element);
  const std::map<uint32_t, uint32_t>& decorations = decorations_[i[2]];
  Root root{.size = target.words, .name = names_[i[2]], .type = pointer.element};
  // An anonymous block has the name of its type alone.
  root.anonymous = root.name.empty();
  if (root.anonymous) root.name = names_[pointer.element];
  switch (pointer.storage) {
    case spv::StorageClassInput: {
      const auto kind = decorations.find(spv::DecorationBuiltIn);
      if (kind == decorations.end()) refuse(i);
      root.at = registers(target.words);
      program_.built_ins.push_back({spv::BuiltIn(kind->second), root.at});
      break;
    }
    case spv::StorageClassPrivate:
      root.at = registers(target.words);
      program_.privates.emplace_back(root.at, target.words);
      break;
    case spv::StorageClassWorkgroup:
      root.space = Space::shared;
      root.at = program_.shared;
      check_limit(uint64_t{program_.shared} + target.words, most_shared, "words of memory of a work group");
      program_.shared += target.words;
      break;
    case spv::StorageClassStorageBuffer:
    case spv::StorageClassUniform:
    case spv::StorageClassUniformConstant: {
      const auto binding = decorations.find(spv::DecorationBinding);
      const bool is_buffer = target.op == spv::OpTypeStruct;
      if (binding == decorations.end() || !(is_buffer || is_image(target))) refuse(i);
      root.space = is_buffer ? Space::buffer : Space::image;
      root.at = binding->second;
      break;
    }
    case spv::StorageClassPushConstant:
      root.space = Space::pushed;
      break;
    default:
      refuse(i);
  }
  values_[i[2]] = {.type = i[1], .source = pointer_to(0), .root = uint32_t(program_.roots.size())};
  program_.roots.push_back(root);
  if (i.size() > 4 && root.space != Space::own) refuse(i);
  if (i.size() > 4)
    program_.prelude.push_back({.execute = concatenate,
                                .to = root.at,
                                .words = root.size,
                                .from = {source(i[4])},
                                .location = location(i)});
}

}  // namespace eyeray::engine::emulator
