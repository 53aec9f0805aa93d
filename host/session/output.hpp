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
  Rect crop;  // of the picture
  film::Channels channels;
  bool fast_math;                   // ExecutorOptions::fast_math
  const render::ShardTiles* tiles;  // of the share; null where all of it is rendered
};

class Output {
 public:
  virtual ~Output() = default;

  // The files that it will write; none of them may be one that the scene reads.
  virtual std::vector<std::filesystem::path> files() const { return {}; }
  // Before the first sample.
  virtual void begin(const Plan& plan) = 0;
  // The next rows, from the top down, of the colour (plane 0) or of a channel (1 + its index). Of a share
  // rows are those of its tiles' stack, but channels of first hits come tile by tile.
  virtual void write(size_t plane, const image::Image& rows) = 0;
  // All of the colour is written. Channels of first hits come after this.
  virtual void finish_color() = 0;
  // The end, of an interrupted picture too: its channels of first hits may be incomplete, and its colour is
  // where every pixel has a sample (RenderTotals::samples_done). Adds to `result` the files that were
  // written.
  virtual void finish(const film::ChannelValues& values, Result& result) = 0;
};

}  // namespace eyeray::engine::session
