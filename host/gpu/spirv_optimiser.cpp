#include "gpu/spirv_optimiser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <spirv-tools/optimizer.hpp>

#include "core/error.hpp"

namespace eyeray::gpu {
namespace {

// Chosen for what they save lavapipe and cost themselves (docs/performance.md). Not among them: values
// instead of variables across blocks (ssa-rewrite) and common subexpressions, with which the driver is a
// little faster still, and its kernels slower.
constexpr const char* within_functions[] = {
    "--eliminate-local-single-block",
    "--eliminate-local-single-store",
    "--eliminate-dead-code-aggressive",
    "--scalar-replacement=0",
    "--convert-local-access-chains",
    "--eliminate-local-single-block",
    "--eliminate-local-single-store",
    "--eliminate-dead-code-aggressive",
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

// Functions are made small before they are copied to where they are called, and again there.
std::vector<std::string> passes() {
  std::vector<std::string> all;
  const auto add = [&](const auto& list) { all.insert(all.end(), std::begin(list), std::end(list)); };
  add(within_functions);
  add(inlining);
  add(within_functions);
  return all;
}

}  // namespace

std::vector<uint32_t> optimise(std::span<const uint32_t> spirv) {
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
  CHECK(optimizer.RegisterPassesFromFlags(passes()));
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);
  std::vector<uint32_t> result;
  if (!optimizer.Run(spirv.data(), spirv.size(), &result, options)) return {spirv.begin(), spirv.end()};
  return result;
}

std::string optimiser_version() {
  return fmt::format("{} {}", spvSoftwareVersionString(), fmt::join(passes(), " "));
}

}  // namespace eyeray::gpu
