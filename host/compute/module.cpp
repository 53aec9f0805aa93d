#include "host/compute/module.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>

#include "host/core/error.hpp"
#include "host/spirv/module.hpp"
#include "host/spirv/words.hpp"

namespace eyeray::engine::compute {
namespace {

// A string as SPIR-V's words: with a zero at its end, padded by zeros.
std::vector<uint32_t> words_of(std::string_view text) {
  std::vector<uint32_t> words(text.size() / 4 + 1);
  std::memcpy(words.data(), text.data(), text.size());
  return words;
}

void set_length(spirv::Instruction& i) {
  i[0] = uint32_t(i.size()) << spv::WordCountShift | spirv::opcode_of(i);
}

void run_passes(spvtools::Optimizer& optimizer, std::vector<uint32_t>& spirv) {
  optimizer.SetMessageConsumer([](spv_message_level_t, const char*, const spv_position_t&, const char*) {});
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);
  if (!optimizer.Run(spirv.data(), spirv.size(), &spirv, options))
    throw Error(ExitCode::bad_input, "the passes of SPIRV-Tools fail on the kernel");
}

// Makes the local size that gl_WorkGroupSize has the literal of the execution mode.
void write_local_size(spirv::Module& module) {
  std::map<uint32_t, uint32_t> values;
  std::array<uint32_t, 3> size{};
  uint32_t built_in = 0;
  for (const spirv::Instruction& i : module.declarations) {
    const spv::Op op = spirv::opcode_of(i);
    if (op == spv::OpConstant) values[i[2]] = i[3];
    if (op == spv::OpDecorate && i[2] == spv::DecorationBuiltIn && i[3] == spv::BuiltInWorkgroupSize)
      built_in = i[1];
    if (op == spv::OpConstantComposite && i[2] == built_in) size = {values[i[3]], values[i[4]], values[i[5]]};
  }
  if (size[0] == 0) return;
  for (spirv::Instruction& i : module.declarations)
    if (spirv::opcode_of(i) == spv::OpExecutionMode && i[2] == spv::ExecutionModeLocalSize)
      std::ranges::copy(size, i.begin() + 3);
}

}  // namespace

void validate(std::span<const uint32_t> spirv, const std::string& name) {
  std::string messages;
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* message) {
    messages += (messages.empty() ? "" : "; ") + std::string(message);
  });
  if (tools.Validate(spirv.data(), spirv.size())) return;
  while (messages.ends_with('\n')) messages.pop_back();
  throw Error(ExitCode::bad_input, "{} is no valid SPIR-V for Vulkan 1.1: {}", name, messages);
}

std::vector<uint32_t> with_entry(std::span<const uint32_t> spirv, const std::string& entry,
                                 const std::string& name) {
  spirv::Module module = spirv::read(spirv);
  std::vector<std::string> names;
  uint32_t function = 0;
  size_t entries = 0;
  for (const spirv::Instruction& i : module.declarations) {
    if (spirv::opcode_of(i) != spv::OpEntryPoint) continue;
    ++entries;
    if (i[1] != spv::ExecutionModelGLCompute) continue;
    names.push_back(spirv::string_at(i, 3));
    if (names.back() == entry || entry.empty()) function = i[2];
  }
  if (names.empty()) throw Error(ExitCode::bad_input, "{} has no compute shader", name);
  if (function == 0 || (entry.empty() && names.size() > 1))
    throw Error(ExitCode::bad_input, "{} has the entry points {}: name one of them by `entry`{}", name,
                fmt::join(names, ", "), entry.empty() ? "" : fmt::format(", not \"{}\"", entry));

  std::erase_if(module.declarations, [&](const spirv::Instruction& i) {
    const spv::Op op = spirv::opcode_of(i);
    return (op == spv::OpEntryPoint && i[2] != function) ||
           ((op == spv::OpExecutionMode || op == spv::OpExecutionModeId) && i[1] != function);
  });
  for (spirv::Instruction& i : module.declarations) {
    if (spirv::opcode_of(i) != spv::OpEntryPoint) continue;
    const size_t old_words = spirv::string_at(i, 3).size() / 4 + 1;
    const std::vector<uint32_t> main = words_of("main");
    i.erase(i.begin() + 3, i.begin() + 3 + ptrdiff_t(old_words));
    i.insert(i.begin() + 3, main.begin(), main.end());
    set_length(i);
  }
  std::vector<uint32_t> result = spirv::write(module);
  if (entries == 1) return result;
  // Leave out the variables of the other entry points.
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
  optimizer.RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
      .RegisterPass(spvtools::CreateAggressiveDCEPass());
  run_passes(optimizer, result);
  return result;
}

