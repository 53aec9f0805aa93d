#include "host/compare/against_reference.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/compare/paths.hpp"
#include "host/core/parallel_for.hpp"

namespace eyeray::engine::compare {

namespace {

struct Judgement : PixelOutcome {
  double excess = 0;
};

constexpr int64_t always_allowed = 4;     // so that a small crop around an edge can pass
constexpr size_t examined_at_once = 256;  // so that failures are reported soon
// If a colour oscillates, the usual positions may all miss its extreme. If only `few` pixels remain
// unexplained, these are examined again at more positions.
constexpr int usual_angles = 16;
constexpr int many_angles = 256;
constexpr size_t few = 32;

bool equal(const Vec3& value, const Vec3& reference) {
  return glm::vec3(value) == glm::vec3(reference);
}
bool equal(const FirstHit& value, const FirstHit& reference) {
  return value.primitive == reference.primitive && value.material == reference.material &&
         float(value.t) == float(reference.t) && equal(value.position, reference.position) &&
         equal(value.normal, reference.normal) && equal(value.normal_geometric, reference.normal_geometric) &&
         float(value.cosine) == float(reference.cosine) && glm::vec2(value.uv) == glm::vec2(reference.uv);
}

// Both frames and the findings so far, one judgement a pixel and gate.
class Judge {
 public:
  Judge(const Frame& value, const Frame& reference, const Tolerances& tolerances, bool hits_alone)
      : value_(value),
        reference_(reference),
        tolerances_(tolerances),
        hits_alone_(hits_alone),
        colors_(size_t(value.area.pixels())),
        first_hits_(size_t(value.area.pixels())),
        counts_(size_t(value.area.pixels())) {}

  // Decides the pixels that need no explanation; the others are left `unexamined`.
  void compare_values() {
    parallel_for(0, value_.area.height, [&](int y) {
      for (int x = 0; x < value_.area.width; ++x) {
        const WorstPixel p = at(index(x, y));
        first_hits_[index(x, y)] =
            judge(hit_excess(p.value_hit, p.reference_hit, tolerances_), equal(p.value_hit, p.reference_hit));
        if (hits_alone_) continue;
        colors_[index(x, y)] =
            judge(color_excess(p.value, p.reference, tolerances_.color), equal(p.value, p.reference));
        counts_[index(x, y)] =
            judge(counts_excess(p.value_counts, p.reference_counts), p.value_counts == p.reference_counts);
      }
    });
  }

  // Examines the pixels that differ, some hundreds at a time, spread over the picture. The pixels of a gate
  // are examined until that gate has failed, whatever the other gates find.
  void explain(const Reference& around) {
    const size_t parts = of_outcome(Outcome::unexamined, true).size() / examined_at_once + 1;
    for (size_t part = 0; part < parts; ++part) {
      std::vector<size_t> chosen;
      for (const size_t i : of_outcome(Outcome::unexamined, false))
        if (i % parts == part) chosen.push_back(i);
      look_at(chosen, around, usual_angles, false);
    }
    const std::vector<size_t> left = of_outcome(Outcome::unexplained, true);
    if (left.size() <= few) look_at(left, around, many_angles, true);
  }

  Tally count_colors() const { return tally(colors_); }
  Tally count_first_hits() const { return tally(first_hits_); }
  Tally count_counts() const { return tally(counts_); }

  std::vector<PixelOutcome> worst_outcomes() const {
    std::vector<PixelOutcome> worst(first_hits_.begin(), first_hits_.end());
    for (const std::vector<Judgement>* judgements : {&counts_, &colors_})
      for (size_t i = 0; i < worst.size(); ++i)
        if ((*judgements)[i].outcome > worst[i].outcome) worst[i] = (*judgements)[i];
    return worst;
  }

 private:
  size_t index(int x, int y) const { return size_t(y) * size_t(value_.area.width) + size_t(x); }

  // Both frames' values of a pixel.
  WorstPixel at(size_t i) const {
    const int x = int(i) % value_.area.width, y = int(i) / value_.area.width;
    WorstPixel p;
    p.pixel = {value_.area.x + x, value_.area.y + y};
    p.value = color_at(value_.color, x, y);
    p.reference = color_at(reference_.color, x, y);
    p.value_counts = counts_at(value_, x, y);
    p.reference_counts = counts_at(reference_, x, y);
    p.value_hit = value_.first_hit(x, y);
    p.reference_hit = reference_.first_hit(x, y);
    return p;
  }

  static Judgement judge(double excess, bool equal) {
    const Outcome outcome = !(excess <= 1) ? Outcome::unexamined : equal ? Outcome::equal : Outcome::matching;
    return {{outcome, {}}, excess};
  }

  // The pixels with that outcome in any gate; unless `of_all`, only in the gates that have not failed for
  // certain.
  std::vector<size_t> of_outcome(Outcome outcome, bool of_all) const {
    std::vector<const std::vector<Judgement>*> considered;
    for (const std::vector<Judgement>* judgements : {&first_hits_, &counts_, &colors_}) {
      const Tally tally = this->tally(*judgements);
      const bool failed = tally.capped_pixels() > tally.may_be_explained || tally.unexplained > int64_t(few);
      if (of_all || !failed) considered.push_back(judgements);
    }
    std::vector<size_t> pixels;
    for (size_t i = 0; i < colors_.size(); ++i)
      if (std::ranges::any_of(considered, [&](const auto* j) { return (*j)[i].outcome == outcome; }))
        pixels.push_back(i);
    return pixels;
  }

