#include "host/gpu/kernel.hpp"

#include <algorithm>
#include <optional>

#include "host/core/content_hash.hpp"
#include "host/core/error.hpp"
#include "host/core/option_text.hpp"
#include "host/core/stopwatch.hpp"
#include "host/core/termination.hpp"
#include "host/gpu/image_objects.hpp"
#include "host/gpu/kernel_objects.hpp"
#include "host/gpu/raw_buffer.hpp"

namespace eyeray::engine::gpu {
namespace {

const char* kind_name(BindingKind kind) {
  switch (kind) {
    case BindingKind::texels:
      return "a texel buffer";
    case BindingKind::uniform:
      return "a uniform buffer";
    case BindingKind::image:
      return "an image";
    case BindingKind::storage:
      break;
  }
  return "a storage buffer";
}

VkDescriptorType descriptor_type(const Reflection& reflection, uint32_t binding) {
  switch (reflection.bindings.at(binding)) {
    case BindingKind::texels:
      return VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
    case BindingKind::uniform:
      return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case BindingKind::image: {
      const ReflectedImage& image = reflection.images.at(binding);
      return image.combined  ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
             : image.sampled ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE
                             : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    }
    case BindingKind::storage:
      break;
  }
  return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

void check_limits(const Reflection& reflection, const Context& context, const std::string& name) {
  const DeviceInfo& device = context.info;
  const std::array<uint32_t, 3>& size = reflection.local_size;
  const uint64_t invocations = uint64_t{size[0]} * size[1] * size[2];
  bool fits = invocations <= device.limits.group_invocations;
  for (size_t axis = 0; axis < 3; ++axis) fits = fits && size[axis] <= device.limits.group_size[axis];
  if (!fits)
    throw Error(ExitCode::no_device,
                "kernel '{}' has work groups of {} × {} × {} invocations, but {} runs at most {}", name,
                size[0], size[1], size[2], device.name, device.limits.group_invocations);
  if (reflection.push_constant_bytes > device.limits.push_constants)
    throw Error(ExitCode::no_device, "kernel '{}' has {} bytes of push constants, but {} takes at most {}",
                name, reflection.push_constant_bytes, device.name, device.limits.push_constants);
  std::map<VkDescriptorType, uint32_t> counts;
  for (const auto& [binding, kind] : reflection.bindings) ++counts[descriptor_type(reflection, binding)];
  const auto check_count = [&](std::string_view what, uint32_t count, uint32_t most) {
    if (count > most)
      throw Error(
          ExitCode::no_device,
          "kernel '{}' has {} {}, but {} lets a kernel have at most {}: choose another device with {}", name,
          count, what, device.name, most, option_text("device"));
  };
  const DeviceLimits& limits = device.limits;
  check_count("storage buffers", counts[VK_DESCRIPTOR_TYPE_STORAGE_BUFFER], limits.storage_buffers);
  check_count("uniform buffers", counts[VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER], limits.uniform_buffers);
  check_count("texel buffers and storage images",
              counts[VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER] + counts[VK_DESCRIPTOR_TYPE_STORAGE_IMAGE],
              limits.texel_buffers);
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(context.physical, &properties);
  check_count("sampled images",
              counts[VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE] + counts[VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER],
              std::min(properties.limits.maxPerStageDescriptorSampledImages,
                       properties.limits.maxPerStageDescriptorSamplers));
}

// A pipeline cache that is loaded from disk, and stored there again if the driver added to it. A failure of
// the cache costs only time.
class PipelineCache {
 public:
  PipelineCache(const Context& context, std::span<const uint32_t> spirv, const DiskCache& disk)
      : context_(context),
        disk_(disk),
        name_(fmt::format("pipeline-{}-{}", context.info.driver_id,
                          ContentHash().add(std::as_bytes(spirv)).hex())),
        loaded_(disk.load(name_).value_or("")) {
    auto info = make<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
    info.initialDataSize = loaded_.size();
    info.pInitialData = loaded_.data();
    if (vkCreatePipelineCache(context.device, &info, nullptr, &cache_) != VK_SUCCESS) cache_ = VK_NULL_HANDLE;
  }
  ~PipelineCache() { vkDestroyPipelineCache(context_.device, cache_, nullptr); }
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  VkPipelineCache handle() const { return cache_; }  // null: no cache

  void save() const {
    size_t size = 0;
    if (!cache_ || vkGetPipelineCacheData(context_.device, cache_, &size, nullptr) != VK_SUCCESS) return;
    std::string data(size, '\0');
    if (vkGetPipelineCacheData(context_.device, cache_, &size, data.data()) != VK_SUCCESS) return;
    data.resize(size);
    if (data != loaded_) disk_.store(name_, data);
  }

 private:
  const Context& context_;
  const DiskCache& disk_;
  std::string name_;
  std::string loaded_;
  VkPipelineCache cache_ = VK_NULL_HANDLE;
};

class ShaderModule {
 public:
  ShaderModule(const Context& context, std::span<const uint32_t> spirv, const std::string& kernel)
      : context_(context) {
    auto info = make<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = spirv.size_bytes();
    info.pCode = spirv.data();
    check(vkCreateShaderModule(context.device, &info, nullptr, &module_),
          fmt::format("load kernel '{}'", kernel));
  }
  ~ShaderModule() { vkDestroyShaderModule(context_.device, module_, nullptr); }
  ShaderModule(const ShaderModule&) = delete;
  ShaderModule& operator=(const ShaderModule&) = delete;

  VkShaderModule handle() const { return module_; }

 private:
  const Context& context_;
  VkShaderModule module_ = VK_NULL_HANDLE;
};

}  // namespace

Kernel::Kernel(Device& device, std::span<const uint32_t> spirv, std::string name, const DiskCache& cache)
    : context_(device.context()),
      name_(std::move(name)),
      reflection_(reflect(spirv)),
      objects_(std::make_unique<Objects>(context_)) {
  check_limits(reflection_, *context_, name_);
  if (context_->emulates) {
    objects_->emulated = std::make_unique<emulator::Kernel>(spirv, name_);
    return;
  }
  create_layout();
  create_pipeline(spirv, cache);
}

Kernel::~Kernel() = default;

void Kernel::create_layout() {
  // Make one descriptor set with the buffers and images that the shader declares.
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  std::vector<VkDescriptorPoolSize> pool_sizes;
  for (const auto& [binding, kind] : reflection_.bindings) {
    const VkDescriptorType type = descriptor_type(reflection_, binding);
    bindings.push_back({binding, type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    pool_sizes.push_back({type, 1});
  }
  auto set_info = make<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set_info.bindingCount = uint32_t(bindings.size());
  set_info.pBindings = bindings.data();
  check(vkCreateDescriptorSetLayout(context_->device, &set_info, nullptr, &objects_->set_layout),
        "create a descriptor layout");

  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, reflection_.push_constant_bytes};
  auto layout_info = make<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout_info.setLayoutCount = 1;
  layout_info.pSetLayouts = &objects_->set_layout;
  layout_info.pushConstantRangeCount = push.size > 0 ? 1 : 0;
  layout_info.pPushConstantRanges = &push;
  check(vkCreatePipelineLayout(context_->device, &layout_info, nullptr, &objects_->layout),
        "create a pipeline layout");

  if (bindings.empty()) return;
  auto pool_info = make<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = uint32_t(pool_sizes.size());
  pool_info.pPoolSizes = pool_sizes.data();
  check(vkCreateDescriptorPool(context_->device, &pool_info, nullptr, &objects_->pool),
        "create a descriptor pool");
  auto allocate = make<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  allocate.descriptorPool = objects_->pool;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &objects_->set_layout;
  check(vkAllocateDescriptorSets(context_->device, &allocate, &objects_->set), "allocate a descriptor set");
}

void Kernel::create_pipeline(std::span<const uint32_t> spirv, const DiskCache& disk) {
  const ShaderModule module(*context_, spirv, name_);
  auto info = make<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  info.stage = make<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module.handle();
  info.stage.pName = "main";
  info.layout = objects_->layout;
  // A kernel whose build is examined is built anew.
  if (context_->keeps_statistics) info.flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
  std::optional<PipelineCache> cache;
  if (!context_->options.examines_kernels) cache.emplace(*context_, spirv, disk);
  const std::string what = fmt::format("build kernel '{}'", name_);
  {
    const double limit = context_->options.compile_seconds;
    const ForeignCall compiler(limit, context_->time_out(what, limit));
    const Stopwatch watch;
    check(vkCreateComputePipelines(context_->device, cache ? cache->handle() : VK_NULL_HANDLE, 1, &info,
                                   nullptr, &objects_->pipeline),
          what);
    build_seconds_ = watch.seconds();
  }
  if (cache) cache->save();
}

void Kernel::check_interface(size_t push_constant_bytes) const {
  const uint32_t wanted = reflection_.push_constant_bytes;
  if (wanted != 0 && wanted != push_constant_bytes)
    throw Error(ExitCode::bad_input,
                "kernel '{}' declares {} bytes of push constants, but eyeray sets {}: declare them as "
                "eyeray's own kernel does",
                name_, wanted, push_constant_bytes);
  for (const auto& [binding, kind] : reflection_.bindings) {
    if (!objects_->bound.contains(binding))
      throw Error(ExitCode::bad_input, "kernel '{}' reads binding {}, for which eyeray binds nothing", name_,
                  binding);
  }
}

bool Kernel::uses(uint32_t binding) const {
  return reflection_.bindings.contains(binding);
}

void Kernel::set_buffer(uint32_t binding, const Buffer& buffer) {
  bind(binding, buffer, buffer.payload_offset(), buffer.size());
}

void Kernel::check_kind(uint32_t binding, BindingKind bound) const {
  const BindingKind kind = reflection_.bindings.at(binding);
  if (bound != kind)
    throw Error(ExitCode::bad_input,
                "kernel '{}' declares binding {} as {}, but eyeray binds {}: declare it "
                "as eyeray's own kernels/bindings.glsl does",
                name_, binding, kind_name(kind), kind_name(bound));
}

void Kernel::set_image(uint32_t binding, const Image& image) {
  if (!uses(binding)) return;
  check_kind(binding, BindingKind::image);
  const ReflectedImage &declared = reflection_.images.at(binding), &bound = image.shape().declared;
  if (declared.axes != bound.axes || declared.arrayed != bound.arrayed || declared.sampled != bound.sampled ||
      (declared.format && declared.format != bound.format))
    throw Error(ExitCode::bad_input, "kernel '{}' declares another kind of image at binding {}", name_,
                binding);
  if (context_->info.compiles_only) return;  // images have no memory there
  objects_->bound.insert(binding);
  if (context_->emulates) {
    objects_->images[binding] = {
        image.shape().extent, bound.format->numbers, {image.copy_->mapped(), image.size()}};
    return;
  }
  VkDescriptorImageInfo info = {};
  info.imageView = image.objects_->view;
  info.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
  if (declared.combined) info.sampler = objects_->any_sampler();
  auto write = make<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
  write.dstSet = objects_->set;
  write.dstBinding = binding;
  write.descriptorCount = 1;
  write.descriptorType = descriptor_type(reflection_, binding);
  write.pImageInfo = &info;
  vkUpdateDescriptorSets(context_->device, 1, &write, 0, nullptr);
}

void Kernel::set_buffer_with_guards(uint32_t binding, const Buffer& buffer) {
  bind(binding, buffer, 0, buffer.size() + 2 * buffer.payload_offset());
}

void Kernel::bind(uint32_t binding, const Buffer& buffer, size_t offset, size_t bytes) {
  if (!uses(binding)) return;
  const BindingKind kind = reflection_.bindings.at(binding);
  check_kind(binding, buffer.kind());
  if (context_->info.compiles_only) return;  // buffers have no memory there
  objects_->bound.insert(binding);
  if (context_->emulates) {
    objects_->spans[binding] = {buffer.raw().mapped() + offset, bytes};
    return;
  }
  const VkDescriptorBufferInfo info{buffer.raw().handle(), offset, bytes};
  VkBufferView view = VK_NULL_HANDLE;
  auto write = make<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
  write.dstSet = objects_->set;
  write.dstBinding = binding;
  write.descriptorCount = 1;
  write.descriptorType = descriptor_type(reflection_, binding);
  write.pBufferInfo = &info;
  if (kind == BindingKind::texels) {
    view = objects_->make_view(binding, buffer.raw().handle(), offset, bytes);
    write.pTexelBufferView = &view;
  }
  vkUpdateDescriptorSets(context_->device, 1, &write, 0, nullptr);
}

}  // namespace eyeray::engine::gpu
