#include "host/compare/paths.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/parallel_for.hpp"

namespace eyeray::engine::compare {

namespace {

constexpr size_t examined_at_once = 256;  // so that failures are reported soon
constexpr int usual_angles = 16;
constexpr int many_angles = 256;
// Unexplained samples are examined again at `many_angles`, if there are at most `few`, or at most one in
// `few_of` of the samples that do not match. If mirrors see each other, any number of samples may need that.
constexpr size_t few = 32, few_of = 64;
// If at most one in `one_in` of all samples is still unexplained, these are examined once more, at
// `most_angles`. A thin mirror multiplies a rounding error by a thousand, and a path may hit several.
constexpr int most_angles = 4096;
constexpr size_t one_in = size_t{1} << 18;

using Events = std::vector<uint32_t>;

// A sample that does not match.
struct Apart : PixelOutcome {
  size_t sample;
  double excess;
};

// The index at which two paths diverge. Neither is a prefix of the other, since the last event of each marks
// its end.
size_t parting_of(const Events& a, const Events& b) {
  return size_t(std::ranges::mismatch(a, b).in1 - a.begin());
}

class PathJudge {
 public:
  PathJudge(const Frame& value, const Frame& reference, const PathReference& paths,
            const Tolerances& tolerances)
      : value_(value),
        reference_(reference),
        paths_(paths),
        tolerances_(tolerances),
        each_(reference.samples.size() / size_t(reference.area.pixels())) {
    tally_.pixels = int64_t(reference.samples.size());
    tally_.may_be_explained = explained_cap(tolerances, tally_.pixels);
  }

  void compare_values() {
    for (size_t i = 0; i < reference_.samples.size(); ++i) {
      const TracedSample &v = value_.samples[i], &r = reference_.samples[i];
      double excess = color_excess(Vec3(v.color), Vec3(r.color), tolerances_.color);
      const bool counts_differ = v.trail == r.trail && (v.hits != r.hits || v.rays != r.rays);
      if (counts_differ) excess = std::numeric_limits<double>::infinity();
      if (!(excess <= 1)) {
        apart_.push_back({{Outcome::unexamined, {}}, i, excess});
        continue;
      }
      ++(v.color == r.color ? tally_.equal : tally_.matching);
      if (excess > matching_excess_) {
        matching_excess_ = excess;
        worst_matching_ = i;
      }
    }
  }

  // Examines the samples that do not match, some hundreds at a time, spread over the picture, until the gate
  // has failed.
  void explain() {
    const size_t parts = apart_.size() / examined_at_once + 1;
    for (size_t part = 0; part < parts && !failed(); ++part) {
      std::vector<Apart*> chosen;
      for (size_t i = part; i < apart_.size(); i += parts) chosen.push_back(&apart_[i]);
      look_at(chosen, usual_angles, false);
    }
    for (const auto& [most, angles] :
         {std::pair(few_unexplained(), many_angles), {reference_.samples.size() / one_in, most_angles}}) {
      std::vector<Apart*> left;
      for (Apart& sample : apart_)
        if (sample.outcome == Outcome::unexplained) left.push_back(&sample);
      if (left.size() <= most) look_at(left, angles, true);
    }
  }

  Tally tally(std::vector<PixelOutcome>& outcomes) {
    const Apart* worst = nullptr;
    for (const Apart& sample : apart_) {
      count(sample, tally_);
      if (!worst || weight(sample) > weight(*worst)) worst = &sample;
      PixelOutcome& pixel = outcomes[sample.sample / each_];
      if (sample.outcome > pixel.outcome) pixel = sample;
    }
    tally_.worst = worst ? at(worst->sample, worst->excess) : at(worst_matching_, matching_excess_);
    return tally_;
  }

 private:
  static void count(const Apart& sample, Tally& tally) {
    tally.unexplained += sample.outcome == Outcome::unexplained;
    tally.unexamined += sample.outcome == Outcome::unexamined;
    if (sample.outcome == Outcome::explained) ++tally.explained[size_t(sample.cause)];
  }
  static std::pair<int, double> weight(const Apart& sample) {
    return {sample.outcome == Outcome::unexplained  ? 2
            : sample.outcome == Outcome::unexamined ? 1
                                                    : 0,
            sample.excess};
  }

  bool failed() const {
    Tally so_far;
    for (const Apart& sample : apart_) count(sample, so_far);
    return so_far.capped_pixels() > tally_.may_be_explained ||
           so_far.unexplained > int64_t(few_unexplained());
  }
  size_t few_unexplained() const { return std::max(few, apart_.size() / few_of); }

