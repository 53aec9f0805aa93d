// Reads a kernel's bindings and sizes from its SPIR-V, so that the host need not repeat them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "host/gpu/texel_format.hpp"

namespace eyeray::engine::gpu {

struct ReflectedMember {
  std::string name;
  uint32_t offset = 0;  // bytes
};

// A struct with a memory layout, as some buffer or the push constants use it.
struct ReflectedStruct {
  std::string name;
  uint32_t size = 0;  // bytes, without a run-time array at the struct's end
  std::vector<ReflectedMember> members;
};

enum class BindingKind {
  storage,  // a storage buffer
  uniform,  // a uniform buffer
  texels,   // a storage texel buffer of four 32-bit unsigned integers a texel: uimageBuffer, rgba32ui
  image,    // a storage image, or a sampled one
};

struct Reflection {
  std::map<uint32_t, BindingKind> bindings;   // bindings of descriptor set 0
  std::map<uint32_t, ReflectedImage> images;  // those of BindingKind::image
  uint32_t push_constant_bytes = 0;
  std::array<uint32_t, 3> local_size{1, 1, 1};
  std::vector<ReflectedStruct> structs;
};

// Error (bad_input) when the words are not SPIR-V, or the shader declares anything but bindings of a
// BindingKind in set 0.
Reflection reflect(std::span<const uint32_t> spirv);

}  // namespace eyeray::engine::gpu
