#include "host/gpu/context.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <optional>

#include "host/core/error.hpp"
#include "host/core/option_text.hpp"
#include "host/core/stopwatch.hpp"
#include "host/core/termination.hpp"
#include "host/gpu/device_choice.hpp"
#include "host/gpu/kernel_features.hpp"
#include "host/gpu/memory.hpp"
#include "host/gpu/physical_device.hpp"

namespace eyeray::engine::gpu {

void record_barrier(VkCommandBuffer commands, VkPipelineStageFlags stages, VkAccessFlags written,
                    VkPipelineStageFlags later_stages, VkAccessFlags read) {
  auto barrier = make<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  barrier.srcAccessMask = written;
  barrier.dstAccessMask = read;
  vkCmdPipelineBarrier(commands, stages, later_stages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

Context::Context(const DeviceOptions& device_options, InstanceOnly)
    : options(device_options), emulates(options.emulate), instance(std::make_unique<Instance>(options)) {}

Context::Context(const DeviceOptions& device_options) : Context(device_options, InstanceOnly{}) {
  choose();
  if (emulates) {
    if (options.emulated_subgroup) info.limits.subgroup_size = options.emulated_subgroup;
    return;
  }
  create_device();
}

void Context::choose() {
  const std::vector<VkPhysicalDevice> handles = instance->physical_devices();
  std::vector<DeviceInfo> devices;
  for (VkPhysicalDevice handle : handles) devices.push_back(describe(handle, int(devices.size())));
  if (options.examines_kernels)
    for (DeviceInfo& each : devices) each.usable = each.usable || each.compiles_only;
  info = choose_device(devices, options.select);
  physical = handles[size_t(info.index)];
  vkGetPhysicalDeviceMemoryProperties(physical, &memory);
  const bool same_memory = info.type == DeviceType::cpu || info.type == DeviceType::integrated;
  shares_memory = (same_memory && !options.force_staging) || emulates;
}

void Context::create_device() {
  const ForeignCall driver(options.timeout_seconds, late_start(options.timeout_seconds));
  const std::optional<QueueFamily> drawing = options.draws ? graphics_queue_family(physical) : std::nullopt;
  draws = drawing.has_value();
  const QueueFamily family = drawing ? *drawing : *compute_queue_family(physical);
  const float priority = 1.0f;
  auto queue_info = make<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue_info.queueFamilyIndex = family.index;
  queue_info.queueCount = 1;
  queue_info.pQueuePriorities = &priority;
  auto device_info = make<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  device_info.queueCreateInfoCount = 1;
  device_info.pQueueCreateInfos = &queue_info;
  auto statistics = make<VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR);
  const char* const extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
  keeps_statistics = options.examines_kernels && has_kernel_statistics(physical);
  if (keeps_statistics) {
    statistics.pipelineExecutableInfo = VK_TRUE;
    device_info.pNext = &statistics;
    device_info.enabledExtensionCount = 1;
    device_info.ppEnabledExtensionNames = &extension;
  }
  std::optional<KernelFeatures> features;
  if (options.all_features) features.emplace(physical).enable(device_info);
  check(vkCreateDevice(physical, &device_info, nullptr, &device), "create a device");
  if (info.compiles_only) return;
  vkGetDeviceQueue(device, family.index, 0, &queue);

  auto pool_info = make<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool_info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool_info.queueFamilyIndex = family.index;
  check(vkCreateCommandPool(device, &pool_info, nullptr, &pool), "create a command pool");
  auto commands_info = make<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  commands_info.commandPool = pool;
  commands_info.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(device, &commands_info, &commands), "allocate a command buffer");
  const auto fence_info = make<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  check(vkCreateFence(device, &fence_info, nullptr, &fence), "create a fence");
  create_timestamps(family.timestamp_bits);
  require_room_in_files(*this, 0);
}

void Context::create_timestamps(uint32_t bits) {
  // Once anything was drawn, Mesa 22.3.6's llvmpipe writes both timestamps of a dispatch at the same time
  // (docs/lavapipe.md).
  if (bits == 0 || draws) return;
  auto query_info = make<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
  query_info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  query_info.queryCount = 2;
  check(vkCreateQueryPool(device, &query_info, nullptr, &timestamps), "create a query pool");
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical, &properties);
  timestamp_bits = bits;
  timestamp_seconds = double(properties.limits.timestampPeriod) * 1e-9;
}

