// Motion blur: each sample of a picture shows one of the moments while the shutter is open.
#pragma once

#include <memory>

#include "host/executors/executor.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::render {

// The index of the moment that sample `index` shows; `moments` must be at most `samples`. All moments are
// shown equally often, to within a run. Samples of a moment come in runs, which keeps them well spread over
// the pixel. After any number of runs the shown moments are spread over the time.
int moment_of_sample(int index, int samples, int moments);

// Makes an executor like executors::make_executor. If anything moves while the scene's shutter is open
// (Scene::animation), each sample shows one of the shutter's moments. All other results are for the middle of
// the shutter time, the moment that the scene itself shows. The scene must outlive the executor.
std::unique_ptr<executors::Executor> make_picture_executor(executors::Backend backend, const Scene& scene,
                                                           const executors::ExecutorOptions& options);

}  // namespace eyeray::engine::render
