#include "host/render/first_hits.hpp"

#include <algorithm>
#include <vector>

#include "host/core/termination.hpp"
#include "host/render/rows_at_a_time.hpp"

namespace eyeray::engine::render {

bool trace_first_hits(executors::Executor& executor, const Rect& crop, const FirstHitSink& sink) {
  std::vector<FirstHit> hits;
  for (int row = 0; row < crop.height;) {
    const Rect tile{crop.x, crop.y + row, crop.width,
                    std::min(rows_of(most_traced, crop.width), crop.height - row)};
    hits.assign(size_t(tile.pixels()), {});
    executor.first_hits(tile, hits);
    // Drop these hits: an interrupted executor may leave out any pixel.
    if (interrupted()) return false;
    sink(row, hits);
    row += tile.height;
  }
  return true;
}

}  // namespace eyeray::engine::render
