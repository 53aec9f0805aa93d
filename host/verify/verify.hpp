// Renders a scene by every executor and compares them, gate by gate (docs/gates.md).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/compare/report.hpp"
#include "host/executors/executor.hpp"
#include "host/render/render.hpp"
#include "host/verify/golden.hpp"

namespace eyeray::engine::verify {

// The settings of verification.
struct Options {
  std::vector<executors::Backend> backends{
      executors::Backend::gpu, executors::Backend::twin};  // compared with the reference, in this order
  executors::ExecutorOptions executor;                     // the options of all backends
  Rect crop;                                               // the compared area; empty: the whole picture
  std::optional<double> max_explained;                     // instead of the scene's
  int64_t ulp = 0;                                         // the bound of gate A
  bool denoise = false;  // compare denoised pictures, too, as of scenes whose RenderSettings::denoise is set
  bool raster = false;   // compare with the rasteriser, too: gate R
  // Called at the end with the compared frames, as Page::add is. May be empty.
  std::function<void(const compare::Report&, std::span<const compare::Frame>,
                     std::span<const std::vector<compare::PixelOutcome>>)>
      witness;
  // Called before each executor is made; returns the function that its progress is reported to. Either may be
  // empty.
  std::function<std::function<void(const render::Progress&)>()> progress;
};

// The scene to verify, and its names.
struct Subject {
  const Scene& scene;
  std::string file;             // Report::scene
  std::string written_options;  // Report::options
  std::filesystem::path
      evidence;  // the folder for pictures of a scene that fails a gate (evidence.hpp); empty: none
  bool keep_always = false;        // whether `evidence` gets the pictures even if no gate fails
  std::optional<Golden> golden{};  // the golden picture of gate G
};

// Renders the scene by each backend and at last by the reference. Gate A compares each backend with the
// first, gates B and C compare each with the reference, gate G the first with a golden picture. Gate R, if
// requested, compares each backend and the reference with the device's rasteriser. Gates A and B hold for
// denoised pictures, too. The report states which gates pass. Error (interrupted) after Ctrl-C, Error
// (file_io) when the evidence cannot be written, and the errors of make_executor and render.
compare::Report verify_scene(const Subject& subject, const Options& options);

}  // namespace eyeray::engine::verify
