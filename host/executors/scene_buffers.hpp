// What of a packed scene is uploaded, and to which binding: the one list of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "host/records/packer.hpp"

namespace eyeray::engine::executors {

struct SceneBuffer {
  uint32_t binding;  // records.h
  const char* name;
  std::span<const std::byte> bytes;
  size_t record;  // bytes of one
  bool texels;    // whether the profile may have it as a texel buffer (kernels/bindings.glsl)
  bool geometry;

  // A shader may look at the first record of an empty list in a branch that is masked out.
  size_t size() const { return bytes.empty() ? record : bytes.size(); }
};

// `scene` must stay.
std::array<SceneBuffer, 16> scene_buffers(const records::PackedScene& scene);
// What kernels need that load formulas' numbers; `words` must stay.
SceneBuffer formula_numbers_buffer(std::span<const uint32_t> words);
// What kernels/cooperative/bvh4.comp.glsl needs besides; `nodes` must stay.
SceneBuffer bvh4_buffer(std::span<const shader::uvec4> nodes);

}  // namespace eyeray::engine::executors
