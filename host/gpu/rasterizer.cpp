#include "host/gpu/rasterizer.hpp"

#include <algorithm>
#include <cstddef>

#include "host/core/error.hpp"
#include "host/core/stopwatch.hpp"
#include "host/core/termination.hpp"
#include "host/gpu/dispatch_size.hpp"
#include "host/gpu/raster_target.hpp"

namespace eyeray::engine::gpu {
namespace {

class StageModule {
 public:
  StageModule(const Context& context, std::span<const uint32_t> spirv) : context_(context) {
    auto info = make<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = spirv.size_bytes();
    info.pCode = spirv.data();
    check(vkCreateShaderModule(context.device, &info, nullptr, &module_), "load the shaders that draw");
  }
  ~StageModule() { vkDestroyShaderModule(context_.device, module_, nullptr); }
  StageModule(const StageModule&) = delete;
  StageModule& operator=(const StageModule&) = delete;

  VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits stage) const {
    auto info = make<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    info.stage = stage;
    info.module = module_;
    info.pName = "main";
    return info;
  }

 private:
  const Context& context_;
  VkShaderModule module_ = VK_NULL_HANDLE;
};

// Nothing is culled, nothing blended; the nearer fragment stays.
VkPipeline create_pipeline(const Context& context, const RasterTarget& target, VkPipelineLayout layout,
                           const RasterShaders& shaders) {
  const StageModule vertex(context, shaders.vertex), fragment(context, shaders.fragment);
  const VkPipelineShaderStageCreateInfo stages[] = {vertex.stage(VK_SHADER_STAGE_VERTEX_BIT),
                                                    fragment.stage(VK_SHADER_STAGE_FRAGMENT_BIT)};

  const VkVertexInputBindingDescription binding{0, sizeof(RasterVertex), VK_VERTEX_INPUT_RATE_VERTEX};
  const VkVertexInputAttributeDescription attributes[] = {
      {0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(RasterVertex, x)},
      {1, 0, VK_FORMAT_R32_UINT, offsetof(RasterVertex, id)}};
  auto input =
      make<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
  input.vertexBindingDescriptionCount = 1;
  input.pVertexBindingDescriptions = &binding;
  input.vertexAttributeDescriptionCount = 2;
  input.pVertexAttributeDescriptions = attributes;
  auto assembly = make<VkPipelineInputAssemblyStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;

  const VkExtent2D extent = target.extent();
  const VkViewport viewport{0, 0, float(extent.width), float(extent.height), 0, 1};
  const VkRect2D scissor{{0, 0}, extent};
  auto view = make<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
  view.viewportCount = view.scissorCount = 1;
  view.pViewports = &viewport;
  view.pScissors = &scissor;
  auto rasterization = make<VkPipelineRasterizationStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
  rasterization.polygonMode = VK_POLYGON_MODE_FILL;
  rasterization.cullMode = VK_CULL_MODE_NONE;
  rasterization.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  rasterization.lineWidth = 1;
  auto samples =
      make<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  auto depth =
      make<VkPipelineDepthStencilStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
  depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
  depth.depthCompareOp = VK_COMPARE_OP_GREATER;
  VkPipelineColorBlendAttachmentState written = {};
  written.colorWriteMask = VK_COLOR_COMPONENT_R_BIT;
  auto blend =
      make<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
  blend.attachmentCount = 1;
  blend.pAttachments = &written;

  auto info = make<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
  info.stageCount = 2;
  info.pStages = stages;
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &view;
  info.pRasterizationState = &rasterization;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.layout = layout;
  info.renderPass = target.pass();
  const double limit = context.options.compile_seconds;
  const ForeignCall compiler(limit, context.time_out("build the pipeline that draws", limit));
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateGraphicsPipelines(context.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
        "build the pipeline that draws");
  return pipeline;
}

// The pixels that a triangle may cover, and as many as its vertices are worth.
int64_t cost_of(const RasterVertex* corners, VkExtent2D extent) {
  constexpr int64_t vertices = 64;
  const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  const auto covered = [](float low, float high, uint32_t pixels) {
    return int64_t(std::max(0.f, std::min(high, 1.f) - std::max(low, -1.f)) / 2 * float(pixels)) + 1;
  };
  return covered(left, right, extent.width) * covered(top, bottom, extent.height) + vertices;
}

}  // namespace

