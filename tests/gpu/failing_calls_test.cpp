// Every call of Vulkan may fail. Each failure gives one message and exit code 3, unless it only costs time:
// then the work goes on. There is never a crash or a hang, and nothing is left behind but objects that a busy
// device may still use.
#include <dlfcn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "child.hpp"
#include "host/core/process.hpp"
#include "host/gpu/instance.hpp"
#include "shim/failing_vulkan.hpp"
#include "tests/support/process.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

constexpr VkResult errors[] = {VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY,
                               VK_ERROR_DEVICE_LOST, VK_ERROR_INITIALIZATION_FAILED};

// The functions of the shim, which is opened but not linked.
template <typename Function>
Function* shim(const char* name) {
  static void* const library = dlopen(FAILING_VULKAN, RTLD_NOW | RTLD_LOCAL);
  void* function = library ? dlsym(library, name) : nullptr;
  if (!function) throw std::runtime_error(dlerror());
  return reinterpret_cast<Function*>(function);
}
#define SHIM(function) shim<decltype(function)>(#function)

// Everything that the layer does with a device: kernels from source and from the cache, buffers of both
// kinds, shared or staged, all ways of copying, and drawing.
void use_device(const std::string& cache_folder, bool staging) {
  const DiskCache cache{cache_folder};
  static const std::vector<uint32_t> spirv = compile(
      "#version 450\nlayout(local_size_x = 4) in;\nlayout(std430, binding = 0) buffer Data { uint data[]; "
      "};\n"
      "layout(binding = 1, rgba32ui) uniform readonly uimageBuffer texels;\n"
      "void main() { data[gl_GlobalInvocationID.x] += imageLoad(texels, 0).x; }\n");
  static const gpu::RasterShaders shaders = raster_shaders();
  gpu::Device device({.draws = true, .force_staging = staging});
  gpu::Buffer data(device, 16, "data");
  gpu::Buffer texels(device, 16, "texels", gpu::BindingKind::texels);
  gpu::Kernel kernel(device, spirv, "add", cache);
  kernel.set_buffer(0, data);
  kernel.set_buffer(1, texels);
  const uint32_t seven[] = {7, 7, 7, 7};
  data.clear();
  texels.upload_records(seven);
  gpu::dispatch(device, kernel, {}, {1});
  if (data.read_records<uint32_t>(4) != std::vector<uint32_t>{7, 7, 7, 7})
    throw std::runtime_error("wrong results");
  gpu::Rasterizer rasterizer(device, shaders, 2, 2);
  const gpu::RasterVertex whole[] = {{-1, -1, 1, 7}, {3, -1, 1, 7}, {-1, 3, 1, 7}};
  rasterizer.draw(whole);
  if (rasterizer.read().ids != std::vector<uint32_t>{7, 7, 7, 7}) throw std::runtime_error("a wrong picture");
}

// True if a failure of the function leaves a device that may still be at work.
bool may_be_busy(const std::string& function) {
  return function == "vkQueueSubmit" || function == "vkWaitForFences";
}

struct Case {
  int function;
  int number;
  VkResult result;
  bool staging;
};

// Calls use_device() in a separate process, in which one call fails. Returns the fault in its end, or "".
std::string fault_of(const Case& failing) {
  const std::string name = SHIM(function_name)(failing.function);
  const TemporaryFolder cache;
  const pid_t child = fork();
  if (child == 0) {
    ::alarm(60);
    const int alive_before = SHIM(objects_alive)();
    SHIM(fail_call)(name.c_str(), failing.number, failing.result);
    int status = 0;
    try {
      use_device(cache / "", failing.staging);
    } catch (const Error& error) {
      status = *error.what() ? int(error.code()) : 70;
    } catch (...) {
      status = 71;
    }
    // A device that may be busy keeps its objects; any other leaves none.
    if (may_be_busy(name) == (SHIM(objects_alive)() == alive_before)) status = 72;
    if (SHIM(calls)(failing.function) < failing.number) status = 73;
    std::exit(status);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) return fmt::format("signal {}", WTERMSIG(status));
  // The number of waits for a fence depends on the machine.
  if (WEXITSTATUS(status) == 73) return name == "vkWaitForFences" ? "" : "it was not called";
  if (WEXITSTATUS(status) == 72)
    return may_be_busy(name) ? "a busy device lost its objects" : "objects are left";
  const bool only_time = name == "vkCreatePipelineCache" || name == "vkGetPipelineCacheData";
  if (WEXITSTATUS(status) == (only_time ? 0 : 3)) return "";
  return fmt::format("status {}", WEXITSTATUS(status));
}

// The number of calls of each function if none fails.
std::vector<int> count_calls(bool staging) {
  const TemporaryFolder cache;
  std::vector<int> counts(size_t(SHIM(function_count)()));
  const size_t bytes = counts.size() * sizeof(int);
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  if (fork() == 0) {
    SHIM(fail_call)("", 0, 0);
    use_device(cache / "", staging);
    for (size_t i = 0; i < counts.size(); ++i) counts[i] = SHIM(calls)(int(i));
    _exit(::write(ends[1], counts.data(), bytes) == ssize_t(bytes) ? 0 : 1);
  }
  ::close(ends[1]);
  const bool counted = ::read(ends[0], counts.data(), bytes) == ssize_t(bytes);
  ::close(ends[0]);
  ::wait(nullptr);
  if (!counted) throw std::runtime_error("no call fails, and the work does");
  return counts;
}

}  // namespace

// Single-threaded, so that it may fork. Loads first the libraries that each process would take long to load.
void test::fail_every_call() {
  setenv("EYERAY_VULKAN_LOADER", FAILING_VULKAN, 1);
  const gpu::Instance warm(gpu::DeviceOptions{});
  const bool all = std::getenv("EYERAY_FULL_TESTS") != nullptr;
  int cases = 0;
  for (const bool staging : {false, true}) {
    if (!staging && !all) continue;  // staging makes more calls
    const std::vector<int> counts = count_calls(staging);
    for (int function = 0; function < int(counts.size()); ++function) {
      const int count = counts[size_t(function)];
      for (int number = 1; number <= count; ++number) {
        for (int error = 0; error < 4; ++error) {
          // Tests the first and the last call, with one of the errors in turn; or every call with all errors.
          if (!all && ((number > 1 && number < count) || error != (function + number) % 4)) continue;
          ++cases;
          const std::string fault = fault_of({function, number, errors[error], staging});
          if (fault.empty()) continue;
          fmt::print("{}, call {} of {}, {}: {}\n", SHIM(function_name)(function), number, count,
                     gpu::result_name(errors[error]), fault);
          std::fflush(stdout);
        }
      }
    }
  }
  fmt::print(stderr, "{} cases", cases);
}

TEST_CASE("any failing Vulkan call gives a message and exit code 3, or only costs time") {
  const ProcessResult result = run_process({"/proc/self/exe", "child", "failing calls"}, {}, 600);
  CHECK(result.code == 0);
  CHECK(result.out == "");
  MESSAGE(result.err);
}
