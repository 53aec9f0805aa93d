#include "host/gpu/executable.hpp"

#include "host/gpu/kernel_objects.hpp"

namespace eyeray::engine::gpu {
namespace {

decltype(Statistic::value) value_of(const VkPipelineExecutableStatisticKHR& statistic) {
  switch (statistic.format) {
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR:
      return statistic.value.b32 == VK_TRUE;
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
      return statistic.value.i64;
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR:
      return statistic.value.u64;
    default:
      return statistic.value.f64;
  }
}

std::vector<Statistic> statistics_of(VkDevice device, VkPipeline pipeline, uint32_t index) {
  auto info = make<VkPipelineExecutableInfoKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR);
  info.pipeline = pipeline;
  info.executableIndex = index;
  constexpr const char* what = "state statistics of a kernel";
  uint32_t count = 0;
  check(vkGetPipelineExecutableStatisticsKHR(device, &info, &count, nullptr), what);
  std::vector found(
      count, make<VkPipelineExecutableStatisticKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR));
  check(vkGetPipelineExecutableStatisticsKHR(device, &info, &count, found.data()), what);
  std::vector<Statistic> statistics;
  for (const VkPipelineExecutableStatisticKHR& each : found)
    statistics.push_back({each.name, value_of(each)});
  return statistics;
}

}  // namespace

std::vector<Executable> Kernel::executables() const {
  if (!context_->keeps_statistics) return {};
  auto info = make<VkPipelineInfoKHR>(VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR);
  info.pipeline = objects_->pipeline;
  constexpr const char* what = "list the programs of a kernel";
  uint32_t count = 0;
  check(vkGetPipelineExecutablePropertiesKHR(context_->device, &info, &count, nullptr), what);
  std::vector found(
      count, make<VkPipelineExecutablePropertiesKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR));
  check(vkGetPipelineExecutablePropertiesKHR(context_->device, &info, &count, found.data()), what);
  std::vector<Executable> executables;
  for (uint32_t i = 0; i < count; ++i)
    executables.push_back(
        {found[i].name, found[i].subgroupSize, statistics_of(context_->device, objects_->pipeline, i)});
  return executables;
}

}  // namespace eyeray::engine::gpu
