#include "failing_vulkan.hpp"

#include <dlfcn.h>
#include <unistd.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>

// The functions that the layer calls and that return a result. Those that make objects come first.
#define MAKERS(X)                \
  X(vkCreateInstance)            \
  X(vkCreateDevice)              \
  X(vkCreateCommandPool)         \
  X(vkCreateFence)               \
  X(vkCreateQueryPool)           \
  X(vkCreateBuffer)              \
  X(vkCreateBufferView)          \
  X(vkAllocateMemory)            \
  X(vkCreateShaderModule)        \
  X(vkCreatePipelineCache)       \
  X(vkCreateComputePipelines)    \
  X(vkCreatePipelineLayout)      \
  X(vkCreateDescriptorSetLayout) \
  X(vkCreateDescriptorPool)      \
  X(vkCreateImage)               \
  X(vkCreateImageView)           \
  X(vkCreateRenderPass)          \
  X(vkCreateFramebuffer)         \
  X(vkCreateGraphicsPipelines)
#define OTHERS(X)               \
  X(vkEnumerateInstanceVersion) \
  X(vkEnumeratePhysicalDevices) \
  X(vkAllocateCommandBuffers)   \
  X(vkAllocateDescriptorSets)   \
  X(vkBindBufferMemory)         \
  X(vkBindImageMemory)          \
  X(vkMapMemory)                \
  X(vkGetPipelineCacheData)     \
  X(vkBeginCommandBuffer)       \
  X(vkEndCommandBuffer)         \
  X(vkResetCommandBuffer)       \
  X(vkResetFences)              \
  X(vkQueueSubmit)              \
  X(vkWaitForFences)            \
  X(vkGetQueryPoolResults)
#define DESTROYERS(X)             \
  X(vkDestroyInstance)            \
  X(vkDestroyDevice)              \
  X(vkDestroyCommandPool)         \
  X(vkDestroyFence)               \
  X(vkDestroyQueryPool)           \
  X(vkDestroyBuffer)              \
  X(vkDestroyBufferView)          \
  X(vkFreeMemory)                 \
  X(vkDestroyShaderModule)        \
  X(vkDestroyPipelineCache)       \
  X(vkDestroyPipeline)            \
  X(vkDestroyPipelineLayout)      \
  X(vkDestroyDescriptorSetLayout) \
  X(vkDestroyDescriptorPool)      \
  X(vkDestroyImage)               \
  X(vkDestroyImageView)           \
  X(vkDestroyRenderPass)          \
  X(vkDestroyFramebuffer)

namespace {

#define ENUMERATOR(name) name##_id,
enum { MAKERS(ENUMERATOR) makers, other_ids = makers - 1, OTHERS(ENUMERATOR) functions };
#define NAME(name) #name,
constexpr const char* names[] = {MAKERS(NAME) OTHERS(NAME)};
static_assert(std::size(names) == functions);

std::atomic<int> counts[functions];
std::atomic<int> alive = 0;
std::atomic<int> failing_function = -1, failing_number = 0, failing_result = 0;

VkResult fail() {
  if (failing_result != never_returns) return VkResult(failing_result.load());
  std::fputs("hanging\n", stderr);
  while (true) ::pause();
}

template <int id, typename Function>
struct Call;

template <int id, typename... Arguments>
struct Call<id, VkResult(VKAPI_PTR*)(Arguments...)> {
  static inline VkResult(VKAPI_PTR* real)(Arguments...) = nullptr;
  static VkResult VKAPI_PTR call(Arguments... arguments) {
    const int number = ++counts[id];
    if (id == failing_function && number == failing_number) return fail();
    const VkResult result = real(arguments...);
    if (id < makers && result == VK_SUCCESS) ++alive;
    return result;
  }
};

template <typename Tag, typename Function>
struct Destroy;

template <typename Tag, typename Handle>
struct Destroy<Tag, void(VKAPI_PTR*)(Handle, const VkAllocationCallbacks*)> {
  static inline void(VKAPI_PTR* real)(Handle, const VkAllocationCallbacks*) = nullptr;
  static void VKAPI_PTR call(Handle handle, const VkAllocationCallbacks* callbacks) {
    if (handle) --alive;
    real(handle, callbacks);
  }
};

template <typename Tag, typename Handle>
struct Destroy<Tag, void(VKAPI_PTR*)(VkDevice, Handle, const VkAllocationCallbacks*)> {
  static inline void(VKAPI_PTR* real)(VkDevice, Handle, const VkAllocationCallbacks*) = nullptr;
  static void VKAPI_PTR call(VkDevice device, Handle handle, const VkAllocationCallbacks* callbacks) {
    if (handle) --alive;
    real(device, handle, callbacks);
  }
};

// If EYERAY_NO_GRAPHICS is set, no queue draws.
struct QueueFamilies {
  static inline PFN_vkGetPhysicalDeviceQueueFamilyProperties real = nullptr;
  static void VKAPI_PTR call(VkPhysicalDevice device, uint32_t* count, VkQueueFamilyProperties* families) {
    real(device, count, families);
    if (!families || !std::getenv("EYERAY_NO_GRAPHICS")) return;
    for (uint32_t i = 0; i < *count; ++i) families[i].queueFlags &= ~VkQueueFlags(VK_QUEUE_GRAPHICS_BIT);
  }
};

// The stand-in for one of the loader's functions; it remembers the real function.
template <typename Stand>
PFN_vkVoidFunction stand_in(PFN_vkVoidFunction real) {
  if (!real) return nullptr;
  Stand::real = reinterpret_cast<decltype(Stand::real)>(real);
  return reinterpret_cast<PFN_vkVoidFunction>(&Stand::call);
}

PFN_vkGetInstanceProcAddr open_loader() {
  void* library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  if (const char* chosen = std::getenv("EYERAY_FAILING_CALL")) {
    char function[64] = "";
    int number = 0, result = 0;
    if (std::sscanf(chosen, "%63s %d %d", function, &number, &result) == 3)
      fail_call(function, number, result);
  }
  return library ? reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"))
                 : nullptr;
}

}  // namespace

extern "C" {

void fail_call(const char* function, int number, int result) {
  failing_function = -1;
  for (int i = 0; i < functions; ++i) {
    counts[i] = 0;
    if (std::strcmp(function, names[i]) == 0) failing_function = i;
  }
  failing_number = number;
  failing_result = result;
}

int function_count() {
  return functions;
}
const char* function_name(int function) {
  return names[function];
}
int calls(int function) {
  return counts[function];
}
int objects_alive() {
  return alive;
}

PFN_vkVoidFunction VKAPI_PTR vkGetInstanceProcAddr(VkInstance instance, const char* name) {
  static const PFN_vkGetInstanceProcAddr loader = open_loader();
  if (!loader) return nullptr;
  const PFN_vkVoidFunction real = loader(instance, name);
#define CALL(function) \
  if (std::strcmp(name, #function) == 0) return stand_in<Call<function##_id, PFN_##function>>(real);
  MAKERS(CALL)
  OTHERS(CALL)
#define DESTROY(function)                                \
  if (std::strcmp(name, #function) == 0) {               \
    struct Tag;                                          \
    return stand_in<Destroy<Tag, PFN_##function>>(real); \
  }
  DESTROYERS(DESTROY)
  if (std::strcmp(name, "vkGetPhysicalDeviceQueueFamilyProperties") == 0)
    return stand_in<QueueFamilies>(real);
  return real;
}
}
