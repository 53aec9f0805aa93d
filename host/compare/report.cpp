#include "host/compare/report.hpp"
#include "host/core/escaped_text.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace eyeray::engine::compare {

namespace {

// "gate B: gpu against the reference, colours: 14 of 6912 pixels differ unexplained; the worst is 3,4, which
// diverges at t".
void add_failures(std::vector<std::string>& failures, const std::string& sides, const TallyType& type,
                  const Tally& tally) {
  const auto add = [&](int64_t count, const std::string& what) {
    if (count <= 0) return;
    failures.push_back(
        fmt::format("gate {}: {}, {}: {} of {} {} differ {}; the worst is {},{}, which diverges at {}",
                    type.gate, sides, type.of, count, tally.pixels, type.unit, what, tally.worst.pixel.x,
                    tally.worst.pixel.y, name(tally.worst.seam)));
  };
  add(tally.unexplained + tally.unexamined, "unexplained");
  if (tally.capped_pixels() > tally.may_be_explained)
    add(tally.capped_pixels(),
        fmt::format("explained, which is more than the {} allowed", tally.may_be_explained));
}

std::string describe(const PairedSum& sum) {
  return fmt::format(
      "the tile of {}×{} pixels at {},{} differs by {:.2g} on average in channel {}; up to {:.2g} may be "
      "chance",
      sum.tile.width, sum.tile.height, sum.tile.x, sum.tile.y, sum.share, sum.channel, sum.allowed);
}

std::string describe(const ExactResult& result) {
  const ExactComparison& c = result.comparison;
  if (c.rays != c.other_rays && c.different_pixels == 0) {
    return fmt::format("gate A: {} and {}: {} rays against {}", result.value, result.other, c.rays,
                       c.other_rays);
  }
  return fmt::format(
      "gate A: {} and {}: {} of {} pixels differ in their bits, {} of them in an id, by at most {} ULP "
      "(allowed: {}); the worst is {},{}, which diverges at {}",
      result.value, result.other, c.different_pixels, c.pixels, c.different_ids, c.max_ulp, result.ulp,
      c.worst.pixel.x, c.worst.pixel.y, name(c.worst.seam));
}

void add_failures(std::vector<std::string>& failures, const DenoisedResult& result) {
  if (!result.equals_other())
    failures.push_back(fmt::format("gate A: {} and {}, denoised: {} of {} pixels differ in their bits",
                                   result.other, result.value, result.different, result.pixels));
  if (result.agrees_with_reference()) return;
  const std::string sides = fmt::format("gate B: {} against the reference, denoised", result.value);
  if (result.wrong > 0)
    failures.push_back(
        fmt::format("{}: {} of {} pixels differ by more than the tolerance; the worst is {},{}", sides,
                    result.wrong, result.pixels, result.worst.x, result.worst.y));
  else
    failures.push_back(
        fmt::format("{}: rounding may decide {} of {} pixels, which is more than the {} allowed", sides,
                    result.undecided, result.pixels, result.may_be_undecided()));
}

std::string describe(const RasterResult& result) {
  return fmt::format(
      "gate R: {} against the rasteriser: {} of {} pixels are not explained by the geometry; the first is "
      "{},{}: "
      "{}",
      result.value, result.unexplained, result.pixels, result.pixel.x, result.pixel.y, result.difference);
}

}  // namespace

int64_t PhotonTally::may_diverge() const {
  constexpr double share = 4e-2;
  constexpr int usual_depth = 8;
  return std::max<int64_t>(4, int64_t(share * double(sent) * std::max(depth, usual_depth) / usual_depth));
}

std::string Report::note_of_shaders() const {
  constexpr size_t shown = 8;
  if (changed_shaders.empty()) return "";
  const size_t count = changed_shaders.size();
  const std::span<const std::string> first(changed_shaders.data(), std::min(count, shown));
  return fmt::format("shaders that differ from eyeray's own: {}{}{}", fmt::join(first, ", "),
                     count > shown ? fmt::format(" and {} more", count - shown) : "",
                     twin_has_changed_shaders ? "" : "; the twin has the built-in ones");
}

