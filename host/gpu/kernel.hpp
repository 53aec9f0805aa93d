// A compute pipeline, and the buffers and images that it is bound to.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/core/disk_cache.hpp"
#include "host/gpu/buffer.hpp"
#include "host/gpu/executable.hpp"
#include "host/gpu/image.hpp"
#include "host/gpu/reflect.hpp"

namespace eyeray::engine::gpu {

struct Groups;
struct RunTime;

class Kernel {
 public:
  // The pipeline of `spirv`, whose entry point is "main"; `name` is for errors. The driver's compiled code is
  // kept in `cache`. Error (no_device) with the numbers if the shader needs more than the device has.
  Kernel(Device& device, std::span<const uint32_t> spirv, std::string name, const DiskCache& cache);
  ~Kernel();
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  const std::string& name() const { return name_; }
  const Reflection& reflection() const { return reflection_; }
  bool uses(uint32_t binding) const;
  // The seconds that the driver took to build the kernel. Some drivers compile it only when it first runs.
  double build_seconds() const { return build_seconds_; }
  // The driver's programs for this kernel. Empty unless DeviceOptions::examines_kernels is set and the driver
  // has VK_KHR_pipeline_executable_properties.
  std::vector<Executable> executables() const;

  // Binds `buffer`, which must outlive the kernel's dispatches. A binding that the shader does not have is
  // ignored.
  void set_buffer(uint32_t binding, const Buffer& buffer);
  // Binds `image`, likewise. Error (bad_input) if the shader declares another kind of image there.
  void set_image(uint32_t binding, const Image& image);
  // Tests: shows the shader the buffer's guards too, so that it can overwrite them.
  void set_buffer_with_guards(uint32_t binding, const Buffer& buffer);

 private:
  friend class CommandList;
  friend RunTime dispatch(Device&, const Kernel&, std::span<const std::byte>, Groups);
  struct Objects;  // Vulkan's objects

  // Error (bad_input) if the shader, which may be a user's, declares push constants of another size, or a
  // buffer or image that is not bound. A shader may also declare none.
  void check_interface(size_t push_constant_bytes) const;

  void create_layout();
  void create_pipeline(std::span<const uint32_t> spirv, const DiskCache& cache);
  void bind(uint32_t binding, const Buffer& buffer, size_t offset, size_t bytes);
  // Error (bad_input) if the shader declares another kind of binding there.
  void check_kind(uint32_t binding, BindingKind bound) const;

  std::shared_ptr<Context> context_;
  std::string name_;
  Reflection reflection_;
  std::unique_ptr<Objects> objects_;
  double build_seconds_ = 0;
};

}  // namespace eyeray::engine::gpu
