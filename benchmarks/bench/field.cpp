#include "benchmarks/bench/field.hpp"

namespace eyeray::engine::bench {

double rate(const BatchReport& batch, const Timing& timing) {
  return timing.seconds.median > 0 ? double(batch.rays) / timing.seconds.median : 0;
}

const Timing* fastest(const BatchReport& batch, ContenderKind kind) {
  const Timing* best = nullptr;
  for (const Timing& timing : batch.timings) {
    if (timing.kind == kind && (!best || timing.seconds.median < best->seconds.median)) best = &timing;
  }
  return best;
}

double times_as_fast(const BatchReport& batch, const Timing& timing, ContenderKind kind) {
  const Timing* const other = fastest(batch, kind);
  return other && timing.seconds.median > 0 ? other->seconds.median / timing.seconds.median : 0;
}

}  // namespace eyeray::engine::bench
