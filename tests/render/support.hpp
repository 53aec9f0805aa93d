// The entries, compiled for a packed scene as the gpu executor does it.
#pragma once

#include "gpu/float_policy.hpp"
#include "gpu/shader_compiler.hpp"
#include "render/shader_files.hpp"
#include "render/specialise.hpp"

namespace eyeray::test {

inline std::vector<uint32_t> compile_entry(const char* entry, const PackedScene& scene,
                                           const Specialisation& specialisation, const char* defines = "") {
  ShaderFiles files({}, specialise(scene, specialisation));
  const auto read = [&](std::string_view name) { return files.read(name); };
  return gpu::compile_shader(gpu::read_shader(read, entry), defines).spirv;
}

}  // namespace eyeray::test
