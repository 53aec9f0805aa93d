// Gates B (colours) and C (first hits and counts): each pixel agrees with the reference, or the reference
// explains why not.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "host/compare/explain.hpp"
#include "host/compare/paired_sums.hpp"

namespace eyeray::engine::compare {

// The outcomes that a pixel may have, from best to worst. An explained pixel also has a cause.
enum class Outcome : uint8_t { equal, matching, explained, unexplained, unexamined };
struct PixelOutcome {
  Outcome outcome = Outcome::equal;
  Cause cause = Cause::silhouette;
};

// The outcomes of the pixels of one gate. The counts add up to `pixels`.
struct Tally {
  int64_t pixels = 0;
  int64_t equal = 0;     // to the last bit of float32
  int64_t matching = 0;  // within tolerance
  std::array<int64_t, cause_count> explained{};
  int64_t unexplained = 0;
  // The differing pixels that were not examined. If more pixels differ than may be explained at all, the gate
  // has failed, and only some hundreds of them, spread over the picture, are examined.
  int64_t unexamined = 0;
  int64_t may_be_explained = 0;  // the cap on capped_pixels()
  WorstPixel worst;  // the largest error among the unexplained; else the explained; else the matching

  int64_t explained_pixels() const;
  // The pixels that count against the cap: all but the undecidable ones, since an edge may run along the
  // centres of a whole row of pixels.
  int64_t capped_pixels() const;
  bool passes() const;
};

struct TallyType;
struct ReferenceComparison {
  std::string incomparable;  // why nothing was compared; empty when everything was
  Tally colors;              // gate B
  Tally first_hits;          // gate C
  Tally counts;              // gate C
  Tally paths;           // gate D, counted in samples; if paths are random, it replaces `colors` and `counts`
  PairedSum paired_sum;  // gate D's worst sum

  bool by_samples() const { return paths.pixels > 0; }
  std::span<const TallyType> types() const;
  bool passes() const;
};

// The kinds of tallies of a comparison, in the order in which a fault shows along a ray's life.
struct TallyType {
  const char* gate;
  const char* of;  // "first hits"
  Tally ReferenceComparison::* tally;
  const char* unit = "pixels";
};
inline constexpr TallyType tally_types[] = {
    {"C", "first hits", &ReferenceComparison::first_hits},
    {"C", "surfaces and rays", &ReferenceComparison::counts},
    {"B", "colours", &ReferenceComparison::colors},
};
inline constexpr TallyType path_tally_types[] = {
    {"C", "first hits", &ReferenceComparison::first_hits},
    {"D", "paths", &ReferenceComparison::paths, "samples"},
};

// The tally of gate G, which compares with a golden picture (report.hpp).
inline constexpr TallyType golden_type{"G", "colours", &ReferenceComparison::colors};

// `outcomes`, if not null, gets the worst outcome of every pixel over all tallies, row by row. With `paths`,
// for random paths, samples are compared instead of their means.
ReferenceComparison compare_with_reference(const Frame& value, const Frame& reference,
                                           const Reference& around, const Tolerances& tolerances = {},
                                           std::vector<PixelOutcome>* outcomes = nullptr,
                                           const PathReference* paths = nullptr);

// Tally::may_be_explained for so many pixels or samples.
int64_t explained_cap(const Tolerances& tolerances, int64_t pixels);

}  // namespace eyeray::engine::compare
