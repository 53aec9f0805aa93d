// Tests that need a separate process: machines without Vulkan, and work that never ends.
#include <cstdio>
#include <cstdlib>

#include "child.hpp"
#include "host/core/process.hpp"
#include "host/core/termination.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// Work that outlasts any time-out here: 65 535 groups of as many iterations as the driver is willing to make.
void run_endless(double timeout_seconds) {
  watch_for_termination([](const Error& error) { std::fprintf(stderr, "%s\n", error.what()); });
  std::atexit([] { std::fputs("torn down\n", stderr); });
  gpu::Device device({.timeout_seconds = timeout_seconds});
  gpu::Kernel kernel(
      device,
      word_kernel("uint x = i; while (x != 0xffffffffu) x = (x * 1664525u + 1013904223u) & 0xfffffff7u;"
                  " data[0] = x;"),
      "endless", no_cache);
  gpu::Buffer data(device, 64, "data");
  kernel.set_buffer(0, data);
  std::fprintf(stderr, "started\n");
  gpu::dispatch(device, kernel, {}, {65535, 64});
}

ProcessResult run_child(const std::string& name, const Environment& environment = {},
                        int signal_after_ms = -1) {
  return run_process({"/proc/self/exe", "child", name}, environment, 60, signal_after_ms);
}

}  // namespace

void test::child_work(std::string_view name) {
  if (name == "failing calls") return fail_every_call();
  if (name == "endless") return run_endless(3);
  if (name == "endless, interrupted") return run_endless(60);
  for (const gpu::DeviceInfo& info : gpu::list_devices())
    std::printf("%d %s\n", info.index, info.name.c_str());
}

TEST_CASE("devices are listed, and standard error stays empty") {
  const ProcessResult result = run_child("list");
  CHECK(result.code == 0);
  CHECK(contains(result.out, "0 "));
  CHECK(result.err == "");
}

TEST_CASE("a machine without drivers gets a message on what to install") {
  for (const char* path : {"/nonexistent", "tests/gpu"}) {
    const ProcessResult result = run_child("list", {{"VK_DRIVER_FILES", path}, {"VK_ICD_FILENAMES", path}});
    CHECK(result.code == int(ExitCode::no_device));
    CHECK(contains(result.err, "there is no Vulkan driver on this machine (VK_ERROR_INCOMPATIBLE_DRIVER)"));
    CHECK(contains(result.err, "apt install mesa-vulkan-drivers"));
    CHECK(contains(result.err, std::string("VK_ICD_FILENAMES=") + path));
    CHECK(result.out == "");
  }
}

TEST_CASE("a machine without a loader gets a message on what to install") {
  // A missing library, and one that is no loader.
  for (const char* library : {"/nonexistent/libvulkan.so.1", "libm.so.6"}) {
    const ProcessResult result = run_child("list", {{"EYERAY_VULKAN_LOADER", library}});
    CHECK(result.code == int(ExitCode::no_device));
    CHECK(contains(result.err, "there is no Vulkan loader on this machine"));
    CHECK(contains(result.err, "apt install libvulkan1 mesa-vulkan-drivers"));
  }
}

TEST_CASE("work that does not end is timed out, and the process ends with its own status") {
  const ProcessResult result = run_child("endless");
  CHECK(result.code == int(ExitCode::timed_out));
  CHECK(contains(result.err, "could not finish 'endless' within 3 s"));
  CHECK(contains(result.err, "--timeout"));
  CHECK(!contains(result.err, "torn down"));  // no exit handler runs under a busy driver
  CHECK(result.seconds < 30);
}

TEST_CASE("Ctrl-C ends a wait for the device") {
  const ProcessResult result = run_child("endless, interrupted", {}, 1000);
  CHECK(result.code == int(ExitCode::interrupted));
  CHECK(contains(result.err, "interrupted"));
  CHECK(result.seconds < 20);
}
