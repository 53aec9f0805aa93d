// A Vulkan loader in front of the system's, for EYERAY_VULKAN_LOADER. It makes a slow, watched GPU of the
// device behind it:
//
// - The device states that it is a discrete GPU.
// - Its clock, which timestamps read, is not the machine's. A dispatch takes EYERAY_SLOW_WORKGROUP
// microseconds for
//   each workgroup, and EYERAY_SLOW_FACTOR times as long for the rows of a picture from EYERAY_SLOW_ROW on.
// - A draw takes EYERAY_SLOW_TRIANGLE microseconds for each triangle. No timestamps measure draws, so the
// thread
//   sleeps for as long.
// - A kernel may have EYERAY_SLOW_BUFFERS storage buffers. Without that variable the device's own limit
// stays.
//
// The file EYERAY_SLOW_LOG gets a line for each submission that dispatches or draws: its microseconds.
#include <dlfcn.h>
#include <unistd.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

double setting(const char* name) {
  const char* text = std::getenv(name);
  return text ? std::atof(text) : 0;
}

// The first members of Dispatch (shaders/records.h).
struct Push {
  uint32_t x, y, width, height, sample, depth, count, stride;
};

Push push = {};
bool renders = false;         // whether the last push constants were a Dispatch
double dispatched = 0;        // microseconds of the commands recorded since the last submission
double drawn = 0;             // the same of draws
uint64_t begin = 0, end = 0;  // the clock at the last submission's start and end, in ticks of 1 ns

PFN_vkGetPhysicalDeviceProperties real_properties;
void VKAPI_PTR properties(VkPhysicalDevice device, VkPhysicalDeviceProperties* result) {
  real_properties(device, result);
  result->deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
  result->limits.timestampPeriod = 1;
  if (std::getenv("EYERAY_SLOW_BUFFERS"))
    result->limits.maxPerStageDescriptorStorageBuffers = uint32_t(setting("EYERAY_SLOW_BUFFERS"));
}

PFN_vkCmdPushConstants real_push;
void VKAPI_PTR push_constants(VkCommandBuffer commands, VkPipelineLayout layout, VkShaderStageFlags stages,
                              uint32_t offset, uint32_t size, const void* values) {
  renders = size == sizeof push;
  if (renders) std::memcpy(&push, values, size);
  real_push(commands, layout, stages, offset, size, values);
}

// The factor by which a dispatch takes longer than if all its rows were cheap.
double slowness() {
  const double factor = setting("EYERAY_SLOW_FACTOR");
  if (push.height == 0 || factor == 0) return 1;
  const double first = (setting("EYERAY_SLOW_ROW") - push.y) / push.stride;
  const double cheap = std::clamp(first / push.height, 0.0, 1.0);
  return cheap + (1 - cheap) * factor;
}

PFN_vkCmdDispatch real_dispatch;
void VKAPI_PTR dispatch(VkCommandBuffer commands, uint32_t x, uint32_t y, uint32_t z) {
  if (renders) dispatched += double(x) * y * z * setting("EYERAY_SLOW_WORKGROUP") * slowness();
  real_dispatch(commands, x, y, z);
}

PFN_vkCmdDraw real_draw;
void VKAPI_PTR draw(VkCommandBuffer commands, uint32_t vertices, uint32_t instances, uint32_t first,
                    uint32_t first_instance) {
  drawn += vertices / 3 * setting("EYERAY_SLOW_TRIANGLE");
  real_draw(commands, vertices, instances, first, first_instance);
}

PFN_vkQueueSubmit real_submit;
VkResult VKAPI_PTR submit(VkQueue queue, uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
  if (const double microseconds = dispatched + drawn; microseconds > 0) {
    if (std::FILE* log = std::fopen(std::getenv("EYERAY_SLOW_LOG"), "a")) {
      std::fprintf(log, "%.0f\n", microseconds);
      std::fclose(log);
    }
  }
  ::usleep(useconds_t(drawn));
  begin = end;
  end += uint64_t(dispatched * 1000);
  dispatched = drawn = 0;
  return real_submit(queue, count, infos, fence);
}

PFN_vkGetQueryPoolResults real_results;
VkResult VKAPI_PTR results(VkDevice device, VkQueryPool pool, uint32_t first, uint32_t count, size_t bytes,
                           void* data, VkDeviceSize stride, VkQueryResultFlags flags) {
  const VkResult result = real_results(device, pool, first, count, bytes, data, stride, flags);
  const uint64_t ticks[] = {begin, end};
  if (bytes == sizeof ticks) std::memcpy(data, ticks, bytes);
  return result;
}

template <typename Function>
PFN_vkVoidFunction stand_in(PFN_vkVoidFunction real, Function& remembered, Function ours) {
  if (!real) return nullptr;
  remembered = reinterpret_cast<Function>(real);
  return reinterpret_cast<PFN_vkVoidFunction>(ours);
}

}  // namespace

extern "C" PFN_vkVoidFunction VKAPI_PTR vkGetInstanceProcAddr(VkInstance instance, const char* name) {
  static void* const library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  if (!library) return nullptr;
  static const auto loader =
      reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
  const PFN_vkVoidFunction real = loader(instance, name);
  const auto named = [&](const char* function) { return std::strcmp(name, function) == 0; };
  if (named("vkGetPhysicalDeviceProperties")) return stand_in(real, real_properties, &properties);
  if (named("vkCmdPushConstants")) return stand_in(real, real_push, &push_constants);
  if (named("vkCmdDispatch")) return stand_in(real, real_dispatch, &dispatch);
  if (named("vkCmdDraw")) return stand_in(real, real_draw, &draw);
  if (named("vkQueueSubmit")) return stand_in(real, real_submit, &submit);
  if (named("vkGetQueryPoolResults")) return stand_in(real, real_results, &results);
  return real;
}
