#include "host/gpu/spirv_optimiser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spirv/unified1/spirv.hpp>

#include <algorithm>
#include <map>
#include <spirv-tools/optimizer.hpp>

#include "host/gpu/selection_flattener.hpp"
#include "host/spirv/words.hpp"

namespace eyeray::engine::gpu {
namespace {

// Passes chosen by their savings for lavapipe and their own cost (docs/performance.md). Two are left out.
// With ssa-rewrite the driver is even faster, but some kernels are slower; eliminating common subexpressions
// gains nothing.
constexpr const char* within_functions[] = {
    "--eliminate-local-single-block",
    "--eliminate-local-single-store",
    "--scalar-replacement=0",
    "--convert-local-access-chains",
    "--eliminate-local-single-block",
    "--eliminate-local-single-store",
    "--ccp",
    "--eliminate-dead-branches",
    "--simplify-instructions",
    "--eliminate-dead-code-aggressive",
    "--merge-blocks",
};
constexpr const char* inlining[] = {
    "--merge-return",
    "--inline-entry-points-exhaustive",
    "--eliminate-dead-functions",
};

// The passes that flattening requires before it, and those after it.
constexpr const char* before_flattening[] = {
    "--ssa-rewrite",
    "--eliminate-dead-code-aggressive",
    "--simplify-instructions",
    "--merge-blocks",
};
constexpr const char* after_flattening[] = {
    "--simplify-instructions",
    "--eliminate-dead-code-aggressive",
    "--merge-blocks",
};

using Passes = std::vector<std::string>;

// Functions are made small before they are inlined, and again afterwards.
Passes passes(bool flatten) {
  Passes all;
  const auto add = [&](const auto& list) { all.insert(all.end(), std::begin(list), std::end(list)); };
  add(within_functions);
  add(inlining);
  add(within_functions);
  if (flatten) add(before_flattening);
  return all;
}

// The passes take some 10 µs for each instruction, and more in the largest modules. With functions inlined,
// the gallery, which has all shapes, has 290 000 instructions.
constexpr uint64_t most_inlined = 1 << 19;

// The number of instructions of the largest function after inlining every call. (GLSL has no recursion.)
uint64_t inlined_instructions(std::span<const uint32_t> spirv) {
  struct Function {
    uint64_t instructions = 0;
    std::vector<uint32_t> calls;
    bool counted = false;
  };
  std::map<uint32_t, Function> functions;
  Function* current = nullptr;
  spirv::for_each_instruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> instruction) {
    if (opcode == spv::OpFunction) current = &functions[instruction[2]];
    if (!current) return;
    ++current->instructions;
    if (opcode == spv::OpFunctionCall) current->calls.push_back(instruction[3]);
  });

  const auto count = [&](const auto& self, Function& function) -> uint64_t {
    if (!function.counted) {
      function.counted = true;
      for (const uint32_t callee : function.calls)
        function.instructions =
            std::min(function.instructions + self(self, functions[callee]), 2 * most_inlined);
    }
    return function.instructions;
  };
  uint64_t largest = 0;
  for (auto& [id, function] : functions) largest = std::max(largest, count(count, function));
  return largest;
}

// False if the passes cannot take the module.
bool run(const Passes& passes, std::vector<uint32_t>& spirv) {
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
  CHECK(optimizer.RegisterPassesFromFlags(passes));
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);
  return optimizer.Run(spirv.data(), spirv.size(), &spirv, options);
}

}  // namespace

std::vector<uint32_t> optimise(std::span<const uint32_t> spirv, bool flatten) {
  const std::vector<uint32_t> as_it_was(spirv.begin(), spirv.end());
  if (inlined_instructions(spirv) > most_inlined) return as_it_was;
  std::vector<uint32_t> result = as_it_was;
  bool taken = run(passes(flatten), result);
  if (taken && flatten) {
    result = flatten_selections(result);
    taken = run({std::begin(after_flattening), std::end(after_flattening)}, result);
  }
  return taken ? result : as_it_was;
}

std::string optimiser_version(bool flatten) {
  return fmt::format("{} {}", spvSoftwareVersionString(), fmt::join(passes(flatten), " "));
}

}  // namespace eyeray::engine::gpu
