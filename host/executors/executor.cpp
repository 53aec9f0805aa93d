#include "host/executors/executor.hpp"

#include "host/core/error.hpp"
#include "host/executors/executors.hpp"

namespace eyeray::engine::executors {

Backend parse_backend(std::string_view name) {
  for (const Backend backend : {Backend::gpu, Backend::twin, Backend::reference, Backend::emulator}) {
    if (name == backend_name(backend)) return backend;
  }
  throw Error(ExitCode::bad_input, "no backend is named '{}': choose gpu, twin, reference or emulator", name);
}

std::string_view backend_name(Backend backend) {
  switch (backend) {
    case Backend::gpu:
      return "gpu";
    case Backend::twin:
      return "twin";
    case Backend::reference:
      return "reference";
    case Backend::emulator:
      return "emulator";
  }
  return "";
}

std::unique_ptr<Executor> make_executor(Backend backend, const Scene& scene, const ExecutorOptions& options) {
  if (backend == Backend::gpu) return make_gpu_executor(scene, options);
  if (backend == Backend::emulator) {
    ExecutorOptions emulated = options;
    emulated.gpu.emulate = true;
    return make_gpu_executor(scene, emulated);
  }
  if (backend == Backend::twin) return make_twin_executor(scene, options);
  return make_reference_executor(scene, options);
}

}  // namespace eyeray::engine::executors