  Pixel pixel_of(size_t sample) const {
    const int i = int(sample / each_);
    return {reference_.area.x + i % reference_.area.width, reference_.area.y + i / reference_.area.width};
  }

  WorstPixel at(size_t sample, double excess) const {
    const TracedSample &v = value_.samples[sample], &r = reference_.samples[sample];
    WorstPixel p;
    p.pixel = pixel_of(sample);
    p.sample = int(sample % each_);
    p.value = Vec3(v.color);
    p.reference = Vec3(r.color);
    p.value_counts = {v.hits, v.rays};
    p.reference_counts = {r.hits, r.rays};
    p.value_hit = value_.first_hits[sample / each_];
    p.reference_hit = reference_.first_hits[sample / each_];
    p.excess = excess;
    if (v.trail == r.trail) {
      p.seam = excess <= 1                                ? Seam::none
               : std::isinf(excess) && v.color == r.color ? Seam::counts
                                                          : Seam::color;
      return p;
    }
    p.seam = Seam::trail;
    const Events own = paths_.shaders(p.pixel, p.sample, v.trail);
    if (own.empty()) return p;
    const Events other = paths_.reference(p.pixel, p.sample, Vec2(0.0), 0);
    const size_t e = parting_of(own, other);
    if (e < own.size() && e < other.size())
      p.parting = fmt::format("event {}: {}, but the reference's {}", e, paths_.describe(own[e]),
                              paths_.describe(other[e]));
    return p;
  }

  void look_at(const std::vector<Apart*>& samples, int angles, bool between) {
    parallel_for(0, int(samples.size()), [&](int n) {
      Apart& sample = *samples[size_t(n)];
      const bool diverged = value_.samples[sample.sample].trail != reference_.samples[sample.sample].trail;
      if (diverged)
        judge_diverged(sample, angles, between);
      else
        judge_steep(sample, angles, between);
    });
  }

  // If the same path carries different light, the reference's light must vary as much nearby.
  void judge_steep(Apart& sample, int angles, bool between) const {
    const Neighbourhood around(paths_.around(int(sample.sample % each_)), pixel_of(sample.sample), angles,
                               between);
    const Vec3 color(value_.samples[sample.sample].color);
    const bool moved = around.explains(color, tolerances_);
    const bool explained =
        !std::isinf(sample.excess) && (moved || around.explains_as_rounding(color, tolerances_));
    sample.outcome = explained ? Outcome::explained : Outcome::unexplained;
    sample.cause = moved ? around.cause(color, tolerances_) : Cause::rounding;
  }

  // If the path diverges, some path of the reference nearby must have the same events, up to and including
  // the event at which it diverges.
  void judge_diverged(Apart& sample, int angles, bool between) const {
    sample.outcome = Outcome::unexplained;
    const Pixel pixel = pixel_of(sample.sample);
    const int index = int(sample.sample % each_);
    const Events own = paths_.shaders(pixel, index, value_.samples[sample.sample].trail);
    if (own.empty()) return;
    const size_t end = parting_of(own, paths_.reference(pixel, index, Vec2(0.0), 0)) + 1;
    const auto reaches = [&](const Vec2& shift) {
      for (int variant = 0; variant < paths_.variants; ++variant) {
        const Events other = paths_.reference(pixel, index, shift, variant);
        if (other.size() >= end && std::equal(own.begin(), own.begin() + ptrdiff_t(end), other.begin()))
          return true;
      }
      return false;
    };
    const rounding::Positions positions = rounding::positions_around(
        paths_.rounding(pixel), reference_.samples[sample.sample].hits, angles, between);
    if (!reaches(Vec2(0.0)) && std::ranges::none_of(positions.all, reaches)) return;
    sample.outcome = Outcome::explained;
    sample.cause = Cause::diverged;
  }

  const Frame& value_;
  const Frame& reference_;
  const PathReference& paths_;
  const Tolerances& tolerances_;
  const size_t each_;  // samples a pixel
  std::vector<Apart> apart_;
  Tally tally_;
  double matching_excess_ = 0;
  size_t worst_matching_ = 0;
};

}  // namespace

Tally compare_paths(const Frame& value, const Frame& reference, const PathReference& paths,
                    const Tolerances& tolerances, std::vector<PixelOutcome>& outcomes) {
  PathJudge judge(value, reference, paths, tolerances);
  judge.compare_values();
  judge.explain();
  return judge.tally(outcomes);
}

}  // namespace eyeray::engine::compare
