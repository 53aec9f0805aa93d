// Compiles entry shaders for a packed scene as the gpu executor does.
#pragma once

#include "host/executors/samples.hpp"
#include "host/executors/shader_files.hpp"
#include "host/executors/specialise.hpp"
#include "host/gpu/kernel_compiler.hpp"

namespace eyeray::engine::test {

inline gpu::ShaderSource entry_source(const char* entry, const records::PackedScene& scene,
                                      const executors::Specialisation& specialisation) {
  executors::ShaderFiles files({}, executors::specialise(scene, specialisation));
  return gpu::read_shader([&](std::string_view name) { return files.read(name); }, entry);
}

// The SPIR-V module as glslang writes it, with all functions.
inline std::vector<uint32_t> compile_entry(const char* entry, const records::PackedScene& scene,
                                           const executors::Specialisation& specialisation,
                                           const char* defines = "") {
  return gpu::compile_shader(entry_source(entry, scene, specialisation), defines).spirv;
}

// Objects beyond `t_max` do not occlude the ray.
inline shader::QueryRay query_ray(const Vec3& origin, const Vec3& direction, double t_max = 1e30) {
  return executors::to_query_ray({origin, direction, t_max}, Vec3(0));
}

}  // namespace eyeray::engine::test
