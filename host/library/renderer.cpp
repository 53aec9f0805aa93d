// The renderer of the library, and the state that its calls share.
#include "host/library/renderer.hpp"

#include <unistd.h>

#include "host/executors/open_device.hpp"
#include "host/library/engine_call.hpp"

namespace eyeray::engine::library {

executors::Backend backend_of(v0::Backend backend) {
  switch (backend) {
    case v0::Backend::twin:
      return executors::Backend::twin;
    case v0::Backend::reference:
      return executors::Backend::reference;
    default:
      return executors::Backend::gpu;
  }
}

Rect rect_of(const v0::Rect& crop) {
  if (crop.width == 0 && crop.height == 0) return {};
  return {crop.x, crop.y, crop.width, crop.height};
}

namespace {

void open_device(v0::Renderer::Data& renderer, const executors::GpuOptions& options) {
  static std::atomic<pid_t> first_process = 0;
  pid_t process = 0;
  if (!first_process.compare_exchange_strong(process, ::getpid()) && process != ::getpid())
    throw Error(ExitCode::no_device,
                "this process was forked from one that had opened a Vulkan device, and lacks the driver's "
                "threads: start a new process (in Python, multiprocessing's \"spawn\"), fork before the "
                "first picture, or use the backend twin");
  if (renderer.device) return;
  std::shared_ptr<executors::OpenDevice> opened = executors::open_device(options);
  // A forked child cannot close the device either, which stays open until the child ends.
  renderer.device = {opened.get(), [opened, opener = ::getpid()](executors::OpenDevice*) mutable {
                       if (opener != ::getpid()) new std::shared_ptr(std::move(opened));
                     }};
}

executors::GpuOptions gpu_options(const v0::Renderer::Data& renderer) {
  executors::GpuOptions options;
  options.device = renderer.options.device;
  options.timeout_seconds = renderer.options.timeout_seconds;
  // The environment that a driver reads belongs to the process, and other threads may be reading it.
  options.sets_environment = false;
  return options;
}

}  // namespace

executors::ExecutorOptions executor_options(v0::Renderer::Data& renderer, bool gpu) {
  executors::ExecutorOptions options;
  options.gpu = gpu_options(renderer);
  options.shader_folder = renderer.options.shaders;
  options.twin.compile = !renderer.options.shaders.empty();
  if (gpu) open_device(renderer, options.gpu);
  options.gpu.open_device = renderer.device;
  return options;
}

std::function<void(const render::Progress&)> progress_of(
    const std::function<bool(const v0::Progress&)>& progress, const v0::Cancellation& cancellation) {
  if (!progress) return {};
  return [&progress, cancelled = v0::Cancellation(cancellation)](const render::Progress& now) mutable {
    if (now.samples_total == 0) return;  // kernels compile
    const double share = double(now.samples_done) / double(std::max<uint64_t>(now.samples_total, 1));
    const InsideCallback inside;
    if (!progress({std::min(share, 1.0), now.rays, now.seconds})) cancelled.request();
  };
}

void call_renderer(v0::Renderer::Data& renderer, const v0::Cancellation& cancellation,
                   const std::function<void()>& work) {
  const auto watched = [&] {
    try {
      work();
    } catch (const Error& error) {
      if (error.code() == ExitCode::no_device || error.code() == ExitCode::timed_out) renderer.device.reset();
      throw;
    }
  };
  call_engine(watched, &cancellation.data().requested);
}

}  // namespace eyeray::engine::library

namespace eyeray::inline v0 {

Cancellation::Cancellation() : data_(std::make_shared<Data>()) {}

void Cancellation::request() noexcept {
  data_->requested = true;
}

bool Cancellation::requested() const noexcept {
  return data_->requested;
}

Renderer::Renderer(const RendererOptions& options) : data_(std::make_unique<Data>(Data{options})) {
  const double seconds = options.timeout_seconds;
  if (!(seconds >= 0.001 && seconds <= 1e6))
    throw Error(ErrorKind::bad_input,
                fmt::format("`timeout` must be from 0.001 to 1000000 seconds, not {}", seconds));
  if (!options.shaders.empty() && !std::filesystem::is_directory(options.shaders))
    throw Error(ErrorKind::file_io, options.shaders.string() + ": no such folder of shaders");
  // Listing the devices takes time, so the default is not checked: nobody chose it.
  if (options.device != RendererOptions().device)
    engine::library::call_engine(
        [this] { engine::executors::check_device(engine::library::gpu_options(*data_)); });
}

Renderer::~Renderer() {
  // Closing the device calls the driver, which may serve only one call at a time.
  if (!data_ || !data_->device) return;
  try {
    engine::library::call_engine([this] { data_.reset(); });
  } catch (const Error&) {
    static_cast<void>(data_.release());  // we are inside a call, which may be using the device
  }
}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

}  // namespace eyeray::inline v0
