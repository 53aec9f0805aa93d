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

// The files in which a long render saves its progress; without either, it saves none.
struct CheckpointFile {
  std::string begin;    // a new one
  std::string resume;   // the one to go on from, and to keep
  double seconds = 30;  // between two of its writings
};

struct Request {
  executors::Backend backend = executors::Backend::gpu;
  Rect crop;                           // empty: the whole picture
  film::Channels channels;             // beside the colour
  double noise = 0;                    // RenderOptions::noise
  double clamp = 0;                    // RenderOptions::clamp
  bool ray_kinds = false;              // count rays by kind
  bool classic = false;                // only by make_classic
  bool next_is_alike = false;          // whether kernels should serve the next scene too
  std::optional<render::Shard> shard;  // render only this share of the picture
  CheckpointFile checkpoint;
  size_t band_bytes = render::RenderOptions().band_bytes;
  std::string overrides;                                  // the settings laid over the scene's file, as text
  std::function<void(const render::Progress&)> progress;  // first before kernels compile; may be empty
  std::function<void(const std::string&)>
      warn;  // gets at once warnings that would cost time later; may be empty
};

// A scene that was read, with the doubts about its formulas among its warnings. InputError for formulas that
// do not compile.
Scene checked(Scene scene);

// `crop`, or all of the picture where it is empty. Error (bad_input) where it leaves the picture.
Rect crop_within(const Rect& crop, const ImageSettings& image);

// Returns `options` with ray_kinds and search_cost set if these channels need them, else cleared.
executors::ExecutorOptions counting(executors::ExecutorOptions options, const film::Channels& channels);

// Samples corners of pixels, a depth of five with the camera rays, and leaves nothing out that counts for
// little, as the published statistics of Haines' databases do.
void make_classic(Scene& scene, Request& request);

// Throws Error (bad_input) where `scene` cannot be rendered as `request` wants. Returns its channels, without
// those that the scene does not have where all were asked for.
film::Channels check(const Request& request, const Scene& scene);

}  // namespace eyeray::engine::session
