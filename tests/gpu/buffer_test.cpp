#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

std::vector<uint32_t> numbers(size_t count) {
  std::vector<uint32_t> words(count);
  for (size_t i = 0; i < count; ++i) words[i] = uint32_t(i * 2654435761u);
  return words;
}

// Everything below holds where memory is shared and where bytes are copied through staging buffers.
void for_both_kinds(const std::function<void(gpu::Device&)>& test) {
  gpu::Device shared({}), staged({.force_staging = true});
  CHECK(!staged.shares_memory());
  for (gpu::Device* device : {&shared, &staged}) test(*device);
}

}  // namespace

TEST_CASE("a buffer begins as zeros and returns the uploaded bytes") {
  for_both_kinds([](gpu::Device& device) {
    for (const size_t count : {1u, 3u, 1000u, 1000000u}) {
      gpu::Buffer buffer(device, count * 4, "numbers");
      CHECK(buffer.size() == count * 4);
      CHECK(buffer.read_records<uint32_t>(count) == std::vector<uint32_t>(count));
      std::vector<uint32_t> words = numbers(count);
      buffer.upload_records(words);
      CHECK(buffer.read_records<uint32_t>(count) == words);
      const uint32_t last = 7;
      buffer.upload(std::as_bytes(std::span(&last, 1)), (count - 1) * 4);
      words.back() = last;
      CHECK(buffer.read_records<uint32_t>(count) == words);
      CHECK(buffer.read_records<uint32_t>(count / 2) ==
            std::vector(words.begin(), words.begin() + long(count / 2)));
      buffer.clear();
      CHECK(buffer.read_records<uint32_t>(count) == std::vector<uint32_t>(count));
    }
  });
}

TEST_CASE("a kernel reads and writes a buffer, and its time is measured") {
  for_both_kinds([](gpu::Device& device) {
    constexpr size_t count = 1 << 16;
    gpu::Kernel kernel(device, word_kernel("data[i] = data[i] * 3u + i;"), "triple", no_cache);
    gpu::Buffer buffer(device, count * 4, "data");
    std::vector<uint32_t> words = numbers(count);
    buffer.upload_records(words);
    kernel.set_buffer(0, buffer);
    kernel.set_buffer(5, buffer);  // a binding the shader lacks
    gpu::CommandList list(device);
    list.dispatch(kernel, {}, {count / 64});
    list.barrier();
    list.dispatch(kernel, {}, {count / 64});
    const gpu::RunTime time = list.run();
    CHECK(time.seconds > 0);
    CHECK(time.seconds < 10);
    for (uint32_t i = 0; i < count; ++i) words[i] = (words[i] * 3 + i) * 3 + i;
    CHECK(buffer.read_records<uint32_t>(count) == words);
  });
}

TEST_CASE("a list that was not run leaves the device usable") {
  gpu::Kernel kernel(device(), word_kernel("data[i] = 5u;", 1), "five", no_cache);
  gpu::Buffer buffer(device(), 4, "data");
  kernel.set_buffer(0, buffer);
  {
    gpu::CommandList(device()).dispatch(kernel, {}, {});
  }
  CHECK(buffer.read_records<uint32_t>(1)[0] == 0);
  gpu::dispatch(device(), kernel, {}, {});
  CHECK(buffer.read_records<uint32_t>(1)[0] == 5);
}

TEST_CASE("a guard that a shader overwrote is an error that states the position") {
  for_both_kinds([](gpu::Device& device) {
    gpu::Buffer buffer(device, 100 * 4, "pixels");
    const auto first = uint32_t(buffer.payload_offset() / 4);
    const auto overwrite = [&](uint32_t word) {
      gpu::Kernel kernel(device, word_kernel(fmt::format("data[{}] = 1u;", word), 1), "overwrite", no_cache);
      kernel.set_buffer_with_guards(0, buffer);
      gpu::dispatch(device, kernel, {}, {});
      return error_of([&] { buffer.read(); });
    };
    CHECK(overwrite(first).first == "");
    CHECK(overwrite(first + 99).first == "");
    const auto [after, code] = overwrite(first + 100);
    CHECK(code == ExitCode::no_device);
    CHECK(contains(after, "wrote outside buffer 'pixels' (400 bytes): the guard after at byte 400"));
    CHECK(contains(overwrite(first - 1).first, "the guard before at byte -4"));
  });
}

TEST_CASE("a buffer that the device cannot hold is refused with the numbers") {
  const gpu::DeviceLimits& limits = device().info().limits;
  const auto [text, code] = error_of([&] { gpu::Buffer(device(), limits.storage_range + 4, "giant"); });
  CHECK(code == ExitCode::no_device);
  CHECK(contains(text, "buffer 'giant'"));
  CHECK(contains(text, std::to_string(limits.storage_range + 4)));
  CHECK(contains(text, std::to_string(limits.storage_range)));
}

TEST_CASE("a kernel that wants more than the device has is refused with the numbers") {
  const uint32_t most = device().info().limits.group_invocations;
  // glslang's own limit is 1024 along x and y, so ask for both.
  const std::string text =
      "#version 450\nlayout(local_size_x = 1024, local_size_y = 1024) in;\nvoid main() {}\n";
  const auto [message, code] = error_of([&] { gpu::Kernel(device(), compile(text), "wide", no_cache); });
  CHECK(code == ExitCode::no_device);
  CHECK(contains(message, "1024 × 1024 × 1 invocations"));
  CHECK(contains(message, std::to_string(most)));
}
