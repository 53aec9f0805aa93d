// Destinations of a picture: files, a part, memory.
#pragma once

#include <filesystem>
#include <vector>

#include "host/executors/executor.hpp"
#include "host/film/values.hpp"
#include "host/image/image.hpp"
#include "host/render/tiling.hpp"
#include "host/session/request.hpp"
#include "host/session/result.hpp"

namespace eyeray::engine::session {

// A picture about to be rendered.
struct Plan {
  const Request& request;
  const Scene& scene;
  const executors::Executor& executor;
  Rect crop;  // the rendered area of the picture
  film::Channels channels;
  image::Tone tone;                 // tone of each .png: the scene's, with the metered exposure
  bool fast_math;                   // ExecutorOptions::fast_math
  const render::ShardTiles* tiles;  // the tiles of the share; null if the whole crop is rendered

  bool transparent() const { return scene.image.transparent; }
  // The channels of the colour: linear RGB; of a transparent picture, multiplied by an alpha that follows.
  int color_channels() const { return transparent() ? 4 : 3; }
};

class Output {
 public:
  virtual ~Output() = default;

  // The files that the output will write. None may be a file that the scene reads.
  virtual std::vector<std::filesystem::path> files() const { return {}; }
  // Returns true if channels cost no files of their own. Then the channels that only denoising needs are
  // kept.
  virtual bool layered() const { return false; }
  // Called before the first sample.
  virtual void begin(const Plan& plan) = 0;
  // The next rows, from the top down, of the colour (plane 0, Plan::color_channels) or of a channel (1 + its
  // index). For a share, rows are those of the stack of its tiles, but channels of first hits come tile by
  // tile.
  virtual void write(size_t plane, const image::Image& rows) = 0;
  // Called once all of the colour is written, before the channels of first hits.
  virtual void finish_color() = 0;
  // Called at the end, also of an interrupted picture. Then channels of first hits may be incomplete. The
  // colour is complete if every pixel has a sample (RenderTotals::samples_done). Adds to `result` the files
  // that were written.
  virtual void finish(const film::ChannelValues& values, Result& result) = 0;
};

}  // namespace eyeray::engine::session
