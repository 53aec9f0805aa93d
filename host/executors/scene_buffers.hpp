// The one list of the parts of a packed scene that are uploaded, and of their bindings.
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
  size_t record;  // bytes of one record
  bool texels;    // whether a profile may load it as a texel buffer (kernels/bindings.glsl)
  bool geometry;

  // A shader may read the first record of an empty list in a branch that is masked out.
  size_t size() const { return bytes.empty() ? record : bytes.size(); }
};

// The parts of a packed scene. `scene` must outlive them.
std::array<SceneBuffer, 16> scene_buffers(const records::PackedScene& scene);
// The buffer for kernels that load formulas' numbers. `words` must outlive it.
SceneBuffer formula_numbers_buffer(std::span<const uint32_t> words);
// The additional buffer of kernels/cooperative/bvh4.comp.glsl. `nodes` must outlive it.
SceneBuffer bvh4_buffer(std::span<const shader::uvec4> nodes);

}  // namespace eyeray::engine::executors
