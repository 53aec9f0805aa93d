// The data that a kernel declares: its buffers and images, push constants and specialization constants.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/compute/type.hpp"
#include "host/gpu/reflect.hpp"

namespace eyeray::engine::compute {

// A binding: a buffer, or an image.
struct BufferSlot {
  std::string name;               // the name of the block or of the variable; else "set.binding"
  std::string variable;           // may be empty
  uint32_t set = 0, binding = 0;  // as the kernel declares them
  gpu::BindingKind kind = gpu::BindingKind::storage;
  TypePtr type;                 // a structure, the block; or an image without an extent
  gpu::ReflectedImage image{};  // an image's
  bool readable = true;         // false: declared writeonly
  bool writable = false;        // false: declared readonly, or a uniform buffer
};

struct SpecConstant {
  uint32_t id = 0;   // constant_id
  std::string name;  // may be empty
  Number number{};   // a boolean has a uint
  bool boolean = false;
  uint64_t bits = 0;  // the default
};

struct Interface {
  std::vector<BufferSlot> buffers;  // sorted by set and binding
  TypePtr push;                     // a structure; null: no push constants
  std::array<uint32_t, 3> local_size{1, 1, 1};
};

// The specialization constants of a module, sorted by id.
std::vector<SpecConstant> spec_constants(std::span<const uint32_t> spirv);

// An image of that format and so many axes, layers included, without an extent.
TypePtr image_type(const gpu::TexelFormat& format, uint32_t axes);

// The interface of a module with one entry point and no specialization constants. Error (bad_input), with the
// variable's name, if it binds anything but buffers and images.
Interface interface_of(std::span<const uint32_t> spirv);

}  // namespace eyeray::engine::compute
