#include "benchmarks/bench/race.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/error.hpp"
#include "host/core/termination.hpp"

namespace eyeray::engine::bench {

bool agree(const QueryHit& a, const QueryHit& b) {
  if (std::isinf(a.t) || std::isinf(b.t)) return std::isinf(a.t) && std::isinf(b.t);
  return std::abs(a.t - b.t) <= 1e-3 * std::max(std::abs(a.t), std::abs(b.t));
}

std::vector<Timing> race(const Batch& batch, std::span<const Contender> contenders, int runs) {
  std::vector<QueryHit> first(batch.rays.size()), hits(batch.rays.size());
  std::vector<Timing> timings;
  for (const Contender& contender : contenders) {
    Timing& timing = timings.emplace_back(Timing{contender.name, contender.kind, {}, 0});
    contender.query(batch, hits);
    if (timings.size() == 1) first = hits;
    for (size_t i = 0; i < hits.size(); ++i) timing.differing += !agree(first[i], hits[i]);
  }

  std::vector<std::vector<double>> seconds(contenders.size());
  for (int run = 0; run < runs; ++run) {
    for (size_t i = 0; i < contenders.size(); ++i) {
      if (interrupted()) throw Error(ExitCode::interrupted, "interrupted");
      seconds[i].push_back(contenders[i].query(batch, hits));
    }
  }
  for (size_t i = 0; i < contenders.size(); ++i) timings[i].seconds = spread(seconds[i]);
  return timings;
}

}  // namespace eyeray::engine::bench
