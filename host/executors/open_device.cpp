#include "host/executors/open_device.hpp"

#include <algorithm>

#include "host/core/content_hash.hpp"
#include "host/executors/shader_files.hpp"
#include "host/gpu/device_choice.hpp"

namespace eyeray::engine::executors {
namespace {

constexpr size_t most_kernels = 8;

// The results of the self-test. Kernels for the emulator are those for the device, so the device is tested.
gpu::DeviceFacts facts_of(gpu::Device& device, const GpuOptions& options, const DiskCache& cache) {
  if (device.info().compiles_only) return gpu::expected_of_gpus();
  if (options.emulate) {
    GpuOptions own = options;
    own.emulate = false;
    gpu::Device tested(device_options(own, false));
    return facts_of(tested, own, cache);
  }
  return gpu::self_test(
      device, [](std::string_view name) { return ShaderFiles({}, "").read(name); }, cache,
      options.worst_device);
}

}  // namespace

gpu::DeviceOptions device_options(const GpuOptions& options, bool wide_vectors) {
  gpu::DeviceOptions device;
  device.select = options.device;
  device.validation = options.validation;
  device.timeout_seconds = options.timeout_seconds;
  device.compile_seconds = std::max(options.timeout_seconds, options.least_compile_seconds);
  device.wide_vectors = wide_vectors;
  device.sets_environment = options.sets_environment;
  device.examines_kernels = options.examines_kernels;
  device.emulate = options.emulate;
  device.emulated_subgroup = options.emulated_subgroup;
  return device;
}

OpenDevice::OpenDevice(const GpuOptions& options, bool wide_vectors, StageTimes& times)
    : device_(times.measure("device", [&] { return gpu::Device(device_options(options, wide_vectors)); })),
      facts_(times.measure("self-test", [&] { return facts_of(device_, options, cache_); })) {}

std::shared_ptr<gpu::Kernel> OpenDevice::kernel(std::span<const uint32_t> spirv, const std::string& name) {
  const std::string hash = ContentHash().add(std::as_bytes(spirv)).hex();
  const auto found = std::ranges::find_if(
      built_, [&](const Built& each) { return each.hash == hash && each.kernel.use_count() == 1; });
  if (found != built_.end()) {
    built_.splice(built_.begin(), built_, found);
  } else {
    built_.push_front({hash, std::make_shared<gpu::Kernel>(device_, spirv, name, cache_)});
    if (built_.size() > most_kernels) built_.pop_back();
  }
  return built_.front().kernel;
}

gpu::KernelOptions kernel_options(const GpuOptions& options, OpenDevice& device) {
  gpu::KernelOptions how{.strict = device.device().info().float_modes,
                         .optimise = options.optimise,
                         .worst = options.worst_device,
                         .lines = options.emulate ? gpu::Lines::kept : gpu::Lines::dropped,
                         .validate = options.validate_spirv};
  how.exact = options.division == Division::exact ||
              (options.division == Division::automatic && !device.facts().exact_division);
  if (options.fast_math) how.strict = std::nullopt, how.exact = false;
  return how;
}

void check_device(const GpuOptions& options) {
  gpu::check_choice(device_options(options, false));
}

std::shared_ptr<OpenDevice> open_device(const GpuOptions& options) {
  StageTimes times;
  return std::make_shared<OpenDevice>(options, false, times);
}

}  // namespace eyeray::engine::executors
