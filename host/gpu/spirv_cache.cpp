#include "gpu/spirv_cache.hpp"

#include <cstring>

#include "core/content_hash.hpp"

namespace eyeray::gpu {

CompiledShader compile_shader(const ShaderSource& source, std::string_view preamble, const DiskCache& cache) {
  ContentHash hash;
  hash.add(compiler_version()).add(preamble).add(source.entry);
  for (const auto& [path, text] : source.files) hash.add(path).add(text);
  const std::string name = "spirv-" + hash.hex();

  if (const auto bytes = cache.load(name); bytes && bytes->size() % sizeof(uint32_t) == 0) {
    CompiledShader found;
    found.spirv.resize(bytes->size() / sizeof(uint32_t));
    std::memcpy(found.spirv.data(), bytes->data(), bytes->size());
    return found;
  }
  CompiledShader compiled = compile_shader(source, preamble);
  if (compiled.warnings.empty())
    cache.store(name, {reinterpret_cast<const char*>(compiled.spirv.data()),
                       compiled.spirv.size() * sizeof(uint32_t)});
  return compiled;
}

}  // namespace eyeray::gpu
