#include "bench/field.hpp"

namespace eyeray {

double rate(const BatchReport& batch, const Lap& lap) {
  return lap.seconds.median > 0 ? double(batch.rays) / lap.seconds.median : 0;
}

const Lap* fastest(const BatchReport& batch, Side side) {
  const Lap* best = nullptr;
  for (const Lap& lap : batch.laps) {
    if (lap.side == side && (!best || lap.seconds.median < best->seconds.median)) best = &lap;
  }
  return best;
}

double times_as_fast(const BatchReport& batch, const Lap& lap, Side side) {
  const Lap* const other = fastest(batch, side);
  return other && lap.seconds.median > 0 ? other->seconds.median / lap.seconds.median : 0;
}

}  // namespace eyeray
