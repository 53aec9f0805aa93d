// First hits of a picture's pixels.
#pragma once

#include <functional>
#include <span>

#include "host/executors/executor.hpp"

namespace eyeray::engine::render {

using FirstHitSink = std::function<void(int first_row, std::span<const FirstHit>)>;

// Passes the first hits of the rays through the centres of the crop's pixels to `sink`, some rows at a time.
// Returns false if interrupted, before `sink` got all.
bool trace_first_hits(executors::Executor& executor, const Rect& crop, const FirstHitSink& sink);

}  // namespace eyeray::engine::render
