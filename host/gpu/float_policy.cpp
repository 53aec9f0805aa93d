#include "host/gpu/float_policy.hpp"

#include <spirv/unified1/spirv.hpp>

#include <set>
#include <string_view>

#include "host/spirv/words.hpp"

namespace eyeray::engine::gpu {

bool is_float_arithmetic(uint32_t opcode) {
  switch (opcode) {
    case spv::OpFNegate:
    case spv::OpFAdd:
    case spv::OpFSub:
    case spv::OpFMul:
    case spv::OpFDiv:
    case spv::OpFRem:
    case spv::OpFMod:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
    case spv::OpVectorTimesMatrix:
    case spv::OpMatrixTimesVector:
    case spv::OpMatrixTimesMatrix:
    case spv::OpOuterProduct:
    case spv::OpDot:
      return true;
    default:
      return false;
  }
}

namespace {

// True for the declaration of a type. The first one follows the module's annotations.
bool is_type(uint32_t opcode) {
  return opcode >= spv::OpTypeVoid && opcode <= spv::OpTypeForwardPointer;
}

void append(std::vector<uint32_t>& words, std::span<const uint32_t> instruction) {
  words.insert(words.end(), instruction.begin(), instruction.end());
}

void append(std::vector<uint32_t>& words, spv::Op opcode, std::initializer_list<uint32_t> operands) {
  words.push_back(uint32_t(operands.size() + 1) << 16 | uint32_t(opcode));
  words.insert(words.end(), operands);
}

void append_extension(std::vector<uint32_t>& words, std::string_view name) {
  const size_t length = name.size() / 4 + 1;  // a terminating zero included
  words.push_back(uint32_t(length + 1) << 16 | uint32_t(spv::OpExtension));
  for (size_t i = 0; i < length * 4; i += 4) {
    uint32_t word = 0;
    for (size_t j = i; j < i + 4 && j < name.size(); ++j) word |= uint32_t(uint8_t(name[j])) << 8 * (j - i);
    words.push_back(word);
  }
}

}  // namespace

std::vector<uint32_t> decorate_no_contraction(std::span<const uint32_t> spirv) {
  // Find the results to decorate, and those that are decorated already.
  std::set<uint32_t> results, decorated;
  spirv::for_each_instruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> instruction) {
    if (is_float_arithmetic(opcode)) results.insert(instruction[2]);
    if (opcode == spv::OpDecorate && instruction[2] == spv::DecorationNoContraction)
      decorated.insert(instruction[1]);
  });

  // Copy the module, with the new decorations behind its existing ones.
  std::vector<uint32_t> words(spirv.begin(), spirv.begin() + spirv::header_words);
  bool inserted = false;
  spirv::for_each_instruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> instruction) {
    if (!inserted && is_type(opcode)) {
      inserted = true;
      for (const uint32_t id : results)
        if (!decorated.contains(id))
          append(words, spv::OpDecorate, {id, uint32_t(spv::DecorationNoContraction)});
    }
    append(words, instruction);
  });
  return words;
}

std::vector<uint32_t> set_float_modes(std::span<const uint32_t> spirv, const FloatModes& modes) {
  struct Mode {
    bool wanted;
    spv::Capability capability;
    spv::ExecutionMode mode;
  };
  const Mode all[] = {
      {modes.denorm_preserve, spv::CapabilityDenormPreserve, spv::ExecutionModeDenormPreserve},
      {modes.round_to_nearest_even, spv::CapabilityRoundingModeRTE, spv::ExecutionModeRoundingModeRTE},
      {modes.signed_zero_inf_nan_preserve, spv::CapabilitySignedZeroInfNanPreserve,
       spv::ExecutionModeSignedZeroInfNanPreserve},
  };
  if (!modes.denorm_preserve && !modes.round_to_nearest_even && !modes.signed_zero_inf_nan_preserve)
    return {spirv.begin(), spirv.end()};

  // A module's order is capabilities, extensions, imports, memory model, entry points, execution modes.
  std::vector<uint32_t> words(spirv.begin(), spirv.begin() + spirv::header_words);
  for (const Mode& mode : all)
    if (mode.wanted) append(words, spv::OpCapability, {uint32_t(mode.capability)});
  std::vector<uint32_t> entry_points;
  bool extended = false, moded = false;
  spirv::for_each_instruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> instruction) {
    if (!extended && opcode != spv::OpCapability) {
      extended = true;
      append_extension(words, "SPV_KHR_float_controls");
    }
    if (opcode == spv::OpEntryPoint) {
      entry_points.push_back(instruction[2]);
    } else if (!entry_points.empty() && !moded) {
      moded = true;
      for (const uint32_t entry : entry_points)
        for (const Mode& mode : all)
          if (mode.wanted) append(words, spv::OpExecutionMode, {entry, uint32_t(mode.mode), 32u});
    }
    append(words, instruction);
  });
  return words;
}

}  // namespace eyeray::engine::gpu
