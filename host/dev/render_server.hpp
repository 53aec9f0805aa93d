// The worker's server: renders as requested, and sends the picture while it grows.
#pragma once

#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/dev/message.hpp"
#include "host/dev/painter.hpp"
#include "host/executors/executor.hpp"
#include "host/executors/tunables.hpp"

namespace eyeray::engine::dev {

// Answers messages until the socket is closed. A newer message ends the work on an older one: between two
// bands of rows, or else at the end of the current step.
//
//   {"do": "render", "revision": 7, "generation": 12, "defines": ["camera.eye=[0,1,5]"], "views": ["gpu"]}
//     "tunables": {"shapes/sphere.glsl:WIDTH": [0.5]}: the values chosen for constants of shaders
//     "revision": if it is the last one, files and defines are the same, and nothing is loaded or compiled;
//     "shaders_changed": a scene without sliders gets a kernel for its values alone, which compiles in half
//     the time; otherwise the kernel works for other values too;
//     "previews": the twin paints "gpu" while a kernel compiles
//   {"do": "probe", "x": 3, "y": 4}: probes a pixel of the last picture
//
// It sends these messages, each with its name as "event", and with the request's generation:
//   "stage"   the server's present work: "load", "compile", "render" or "denoise"; "share" of the last
//   "scene"   facts of the loaded scene: "width", "height", "samples", "files" that were read, "camera",
//             "warnings", "denoise": whether the picture will be denoised, null if it cannot be; and
//             "scene_tunables", in the form of "tunables"
//   "tunables"  adjustable constants of the shaders, each with "id", "owner", "name", "type", "low", "high",
//             "written", "value"
//   "rows"    see Board::put_rows; "preview": whether the twin made them; "processor_seconds"
//   "done"    a view is complete: "view", "last" (whether no other follows), "device", "seconds", "stages",
//             "rays", "samples", "noise_left" if it was denoised, "doubts" (sentences), "files",
//             "processor_seconds": all threads' since the request
//   "failed"  "code", "message", "diagnostics"
//   "probed"  the result of probe::to_json, as "findings", and its "text"; or "message" if the probe failed
class RenderServer {
 public:
  struct Options {
    // Loads the scene, with the "KEY=VALUE"s of `defines` laid over it.
    std::function<Scene(const std::vector<std::string>& defines)> load;
    executors::ExecutorOptions executor;
    double unnoticed_seconds = 0.15;  // a kernel that is ready sooner needs no preview
  };
  RenderServer(Options options, MessageSocket socket);

  void serve();

 private:
  void render(const Json& request);
  void load(const Json& request);
  // `denoised`: whether colours are denoised at the end.
  void paint(const std::string& view, bool denoised, bool last);
  // Sends the picture without its noise, and returns the noise that is left. Empty if the request is
  // outdated.
  std::optional<double> denoise(const std::string& name, const View& view, const image::NoisyPicture& noisy,
                                const executors::Executor& executor);
  // Warnings about a picture that may be wrong, a sentence each.
  std::vector<std::string> doubts(const View& view, const Painted& painted) const;
  void choose_tunables(const Json& values);
  void send_tunables();
  executors::ExecutorOptions options_for(const View& view);
  executors::Executor& executor_for(const View& view);
  void send_rows(const std::string& name, const View& view, const PaintedRows& rows, bool is_preview);

  // Drivers compile for seconds and cannot be interrupted, so where previews are allowed a thread makes the
  // executor of the GPU's colours. collect() waits at most `seconds` for it, then moves it to executors_. An
  // executor of another revision is dropped, with its error; else its error is thrown.
  bool may_preview(const View& view) const;
  void start_making();
  void collect(double seconds);
  bool gpu_is_ready(double seconds);
  // Shows the twin's picture until the GPU is ready. Returns the last sample of which it has shown rows, or
  // no_sample if it has shown none; empty if the request is outdated.
  std::optional<int> preview(const std::string& view);

  void probe(const Json& request);
  void send(const char* event, Json json, std::string bytes = "");
  void send_failure(const Error& error);
  bool outdated() const { return socket_.closed() || socket_.readable(); }

  Options options_;
  MessageSocket socket_;
  int64_t generation_ = 0;
  int64_t revision_ = -1;
  double processor_seconds_ = 0;       // when the request came
  std::string obstacle_to_denoising_;  // why the revision cannot be denoised; empty: it can
  bool own_kernel_ = true;             // whether the kernel serves only the values of this revision
  std::shared_ptr<executors::Tunables> tunables_;
  bool previews_ = false;
  std::shared_ptr<const Scene> scene_;
  std::optional<image::Tone> tone_;  // tone of this revision's colours, with the metered exposure
  // Executors of this revision, by backend and by the values that they count.
  std::map<std::pair<executors::Backend, film::Needs>, std::unique_ptr<executors::Executor>> executors_;
  int64_t made_of_ = -1;  // the revision of being_made_
  std::future<std::unique_ptr<executors::Executor>> being_made_;
};

}  // namespace eyeray::engine::dev
