// Runs contenders on the same rays, in turns, so that a change of the machine's speed affects them all.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/bench/batch.hpp"
#include "benchmarks/bench/spread.hpp"

namespace eyeray::engine::bench {

enum class ContenderKind {
  ours,
  single,  // Embree by single rays
  packet   // Embree by packets
};

struct Contender {
  std::string name;
  ContenderKind kind = ContenderKind::ours;
  // Fills the hits; returns the seconds that tracing alone took.
  std::function<double(const Batch&, std::span<QueryHit>)> query;
};

// The timing of one contender on one batch.
struct Timing {
  std::string contender;
  ContenderKind kind = ContenderKind::ours;
  Spread seconds;
  uint64_t differing = 0;  // rays whose hit is not the first contender's
};

// True if two hits are the same to within 1e-3 of t. Primitives are not compared: on an edge either is right.
bool agree(const QueryHit& a, const QueryHit& b);

// Runs each contender once untimed, to compare hits, then `runs` times timed. Error (interrupted) after
// Ctrl-C.
std::vector<Timing> race(const Batch& batch, std::span<const Contender> contenders, int runs);

}  // namespace eyeray::engine::bench
