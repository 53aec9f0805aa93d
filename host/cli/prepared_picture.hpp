// What a request comes to before the first sample.
#pragma once

#include <memory>
#include <optional>

#include "host/cli/picture.hpp"
#include "host/executors/executor.hpp"
#include "host/render/checkpoint.hpp"
#include "host/render/render.hpp"

namespace eyeray::cli {

struct PreparedPicture {
  Scene scene;
  Rect crop;  // of the picture; all of it, where none was asked for
  std::unique_ptr<executors::Executor> executor;
  std::optional<render::ShardTiles> tiles;  // where a share was asked for
  std::optional<render::Checkpoint> checkpoint;
  render::RenderOptions options;  // of what is rendered: with --classic that is more than `crop`
};

// Loads the scene and makes what renders it. `request` is left with the AOVs that there are. Error and
// InputError for whatever keeps it from being rendered.
std::unique_ptr<PreparedPicture> prepare(PictureRequest& request, StageTimes& times,
                                         const std::function<void(const render::Progress&)>& progress);
// What there is to say of it after its render. `illegible`: Legibility::warning() of it.
void describe(const PictureRequest& request, const PreparedPicture& prepared,
              const render::RenderTotals& totals, Picture& picture, const std::string& illegible = "");

}  // namespace eyeray::cli
