// Motion blur: samples of a picture that each show a moment of those while the shutter is open.
#pragma once

#include <memory>

#include "host/executors/executor.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::render {

// Which of `moments`, no more than `samples`, sample `index` shows. Each is shown about as often, to within a
// run. They come in runs, which keeps those of one moment well spread over the pixel; and after any number of
// runs the moments shown are spread over the time.
int moment_of_sample(int index, int samples, int moments);

// As executors::make_executor. Where anything moves while the scene's shutter is open (Scene::animation),
// samples are those of its moments; all else is of the moment at its middle, which the scene shows. The
// scene must stay.
std::unique_ptr<executors::Executor> make_picture_executor(executors::Backend backend, const Scene& scene,
                                                           const executors::ExecutorOptions& options);

}  // namespace eyeray::engine::render