Context::~Context() {
  if (abandoned) {
    instance.release();  // NOLINT: the driver still uses it
    return;
  }
  if (!device) return;
  vkDestroyQueryPool(device, timestamps, nullptr);
  vkDestroyFence(device, fence, nullptr);
  vkDestroyCommandPool(device, pool, nullptr);
  vkDestroyDevice(device, nullptr);
}

void Context::begin() {
  CHECK(!recording);
  CHECK(!abandoned);
  recording = true;
  dispatches.clear();
  if (emulates) return;
  auto info_begin = make<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  info_begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands, &info_begin), "begin a command buffer");
}

void Context::cancel() noexcept {
  if (!recording) return;
  recording = false;
  if (!emulates) vkResetCommandBuffer(commands, 0);
}

void Context::submit_and_wait(std::string_view what, double timeout_seconds) {
  CHECK(recording);
  recording = false;
  if (emulates) return emulate(what, timeout_seconds);
  check(vkEndCommandBuffer(commands), "end a command buffer");
  check(vkResetFences(device, 1, &fence), "reset a fence");
  auto submit = make<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  const ForeignCall call(timeout_seconds, time_out(what, timeout_seconds));
  const VkResult submitted = vkQueueSubmit(queue, 1, &submit, fence);
  if (submitted != VK_SUCCESS) abandon(failure(submitted, what));

  // Wait in slices, to notice Ctrl-C, after which the device has a moment to finish its work. A process that
  // goes on after a stop waits here, since it needs its device back.
  constexpr uint64_t slice = 20'000'000;
  constexpr double grace = 0.15;
  std::optional<Stopwatch> stopping;
  for (;;) {
    const VkResult result = vkWaitForFences(device, 1, &fence, VK_TRUE, slice);
    if (result == VK_SUCCESS) return;
    if (result != VK_TIMEOUT) abandon(failure(result, what));
    if (call.passed()) abandon(time_out(what, timeout_seconds));
    if (signalled() && !stopping) stopping.emplace();
    if (stopping && stopping->seconds() >= grace)
      abandon(Error(ExitCode::interrupted, "interrupted; the device was still busy and is left behind"));
  }
}

// Runs the recorded dispatches in order.
void Context::emulate(std::string_view what, double timeout_seconds) {
  const Stopwatch watch;
  const emulator::Work work{
      .subgroup_size = info.limits.subgroup_size,
      .order = options.emulated_descending ? emulator::Order::descending : emulator::Order::ascending,
      .watch =
          [&](uint64_t) {
            if (watch.seconds() > timeout_seconds) throw time_out(what, timeout_seconds);
            if (signalled()) throw Error(ExitCode::interrupted, "interrupted");
          },
      .findings = &findings,
      .trace = trace};
  for (const auto& dispatch : dispatches) dispatch(work);
}

Error Context::time_out(std::string_view what, double seconds) const {
  return {ExitCode::timed_out,
          "{} could not {} within {} s: look for a loop that does not end, or raise {} if the work is really "
          "that heavy",
          info.name,
          what,
          seconds,
          option_text("timeout")};
}

void Context::abandon(const Error& error) {
  // Tearing a busy driver down blocks or crashes (docs/lavapipe.md). So whichever way the process comes to
  // its exit, it ends there with its own status, before any library's destructors run.
  if (!abandoned) on_exit([](int status, void*) { std::fflush(nullptr), _exit(status); }, nullptr);
  abandoned = true;
  throw error;
}

}  // namespace eyeray::engine::gpu
