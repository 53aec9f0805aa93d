// The entries, compiled for a packed scene as the gpu executor does it.
#pragma once

#include "host/executors/shader_files.hpp"
#include "host/executors/specialise.hpp"
#include "host/gpu/kernel_compiler.hpp"

namespace eyeray::test {

inline gpu::ShaderSource entry_source(const char* entry, const PackedScene& scene,
                                      const Specialisation& specialisation) {
  ShaderFiles files({}, specialise(scene, specialisation));
  return gpu::read_shader([&](std::string_view name) { return files.read(name); }, entry);
}

// As glslang leaves it, with all functions.
inline std::vector<uint32_t> compile_entry(const char* entry, const PackedScene& scene,
                                           const Specialisation& specialisation, const char* defines = "") {
  return gpu::compile_shader(entry_source(entry, scene, specialisation), defines).spirv;
}

}  // namespace eyeray::test
