#include "host/compute/run.hpp"

#include <algorithm>
#include <map>

#include "host/compute/data_file.hpp"
#include "host/compute/module.hpp"
#include "host/core/error.hpp"
#include "host/gpu/command_list.hpp"
#include "host/gpu/emulation.hpp"
#include "host/gpu/float_policy.hpp"

namespace eyeray::engine::compute {
namespace {

void check_groups(const Job& job, const gpu::DeviceInfo& device) {
  for (size_t axis = 0; axis < 3; ++axis)
    if (job.groups[axis] > device.limits.groups[axis])
      throw Error(ExitCode::no_device, "{} has {} work groups along {}, but {} dispatches at most {}",
                  job.file, job.groups[axis], "xyz"[axis], device.name, device.limits.groups[axis]);
}

gpu::ImageShape shape_of(const JobBuffer& image) {
  gpu::ImageShape shape{.declared = image.slot.image};
  shape.declared.format = gpu::find_format(image.type->name);
  std::ranges::transform(image.type->extent, shape.extent.begin(),
                         [](uint64_t length) { return uint32_t(length); });
  return shape;
}

}  // namespace

Outcome run(const Job& job, const RunOptions& options) {
  gpu::DeviceOptions device_options = options.device;
  device_options.all_features = true;
  gpu::Device device(device_options);
  if (options.trace) gpu::trace(device, *options.trace);
  const gpu::DeviceInfo& info = device.info();
  check_groups(job, info);
  Outcome outcome;
  outcome.executor = options.device.emulate ? "emulator" : "gpu";
  outcome.description = options.device.emulate
                            ? fmt::format("emulator: subgroups of {}, as {} would get the kernel",
                                          info.limits.subgroup_size, info.name)
                            : fmt::format("gpu: {}, {}", info.name, info.driver_version);

  std::vector<uint32_t> spirv = job.spirv;
  if (!options.fast_math) {
    spirv = gpu::decorate_no_contraction(spirv);
    if (!has_float_modes(spirv)) spirv = gpu::set_float_modes(spirv, info.float_modes);
  }
  gpu::Kernel kernel(device, spirv, job.kernel, DiskCache::of_user());
  std::map<size_t, gpu::Buffer> buffers;
  std::map<size_t, gpu::Image> images;
  for (size_t i = 0; i < job.buffers.size(); ++i) {
    const JobBuffer& each = job.buffers[i];
    if (is_image(*each.type)) {
      gpu::Image& image = images.try_emplace(i, device, shape_of(each), each.slot.name).first->second;
      image.upload(each.bytes);
      kernel.set_image(uint32_t(i), image);
      continue;
    }
    gpu::Buffer& buffer =
        buffers.try_emplace(i, device, each.bytes.size(), each.slot.name, each.slot.kind).first->second;
    std::vector<std::byte> words = each.bytes;
    words.resize((words.size() + 3) / 4 * 4);
    buffer.upload(words);
    kernel.set_buffer(uint32_t(i), buffer);
  }
  outcome.seconds =
      gpu::dispatch(device, kernel, job.push, {job.groups[0], job.groups[1], job.groups[2]}).seconds;
  for (size_t i = 0; i < job.buffers.size(); ++i) {
    const auto all = images.contains(i) ? images.at(i).read() : buffers.at(i).read();
    const auto bytes = all.first(job.buffers[i].bytes.size());
    outcome.buffers.emplace_back(bytes.begin(), bytes.end());
  }
  outcome.findings = device.findings();
  outcome.validation_messages = device.validation_messages();
  return outcome;
}

void write_outputs(const Job& job, const Outcome& outcome) {
  for (size_t i = 0; i < job.buffers.size(); ++i) {
    const JobBuffer& buffer = job.buffers[i];
    if (!buffer.output.empty()) write_block(buffer.output, *buffer.type, outcome.buffers[i], buffer.width);
  }
}

}  // namespace eyeray::engine::compute
