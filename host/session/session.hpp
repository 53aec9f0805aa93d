// The way from a request to a picture, the same for every program: checks the request, renders it and warns
// of doubts.
#pragma once

#include <memory>

#include "host/executors/executor.hpp"
#include "host/session/output.hpp"
#include "host/session/request.hpp"
#include "host/session/result.hpp"

namespace eyeray::engine::session {

// The state that requests share: the options for making executors, and the device, which stays open between
// requests.
class Session {
 public:
  Session() = default;
  explicit Session(executors::ExecutorOptions options) : options_(std::move(options)) {}

  // May be changed between requests.
  executors::ExecutorOptions& options() { return options_; }

  // Renders `scene` to `output`. Error (bad_input), before anything is written, if scene and request do not
  // fit together (session::check), or if the output would replace a file that the scene reads. Also throws
  // the errors of make_executor, render_rows, Checkpoint and the output's functions.
  Result render(const Scene& scene, const Request& request, Output& output);

  // The exposure at which the request's picture would be shown, measured if the scene asks for "auto". Throws
  // as render does.
  double exposure(const Scene& scene, const Request& request);

 private:
  std::unique_ptr<executors::Executor> executor_for(const Scene& scene, const Request& request,
                                                    const film::Channels& channels);

  executors::ExecutorOptions options_;
};

}  // namespace eyeray::engine::session