std::vector<uint32_t> legalise(std::span<const uint32_t> spirv) {
  std::vector<uint32_t> words(spirv.begin(), spirv.end());
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
  optimizer.RegisterLegalizationPasses();
  run_passes(optimizer, words);
  return words;
}

std::vector<uint32_t> specialise(std::span<const uint32_t> spirv, const std::map<uint32_t, uint64_t>& bits) {
  std::vector<uint32_t> words(spirv.begin(), spirv.end());
  spirv::Module module = spirv::read(spirv);
  std::map<uint32_t, uint32_t> ids;  // by result
  for (spirv::Instruction& i : module.declarations) {
    const spv::Op op = spirv::opcode_of(i);
    if (op == spv::OpDecorate && i[2] == spv::DecorationSpecId) ids[i[1]] = i[3];
    const bool boolean = op == spv::OpSpecConstantTrue || op == spv::OpSpecConstantFalse;
    if (op != spv::OpSpecConstant && !boolean) continue;
    const auto id = ids.find(i[2]);
    const auto value = id == ids.end() ? bits.end() : bits.find(id->second);
    if (value == bits.end()) continue;
    if (boolean) {
      i[0] = 3u << spv::WordCountShift |
             uint32_t(value->second ? spv::OpSpecConstantTrue : spv::OpSpecConstantFalse);
    } else {
      i[3] = uint32_t(value->second);
      if (i.size() > 4) i[4] = uint32_t(value->second >> 32);
    }
  }
  words = spirv::write(module);
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
  optimizer.RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
  run_passes(optimizer, words);
  module = spirv::read(words);
  write_local_size(module);
  return spirv::write(module);
}

std::vector<uint32_t> in_one_set(std::span<const uint32_t> spirv, const Interface& interface) {
  spirv::Module module = spirv::read(spirv);
  std::map<uint32_t, std::pair<uint32_t, uint32_t>> places;  // set and binding, by variable
  for (const spirv::Instruction& i : module.declarations) {
    if (spirv::opcode_of(i) != spv::OpDecorate) continue;
    if (i[2] == spv::DecorationDescriptorSet) places[i[1]].first = i[3];
    if (i[2] == spv::DecorationBinding) places[i[1]].second = i[3];
  }
  for (spirv::Instruction& i : module.declarations) {
    if (spirv::opcode_of(i) != spv::OpDecorate) continue;
    if (i[2] == spv::DecorationDescriptorSet) i[3] = 0;
    if (i[2] != spv::DecorationBinding) continue;
    const auto slot = std::ranges::find_if(interface.buffers, [&](const BufferSlot& each) {
      return std::pair(each.set, each.binding) == places[i[1]];
    });
    i[3] = uint32_t(slot - interface.buffers.begin());
  }
  return spirv::write(module);
}

bool has_float_modes(std::span<const uint32_t> spirv) {
  const spirv::Module module = spirv::read(spirv);
  return std::ranges::any_of(module.declarations, [](const spirv::Instruction& i) {
    return spirv::opcode_of(i) == spv::OpExtension && spirv::string_at(i, 1) == "SPV_KHR_float_controls";
  });
}

std::vector<uint32_t> with_files(std::span<const uint32_t> spirv,
                                 const std::map<std::string, std::string>& shown) {
  spirv::Module module = spirv::read(spirv);
  for (spirv::Instruction& i : module.declarations) {
    if (spirv::opcode_of(i) != spv::OpString) continue;
    const auto name = shown.find(spirv::string_at(i, 2));
    if (name == shown.end()) continue;
    const std::vector<uint32_t> text = words_of(name->second);
    i.resize(2);
    i.insert(i.end(), text.begin(), text.end());
    set_length(i);
  }
  return spirv::write(module);
}

}  // namespace eyeray::engine::compute
