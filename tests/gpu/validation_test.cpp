// The validation layers see nothing wrong with the calls of this layer, and would report any fault.
#include "host/gpu/context.hpp"
#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// Typical work: buffers, an upload, two dispatches, the second of which reads the first one's results, with a
// barrier between them or not, and a read. (The layer keeps silent about two dispatches that write one
// buffer: it cannot know which words.)
void use(gpu::Device& device, bool with_barrier) {
  gpu::Kernel increment(device, word_kernel("data[i] += 1u;"), "increment", no_cache);
  gpu::Kernel copy(device, compile(R"(#version 450
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Data { uint data[]; };
layout(std430, binding = 1) writeonly buffer Copied { uint copied[]; };
void main() { copied[gl_GlobalInvocationID.x] = data[gl_GlobalInvocationID.x]; }
)"),
                   "copy", no_cache);
  gpu::Buffer data(device, 64 * 4, "data"), copied(device, 64 * 4, "copied");
  data.upload_records(std::vector<uint32_t>(64, 3));
  increment.set_buffer(0, data);
  copy.set_buffer(0, data);
  copy.set_buffer(1, copied);
  gpu::CommandList list(device);
  list.dispatch(increment, {}, {});
  if (with_barrier) list.barrier();
  list.dispatch(copy, {}, {});
  list.run();
  copied.read();
}

}  // namespace

TEST_CASE("core and synchronisation validation report nothing") {
  for (const char* validation : {"core", "sync"}) {
    for (const bool force_staging : {false, true}) {
      gpu::Device device({.validation = validation, .force_staging = force_staging});
      use(device, true);
      gpu::self_test(device, project_shader, no_cache);
      CHECK(device.validation_messages() == std::vector<std::string>{});
    }
  }
}

TEST_CASE("core validation catches a canary: a buffer without bytes") {
  gpu::Device device({.validation = "core"});
  auto info = gpu::make<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  vkCreateBuffer(device.context()->device, &info, nullptr, &buffer);
  vkDestroyBuffer(device.context()->device, buffer, nullptr);
  const std::vector<std::string> messages = device.validation_messages();
  REQUIRE(!messages.empty());
  CHECK(contains(messages[0], "VUID-VkBufferCreateInfo-size-00912"));
}

TEST_CASE("synchronisation validation catches a canary: a missing barrier") {
  gpu::Device device({.validation = "sync"});
  use(device, false);
  const std::vector<std::string> messages = device.validation_messages();
  REQUIRE(!messages.empty());
  CHECK(contains(messages[0], "READ_AFTER_WRITE"));
}
