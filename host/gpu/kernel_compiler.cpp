#include "host/gpu/kernel_compiler.hpp"

#include <cstring>
#include <spirv-tools/libspirv.hpp>

#include "host/core/content_hash.hpp"
#include "host/core/error.hpp"
#include "host/gpu/called_arithmetic.hpp"
#include "host/gpu/float_policy.hpp"
#include "host/gpu/spirv_optimiser.hpp"

namespace eyeray::engine::gpu {
namespace {

void validate(const std::vector<uint32_t>& spirv, const std::string& entry) {
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
  std::string messages;
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* message) {
    messages += (messages.empty() ? "" : "; ") + std::string(message);
  });
  if (!tools.Validate(spirv))
    throw Error(ExitCode::bad_input, "kernel '{}' compiles to SPIR-V that is not valid: {}", entry, messages);
}

const std::string& hash_of_sources() {
  static const std::string hash = [] {
    ContentHash all;
    for (const EmbeddedFile& file : own_sources()) all.add(file.name).add(file.text);
    return all.hex();
  }();
  return hash;
}

// Compiles a kernel, except for the float modes, which depend on the device.
CompiledShader compile(const ShaderSource& source, const std::string& preamble, const KernelOptions& options,
                       const DiskCache& cache) {
  ContentHash hash;
  hash.add(hash_of_sources())
      .add(compiler_version())
      .add(options.optimise ? optimiser_version(options.flatten) : "");
  hash.add(options.strict ? "strict" : "fast");
  if (options.lines == Lines::kept) hash.add("lines");
  hash.add(preamble).add(source.entry);
  for (const auto& [path, text] : source.files) hash.add(path).add(text);
  const std::string name = "spirv-" + hash.hex();

  if (const auto bytes = cache.load(name); bytes && bytes->size() % sizeof(uint32_t) == 0) {
    CompiledShader found;
    found.spirv.resize(bytes->size() / sizeof(uint32_t));
    std::memcpy(found.spirv.data(), bytes->data(), bytes->size());
    return found;
  }
  CompiledShader compiled = compile_shader(source, preamble, options.lines);
  if (options.exact) compiled.spirv = call_for_arithmetic(compiled.spirv, "exact");
  if (options.worst.division) compiled.spirv = call_for_arithmetic(compiled.spirv, "worst");
  if (options.strict) compiled.spirv = decorate_no_contraction(compiled.spirv);
  if (options.optimise) compiled.spirv = optimise(compiled.spirv, options.flatten);
  if (options.validate) validate(compiled.spirv, source.entry);
  if (compiled.warnings.empty())
    cache.store(name, {reinterpret_cast<const char*>(compiled.spirv.data()),
                       compiled.spirv.size() * sizeof(uint32_t)});
  return compiled;
}

}  // namespace

CompiledShader compile_kernel(const ShaderSource& source, std::string_view preamble,
                              const KernelOptions& options, const DiskCache& cache) {
  std::string defines(preamble);
  if (options.exact) defines += "#define EXACT_ARITHMETIC\n";
  if (options.worst.division) defines += "#define WORST_ARITHMETIC\n";
  CompiledShader compiled = compile(source, defines, options, cache);
  if (options.strict) {
    FloatModes modes = *options.strict;
    if (options.worst.denormals) modes.denorm_preserve = false;
    compiled.spirv = set_float_modes(compiled.spirv, modes);
  }
  if (options.worst != WorstDevice()) compiled.spirv = on_worst_device(compiled.spirv, options.worst);
  return compiled;
}

}  // namespace eyeray::engine::gpu
