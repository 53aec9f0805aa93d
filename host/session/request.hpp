// The request for a picture, from any interface.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "host/core/rect.hpp"
#include "host/executors/executor.hpp"
#include "host/film/channel.hpp"
#include "host/render/render.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::session {

// The file in which a long render saves its progress; if both names are empty, it saves none.
struct CheckpointFile {
  std::string begin;    // a new file
  std::string resume;   // the file to go on from, which is then kept up to date
  double seconds = 30;  // between two writes
};

// eyeray's denoiser (host/denoise/denoise.hpp), or a library that must be installed.
enum class Denoiser { own, open_image_denoise };

struct Request {
  executors::Backend backend = executors::Backend::gpu;
  Rect crop;                      // empty: the whole picture
  film::Channels channels;        // beside the colour
  double noise = 0;               // RenderOptions::noise
  double clamp = 0;               // RenderOptions::clamp
  bool reject_fireflies = false;  // RenderOptions::reject_outliers
  bool denoise = false;           // remove noise from the finished picture, as RenderSettings::denoise
  Denoiser denoiser = Denoiser::own;
  std::optional<double> exposure;      // in stops, in place of a measured one
  bool ray_kinds = false;              // count rays by kind
  bool classic = false;                // only by make_classic
  bool next_is_alike = false;          // whether kernels should serve the next scene too
  std::optional<render::Shard> shard;  // render only this share of the picture
  CheckpointFile checkpoint;
  size_t band_bytes = render::RenderOptions().band_bytes;
  std::string overrides;                                  // the settings laid over the scene's file, as text
  std::function<void(const render::Progress&)> progress;  // first called before kernels compile; may be empty
  std::function<void(const std::string&)>
      warn;  // gets at once warnings that would cost time later; may be empty
};

// Returns `scene`, which was just read, with the doubts about its formulas added to its warnings. InputError
// for formulas that do not compile.
Scene checked(Scene scene);

// Returns `crop`, or the whole picture if `crop` is empty. Error (bad_input) if it extends beyond the
// picture.
Rect crop_within(const Rect& crop, const ImageSettings& image);

// Returns `options` with ray_kinds and search_cost set if these channels need them, else cleared.
executors::ExecutorOptions counting(executors::ExecutorOptions options, const film::Channels& channels);

// Sets up the render of the published statistics of Haines' databases: samples at the corners of pixels, a
// depth of five counting the camera rays, and no ray left out because it contributes little.
void make_classic(Scene& scene, Request& request);

// Throws Error (bad_input) if `scene` cannot be rendered as `request` wants. Returns the request's channels;
// if all channels were requested, those that the scene does not have are left out.
film::Channels check(const Request& request, const Scene& scene);

// A sentence on why the request's picture cannot be denoised; empty if it can. The crop is within the
// picture.
std::string obstacle_to_denoising(const Request& request, const Scene& scene);

// Returns true if the picture's noise is to be removed at the end: if the request or the scene asks for it.
// The scene of a mesh alone, which nobody wrote, asks for it only where it can be done.
bool denoises(const Request& request, const Scene& scene);

}  // namespace eyeray::engine::session
