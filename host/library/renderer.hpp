// The implementation of the library's renderers.
#pragma once

#include <eyeray/eyeray.hpp>

#include <atomic>
#include <functional>
#include <memory>

#include "host/core/rect.hpp"
#include "host/executors/executor.hpp"
#include "host/render/render.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::inline v0 {

struct Cancellation::Data {
  std::atomic<bool> requested = false;
};

struct Renderer::Data {
  RendererOptions options;
  std::shared_ptr<engine::executors::OpenDevice> device = nullptr;  // null until the backend gpu is used
  bool warned_of_caches = false;
};

}  // namespace eyeray::inline v0

namespace eyeray::engine::library {

executors::Backend backend_of(v0::Backend backend);
Rect rect_of(const v0::Rect& crop);
// The options for executors. For the backend gpu they name the renderer's device, which is opened now if it
// is not yet.
executors::ExecutorOptions executor_options(v0::Renderer::Data& renderer, bool gpu);
// The callback for render::RenderOptions: calls `progress`, and requests `cancellation` if it returns false.
std::function<void(const render::Progress&)> progress_of(
    const std::function<bool(const v0::Progress&)>& progress, const v0::Cancellation& cancellation);
// Runs `work` as call_engine does. A device that is lost during the call is not used again.
void call_renderer(v0::Renderer::Data& renderer, const v0::Cancellation& cancellation,
                   const std::function<void()>& work);

}  // namespace eyeray::engine::library
