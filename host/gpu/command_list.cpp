#include "host/gpu/command_list.hpp"

#include <utility>

#include "host/core/error.hpp"
#include "host/core/stopwatch.hpp"
#include "host/gpu/kernel_objects.hpp"

namespace eyeray::engine::gpu {
CommandList::CommandList(Device& device) : context_(device.context()) {
  context_->begin();
  if (!context_->timestamps) return;
  vkCmdResetQueryPool(context_->commands, context_->timestamps, 0, 2);
  vkCmdWriteTimestamp(context_->commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, context_->timestamps, 0);
}

CommandList::~CommandList() {
  context_->cancel();
}

void CommandList::dispatch(const Kernel& kernel, std::span<const std::byte> push_constants, Groups groups) {
  CHECK(context_->recording);
  const Kernel::Objects& objects = *kernel.objects_;
  kernel.check_interface(push_constants.size());
  CHECK_LE(groups.x, context_->info.limits.groups[0]);
  CHECK_LE(groups.y, context_->info.limits.groups[1]);
  CHECK_LE(groups.z, context_->info.limits.groups[2]);
  name_ += (name_.empty() ? "'" : ", '") + kernel.name() + "'";
  if (context_->emulates) {
    context_->dispatches.push_back([&objects,
                                    pushed = std::vector(push_constants.begin(), push_constants.end()),
                                    groups](emulator::Work work) {
      work.buffers = objects.spans;
      work.images = objects.images;
      work.push_constants = pushed;
      objects.emulated->run(work, {groups.x, groups.y, groups.z});
    });
    return;
  }
  const VkCommandBuffer commands = context_->commands;
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, objects.pipeline);
  if (objects.set)
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, objects.layout, 0, 1, &objects.set, 0,
                            nullptr);
  if (kernel.reflection().push_constant_bytes > 0)
    vkCmdPushConstants(commands, objects.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       uint32_t(push_constants.size()), push_constants.data());
  vkCmdDispatch(commands, groups.x, groups.y, groups.z);
}

void CommandList::barrier() {
  if (context_->emulates) return;  // which runs dispatches in order
  record_barrier(context_->commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                 VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                 VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
}

RunTime CommandList::run() {
  return run(context_->options.timeout_seconds);
}

RunTime CommandList::run(double timeout_seconds) {
  // Let the host see the kernels' writes.
  if (!context_->emulates)
    record_barrier(context_->commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                   VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
  if (context_->timestamps)
    vkCmdWriteTimestamp(context_->commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, context_->timestamps, 1);
  const Stopwatch watch;
  context_->submit_and_wait(fmt::format("finish {}", name_), timeout_seconds);
  if (!context_->timestamps) return {watch.seconds(), false};

  // The counter may be narrower than 64 bits and wrap around.
  uint64_t ticks[2] = {};
  check(vkGetQueryPoolResults(context_->device, context_->timestamps, 0, 2, sizeof ticks, ticks,
                              sizeof ticks[0], VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "read its timestamps");
  const uint32_t unused = 64 - context_->timestamp_bits;
  return {double((ticks[1] - ticks[0]) << unused >> unused) * context_->timestamp_seconds, true};
}

RunTime dispatch(Device& device, const Kernel& kernel, std::span<const std::byte> push_constants,
                 Groups groups) {
  const Stopwatch watch;
  double compile_seconds = 0;
  if (!std::exchange(kernel.objects_->dispatched, true)) {
    CommandList compiling(device);
    compiling.dispatch(kernel, push_constants, {0, 0, 0});
    compiling.run(compiling.context_->options.compile_seconds);
    compile_seconds = watch.seconds();
  }
  CommandList list(device);
  list.dispatch(kernel, push_constants, groups);
  RunTime time = list.run();
  time.compile_seconds = compile_seconds;
  return time;
}

}  // namespace eyeray::engine::gpu
