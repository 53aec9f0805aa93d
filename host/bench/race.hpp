// Contenders on the same rays, in turns, so that a change of the machine's mood meets them all.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/batch.hpp"
#include "bench/spread.hpp"

namespace eyeray {

enum class Side { ours, single, packet };  // ours, or Embree by single rays, or by packets and streams

struct Contender {
  std::string name;
  Side side = Side::ours;
  // Fills the hits; returns the seconds that tracing alone took.
  std::function<double(const Batch&, std::span<QueryHit>)> query;
};

// What one contender did on one batch.
struct Lap {
  std::string contender;
  Side side = Side::ours;
  Spread seconds;
  uint64_t differing = 0;  // rays whose hit is not the first contender's
};

// Whether two hits are the same to within 1e-3 of t. Primitives are not compared: on an edge either is right.
bool agree(const QueryHit& a, const QueryHit& b);

// One round that is not timed, whose hits are compared, then `runs` that are. Error (interrupted) after
// Ctrl-C.
std::vector<Lap> race(const Batch& batch, std::span<const Contender> contenders, int runs);

}  // namespace eyeray