  void look_at(const std::vector<size_t>& pixels, const Reference& around, int angles, bool between) {
    parallel_for(0, int(pixels.size()), [&](int n) {
      const size_t i = pixels[size_t(n)];
      const WorstPixel p = at(i);
      const Neighbourhood neighbourhood(around, p.pixel, angles, between);
      if (neighbourhood.explains(p.value, tolerances_))
        settle(colors_[i], true, neighbourhood.cause(p.value, tolerances_));
      else
        settle(colors_[i], neighbourhood.explains_as_rounding(p.value, tolerances_), Cause::rounding);
      if (neighbourhood.explains(p.value_counts))
        settle(counts_[i], true, neighbourhood.cause(p.value_counts));
      else
        settle(counts_[i], neighbourhood.explains_as_rounding(p.value_counts), Cause::rounding);
      settle(first_hits_[i], neighbourhood.explains(p.value_hit, tolerances_),
             neighbourhood.cause(p.value_hit, tolerances_));
    });
  }

  static void settle(Judgement& judgement, bool explained, Cause cause) {
    if (judgement.outcome != Outcome::unexamined && judgement.outcome != Outcome::unexplained) return;
    judgement.outcome = explained ? Outcome::explained : Outcome::unexplained;
    judgement.cause = cause;
  }

  Tally tally(const std::vector<Judgement>& judgements) const {
    Tally tally;
    tally.pixels = int64_t(judgements.size());
    tally.may_be_explained = explained_cap(tolerances_, tally.pixels);

    // Count, and find the worst pixel for the report: an unexamined one only if none is unexplained.
    const auto weight = [](const Judgement& j) {
      const int rank = j.outcome == Outcome::unexplained  ? 4
                       : j.outcome == Outcome::unexamined ? 3
                                                          : int(j.outcome);
      return std::pair(rank, j.excess);
    };
    size_t worst = 0;
    for (size_t i = 0; i < judgements.size(); ++i) {
      switch (judgements[i].outcome) {
        case Outcome::equal:
          ++tally.equal;
          break;
        case Outcome::matching:
          ++tally.matching;
          break;
        case Outcome::explained:
          ++tally.explained[size_t(judgements[i].cause)];
          break;
        case Outcome::unexplained:
          ++tally.unexplained;
          break;
        case Outcome::unexamined:
          ++tally.unexamined;
          break;
      }
      if (weight(judgements[i]) > weight(judgements[worst])) worst = i;
    }

    tally.worst = at(worst);
    tally.worst.excess = judgements[worst].excess;
    tally.worst.seam = first_seam(tally.worst, tolerances_,
                                  judgements[worst].outcome == Outcome::unexplained &&
                                      first_hits_[worst].outcome == Outcome::explained);
    return tally;
  }

  const Frame& value_;
  const Frame& reference_;
  const Tolerances& tolerances_;
  const bool hits_alone_;
  std::vector<Judgement> colors_;
  std::vector<Judgement> first_hits_;
  std::vector<Judgement> counts_;
};

}  // namespace

int64_t Tally::explained_pixels() const {
  return std::accumulate(explained.begin(), explained.end(), int64_t{0});
}

int64_t Tally::capped_pixels() const {
  return explained_pixels() - explained[size_t(Cause::undecidable)];
}

int64_t explained_cap(const Tolerances& tolerances, int64_t pixels) {
  return std::max(always_allowed, int64_t(std::ceil(tolerances.max_explained * double(pixels))));
}

bool Tally::passes() const {
  return pixels > 0 && unexplained == 0 && unexamined == 0 && capped_pixels() <= may_be_explained;
}

std::span<const TallyType> ReferenceComparison::types() const {
  if (by_samples()) return path_tally_types;
  return tally_types;
}

bool ReferenceComparison::passes() const {
  return incomparable.empty() && (!by_samples() || paired_sum.excess() <= 1) &&
         std::ranges::all_of(types(), [&](const TallyType& type) { return (this->*type.tally).passes(); });
}

ReferenceComparison compare_with_reference(const Frame& value, const Frame& reference,
                                           const Reference& around, const Tolerances& tolerances,
                                           std::vector<PixelOutcome>* outcomes, const PathReference* paths) {
  tolerances.check();
  ReferenceComparison result;
  result.incomparable = why_incomparable(value, reference);
  if (!result.incomparable.empty()) return result;

  Judge judge(value, reference, tolerances, paths != nullptr);
  judge.compare_values();
  judge.explain(around);
  result.first_hits = judge.count_first_hits();
  std::vector<PixelOutcome> worst = judge.worst_outcomes();
  if (paths) {
    result.paths = compare_paths(value, reference, *paths, tolerances, worst);
    result.paired_sum = worst_paired_sum(value, reference, paths->shared);
  } else {
    result.colors = judge.count_colors();
    result.counts = judge.count_counts();
  }
  if (outcomes) *outcomes = std::move(worst);
  return result;
}

}  // namespace eyeray::engine::compare
