// A picture that grows while it is viewed: coarse first, then row by row.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "host/executors/executor.hpp"
#include "host/film/noisy_parts.hpp"
#include "host/session/warnings.hpp"

namespace eyeray::engine::dev {

// The picture that is viewed: the colours of an executor, or an AOV from the GPU.
struct View {
  executors::Backend backend = executors::Backend::gpu;
  film::Channel aov = nullptr;
  bool denoised = false;  // whether the inputs of denoising are summed, too; not for an AOV

  film::Needs needs() const { return aov ? aov->needs : film::Needs::nothing; }
  // The channels that the view of `scene` needs. Colours of a transparent picture have an alpha.
  film::Channels film_channels(const Scene& scene) const {
    if (aov) return {aov};
    const film::Channels channels = scene.image.transparent ? film::with({}, {"coverage"}) : film::Channels();
    return denoised ? film::with_noisy_parts(channels, scene.image.transparent) : channels;
  }
};

// The view called `name`: "gpu", "twin", "reference" or an AOV. Error (bad_input) for another name.
View parse_view(const std::string& name);

// Rows of a view, with one pixel for `stride` x `stride` pixels of the picture. `first`: the first row's
// number, from the top, among the rows of that stride. A sink returns whether to go on.
struct PaintedRows {
  const image::Image& rows;
  int first = 0;
  int stride = 1;
  int sample = 0;
};
using RowsSink = std::function<bool(const PaintedRows&)>;

struct Painted {
  uint64_t rays = 0;
  session::PictureQuality quality = {};
  std::optional<image::NoisyPicture> noisy = {};  // if View::denoised
};

// Renders all of a view in bands of some hundredths of a second. `executor` has the view's backend and counts
// the values that the view needs. Empty if the sink or a signal ended the work.
std::optional<Painted> paint(const View& view, const Scene& scene, executors::Executor& executor,
                             const RowsSink& sink);

}  // namespace eyeray::engine::dev