struct Rasterizer::Objects {
  Objects(Device& device, int width, int height)
      : context(device.context()),
        size(device.info(), int64_t{1} << 32),
        target(context, uint32_t(width), uint32_t(height)),
        vertices(device, batch * 3 * sizeof(RasterVertex), "vertices") {}
  ~Objects() {
    if (context->abandoned) return;
    vkDestroyPipeline(context->device, pipeline, nullptr);
    vkDestroyPipelineLayout(context->device, layout, nullptr);
  }
  Objects(const Objects&) = delete;
  Objects& operator=(const Objects&) = delete;

  std::shared_ptr<Context> context;
  DispatchSize size;  // in pixels, as cost_of() counts them
  RasterTarget target;
  Buffer vertices;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
};

Rasterizer::Rasterizer(Device& device, const RasterShaders& shaders, int width, int height)
    : context_(device.context()) {
  CHECK(context_->options.draws);
  if (!context_->draws)
    throw Error(
        ExitCode::no_device,
        "{} has no graphics queue, so it cannot draw triangles: leave out --raster, or choose another "
        "--device",
        context_->info.name);
  objects_ = std::make_unique<Objects>(device, width, height);
  const auto layout = make<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  check(vkCreatePipelineLayout(context_->device, &layout, nullptr, &objects_->layout),
        "create a pipeline layout");
  objects_->pipeline = create_pipeline(*context_, objects_->target, objects_->layout, shaders);
}

Rasterizer::~Rasterizer() = default;

// The first triangles, as many as a watched device can draw in time.
Rasterizer::Draw Rasterizer::next_draw(std::span<const RasterVertex> vertices) const {
  const bool limited = watched(context_->info);
  const int64_t most = objects_->size.items();
  Draw draw;
  for (; draw.vertices < std::min(3 * batch, vertices.size()); draw.vertices += 3) {
    const int64_t cost = cost_of(&vertices[draw.vertices], objects_->target.extent());
    if (limited && draw.vertices > 0 && draw.cost + cost > most) break;
    draw.cost += cost;
  }
  return draw;
}

void Rasterizer::draw(std::span<const RasterVertex> vertices) {
  CHECK_EQ(vertices.size() % 3, 0u);
  while (!vertices.empty()) {
    const Draw next = next_draw(vertices);
    const auto some = vertices.first(next.vertices);
    vertices = vertices.subspan(next.vertices);
    objects_->vertices.upload_records(some);
    context_->begin();
    const VkCommandBuffer commands = context_->commands;

    // Makes bytes that were copied, or written by the processor, visible to the vertex shader.
    record_barrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_HOST_BIT,
                   VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_HOST_WRITE_BIT,
                   VK_PIPELINE_STAGE_VERTEX_INPUT_BIT, VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT);

    auto pass = make<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    pass.renderPass = objects_->target.pass();
    pass.framebuffer = objects_->target.framebuffer();
    pass.renderArea = {{0, 0}, objects_->target.extent()};
    vkCmdBeginRenderPass(commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, objects_->pipeline);
    const VkBuffer buffer = objects_->vertices.raw().handle();
    const VkDeviceSize first_byte = objects_->vertices.payload_offset();
    vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &first_byte);
    vkCmdDraw(commands, uint32_t(some.size()), 1, 0, 0);
    vkCmdEndRenderPass(commands);
    const Stopwatch watch;
    context_->submit_and_wait("draw triangles");
    objects_->size.took(next.cost, watch.seconds());
  }
}

RasterPicture Rasterizer::read() {
  context_->begin();
  objects_->target.record_copies();
  context_->submit_and_wait("copy a picture from the device");
  const VkExtent2D extent = objects_->target.extent();
  const size_t pixels = size_t{extent.width} * extent.height;
  const uint32_t* ids = objects_->target.ids();
  const float* depths = objects_->target.depths();
  return {{ids, ids + pixels}, {depths, depths + pixels}};
}

}  // namespace eyeray::engine::gpu