std::vector<std::string> Report::failures() const {
  if (!not_verified.empty())
    return may_stay_unverified ? std::vector<std::string>{}
                               : std::vector<std::string>{"not verified: " + not_verified};
  std::vector<std::string> failures;
  const bool watched =
      std::ranges::any_of(participants, [](const Participant& each) { return each.findings.has_value(); });
  const bool compared = is_kernel() ? watched || !buffers.empty() : participants.size() >= 2;
  if (!compared) failures.push_back("nothing was compared");

  // Faults within one picture come first: they make the comparisons fail too.
  for (const Participant& p : participants) {
    if (!p.soundness.ok()) failures.push_back(fmt::format("{}: {}", p.name, compare::describe(p.soundness)));
    if (p.findings && !p.findings->empty())
      failures.push_back(fmt::format("gate S: faults in the kernels: {}; the first is {}", p.findings->size(),
                                     p.findings->front()));
  }
  if (photons && !photons->passes())
    failures.push_back(fmt::format(
        "gate D: twin against the reference, photons: of {}, {} diverge ({} may), {} are displaced ({} may), "
        "and {} of these are unexplained{}",
        photons->sent, photons->diverged, photons->may_diverge(), photons->displaced,
        photons->may_be_displaced(), photons->unexplained,
        photons->worst.empty() ? "" : "; the first is " + photons->worst));
  for (const ExactResult& result : exact) {
    const ExactComparison& c = result.comparison;
    if (!c.incomparable.empty()) {
      failures.push_back(fmt::format("gate A: {} and {}: {}", result.value, result.other, c.incomparable));
    } else if (!c.passes(result.ulp)) {
      failures.push_back(describe(result));
    }
  }
  for (const ReferenceResult& result : against_reference) {
    const ReferenceComparison& c = result.comparison;
    if (!c.incomparable.empty()) {
      failures.push_back(fmt::format("gate B: {} against the reference: {}", result.value, c.incomparable));
      continue;
    }
    for (const TallyType& type : c.types())
      add_failures(failures, result.value + " against the reference", type, c.*type.tally);
    if (c.by_samples() && !(c.paired_sum.excess() <= 1))
      failures.push_back(
          fmt::format("gate D: {} against the reference: {}", result.value, describe(c.paired_sum)));
  }
  for (const BufferResult& result : buffers)
    if (!result.passes()) failures.push_back(failure_of(result));
  for (const DenoisedResult& result : denoised) add_failures(failures, result);
  for (const RasterResult& result : raster)
    if (!result.passes()) failures.push_back(describe(result));
  if (golden && !golden->passes()) {
    if (!golden->incomparable.empty())
      failures.push_back(fmt::format("gate G: {}: {}", golden->file, golden->incomparable));
    else
      add_failures(failures, golden->value + " against " + golden->file, golden_type, golden->colors);
    if (!golden->refused.empty()) failures.back() += "; it was not updated: " + golden->refused;
  }
  if (!failures.empty() && !changed_shaders.empty()) failures.insert(failures.begin(), note_of_shaders());
  return failures;
}

bool Report::own_gates_pass() const {
  Report own = *this;
  own.golden.reset();
  return own.passes();
}

std::optional<double> Report::healthy_allowance() const {
  Report uncapped = *this;
  double share = 0;
  for (ReferenceResult& result : uncapped.against_reference) {
    ReferenceComparison& c = result.comparison;
    for (const TallyType& type : c.types()) {
      Tally& tally = c.*type.tally;
      tally.may_be_explained = tally.pixels;
      share = std::max(share, double(tally.capped_pixels()) / double(std::max(tally.pixels, int64_t{1})));
    }
  }
  if (!uncapped.passes()) return std::nullopt;
  return std::ceil(2 * share * 1e5) / 1e5;
}

std::optional<Pixel> Report::pixel_to_look_at() const {
  for (const Participant& p : participants) {
    if (p.soundness.first.x >= 0) return p.soundness.first;
  }
  for (const ExactResult& result : exact) {
    const bool fails = !result.comparison.passes(result.ulp);
    if (fails && result.comparison.worst.seam != Seam::none) return result.comparison.worst.pixel;
  }
  for (const ReferenceResult& result : against_reference) {
    if (!result.comparison.incomparable.empty()) continue;
    for (const TallyType& type : result.comparison.types()) {
      const Tally& tally = result.comparison.*type.tally;
      if (!tally.passes()) return tally.worst.pixel;
    }
  }
  for (const RasterResult& result : raster)
    if (!result.passes()) return result.pixel;
  if (golden && golden->incomparable.empty() && !golden->passes()) return golden->colors.worst.pixel;
  return std::nullopt;
}

std::vector<FirstHit> Report::shown_hits() const {
  std::vector<FirstHit> hits;
  const auto add = [&](const WorstPixel& worst) {
    hits.push_back(worst.value_hit);
    hits.push_back(worst.reference_hit);
  };
  for (const ExactResult& result : exact) {
    if (result.comparison.worst.seam != Seam::none) add(result.comparison.worst);
  }
  for (const ReferenceResult& result : against_reference) {
    for (const TallyType& type : result.comparison.types()) {
      const Tally& tally = result.comparison.*type.tally;
      if (tally.worst.excess > 0) add(tally.worst);
    }
  }
  for (const RasterResult& result : raster) {
    hits.push_back(result.traced);
    FirstHit drawn;
    drawn.primitive = result.drawn;
    hits.push_back(drawn);
  }
  return hits;
}

std::string Report::command_to_look() const {
  const std::optional<Pixel> pixel = pixel_to_look_at();
  if (!pixel) return "";
  const int w = std::min(9, width), h = std::min(9, height);
  const int x = std::clamp(pixel->x - w / 2, 0, width - w), y = std::clamp(pixel->y - h / 2, 0, height - h);
  return fmt::format("eyeray verify {}{}{} --crop {},{},{},{}", shell_word(scene), options,
                     raster.empty() ? "" : " --raster", x, y, w, h);
}

std::string Report::command_to_probe() const {
  const std::optional<Pixel> pixel = pixel_to_look_at();
  return pixel ? fmt::format("eyeray probe {} {},{}{}", shell_word(scene), pixel->x, pixel->y, options) : "";
}

std::string_view Report::verdict() const {
  return !passes() ? "failed" : not_verified.empty() ? "passed" : "skipped";
}

int64_t Report::count(int64_t (*of)(const Tally&)) const {
  int64_t most = 0;
  for (const ReferenceResult& result : against_reference)
    for (const TallyType& type : result.comparison.types())
      most = std::max(most, of(result.comparison.*type.tally));
  return most;
}

}  // namespace eyeray::engine::compare
