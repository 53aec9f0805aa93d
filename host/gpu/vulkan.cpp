#include "host/gpu/vulkan.hpp"

#include "host/core/option_text.hpp"

namespace eyeray::engine::gpu {

std::string result_name(VkResult result) {
  switch (result) {
#define NAME(result) \
  case result:       \
    return #result
    NAME(VK_SUCCESS);
    NAME(VK_NOT_READY);
    NAME(VK_TIMEOUT);
    NAME(VK_INCOMPLETE);
    NAME(VK_ERROR_OUT_OF_HOST_MEMORY);
    NAME(VK_ERROR_OUT_OF_DEVICE_MEMORY);
    NAME(VK_ERROR_INITIALIZATION_FAILED);
    NAME(VK_ERROR_DEVICE_LOST);
    NAME(VK_ERROR_MEMORY_MAP_FAILED);
    NAME(VK_ERROR_LAYER_NOT_PRESENT);
    NAME(VK_ERROR_EXTENSION_NOT_PRESENT);
    NAME(VK_ERROR_FEATURE_NOT_PRESENT);
    NAME(VK_ERROR_INCOMPATIBLE_DRIVER);
    NAME(VK_ERROR_TOO_MANY_OBJECTS);
    NAME(VK_ERROR_FRAGMENTED_POOL);
    NAME(VK_ERROR_OUT_OF_POOL_MEMORY);
    NAME(VK_ERROR_FRAGMENTATION);
    NAME(VK_ERROR_VALIDATION_FAILED_EXT);
    NAME(VK_ERROR_INVALID_SHADER_NV);
    NAME(VK_ERROR_UNKNOWN);
#undef NAME
    default:
      return fmt::format("VkResult {}", int(result));
  }
}

Error failure(VkResult result, std::string_view what) {
  if (result == VK_ERROR_DEVICE_LOST)
    return {
        ExitCode::no_device,
        "the Vulkan device was lost while trying to {} (VK_ERROR_DEVICE_LOST): the driver stopped it, most "
        "often because a shader ran too long or reached outside its buffers; --validate=core may show more",
        what};
  return {ExitCode::no_device, "the Vulkan driver could not {}: {}", what, result_name(result)};
}

Error late_start(double seconds) {
  return {ExitCode::timed_out,
          "the Vulkan driver could not start within {} s: check whether its device hangs, or raise {}",
          seconds, option_text("timeout")};
}

void check(VkResult result, std::string_view what) {
  if (result != VK_SUCCESS) throw failure(result, what);
}

}  // namespace eyeray::engine::gpu
