#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "host/compare/report.hpp"
#include "host/core/github_text.hpp"

namespace eyeray::engine::compare {

namespace {

template <typename... Args>
void line(std::string& text, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
  text += '\n';
}

std::string numbers(const Vec3& v) {
  return fmt::format("{:.9g} {:.9g} {:.9g}", v.x, v.y, v.z);
}

// ` (sphere "left eye", scene.toml:12)`, or "" if no name is known for the index.
std::string in_words(const std::map<int32_t, std::string>& words, int32_t index) {
  const auto found = words.find(index);
  return found == words.end() ? "" : fmt::format(" ({})", found->second);
}

std::string describe(const FirstHit& hit, const Report& report) {
  if (hit.primitive < 0) return "hits nothing";
  return fmt::format(
      "primitive {}{}, material {}{}, t {:.9g}, position {}, normal {}, geometric {}, uv {:.9g} {:.9g}",
      hit.primitive, in_words(report.primitives, hit.primitive), hit.material,
      in_words(report.materials, hit.material), hit.t, numbers(hit.position), numbers(hit.normal),
      numbers(hit.normal_geometric), hit.uv.x, hit.uv.y);
}

// "2 explained (silhouette 1, shadow edge 1)".
std::string explained(const Tally& tally) {
  std::string text = fmt::format("{} explained", tally.explained_pixels());
  std::string causes;
  for (int i = 0; i < cause_count; ++i) {
    const int64_t count = tally.explained[size_t(i)];
    if (count > 0) causes += fmt::format("{}{} {}", causes.empty() ? "" : ", ", name(Cause(i)), count);
  }
  return causes.empty() ? text : text + " (" + causes + ")";
}

// Adds both sides' values of the worst pixel, and names the seam.
void add_worst(std::string& text, const Report& report, const WorstPixel& worst, const std::string& value,
               const std::string& reference, const char* unit) {
  const std::string error = std::isinf(worst.excess) ? "beyond all" : fmt::format("{:.3g}", worst.excess);
  line(text, "    worst pixel {},{}{}: {} {}{}{}", worst.pixel.x, worst.pixel.y,
       worst.sample < 0 ? "" : fmt::format(", sample {}", worst.sample), error, unit,
       worst.seam == Seam::none ? "" : fmt::format(", diverges at {}", name(worst.seam)),
       worst.parting.empty() ? "" : ", " + worst.parting);
  const auto side = [&](const std::string& who, const Vec3& color, const Counts& counts,
                        const FirstHit& hit) {
    line(text, "      {:9} color {}; {:.9g} surfaces, {:.9g} rays; {}", who, numbers(color), counts.x,
         counts.y, describe(hit, report));
  };
  side(value, worst.value, worst.value_counts, worst.value_hit);
  side(reference, worst.reference, worst.reference_counts, worst.reference_hit);
}

void add_tally(std::string& text, const Report& report, const std::string& value,
               const std::string& reference, const TallyType& type, const Tally& tally) {
  line(text, "  gate {} {} {} = {}, {}: {} equal, {} matching, {}, {} unexplained", type.gate,
       tally.passes() ? "passed" : "FAILED", value, reference, type.of, tally.equal, tally.matching,
       explained(tally), tally.unexplained);
  if (tally.unexamined > 0) {
    line(text, "    {} more differ and were not examined: {}", tally.unexamined,
         tally.capped_pixels() > tally.may_be_explained
             ? fmt::format("at most {} may be explained", tally.may_be_explained)
             : "too many of these are unexplained");
  }
  if (!tally.passes()) add_worst(text, report, tally.worst, value, reference, "tolerances");
}

void add(std::string& text, const Report& report, const ExactResult& result) {
  const ExactComparison& c = result.comparison;
  line(text, "  gate A {} {} = {}: {} of {} pixels differ in their bits{}",
       c.passes(result.ulp) ? "passed" : "FAILED", result.value, result.other, c.different_pixels, c.pixels,
       c.different_pixels > 0 ? fmt::format(", by at most {} ULP (allowed: {})", c.max_ulp, result.ulp) : "");
  if (c.worst.seam != Seam::none) add_worst(text, report, c.worst, result.value, result.other, "ULP");
}

void add(std::string& text, const Report& report, const ReferenceResult& result) {
  for (const TallyType& type : result.comparison.types())
    add_tally(text, report, result.value, "reference", type, result.comparison.*type.tally);
  if (const PairedSum& sum = result.comparison.paired_sum; result.comparison.by_samples())
    line(text,
         "  gate D {} {} = reference, sums: {}×{} pixels at {},{} differ by {:.2g} on average in channel {}; "
         "up to {:.2g} may be chance",
         sum.excess() <= 1 ? "passed" : "FAILED", result.value, sum.tile.width, sum.tile.height, sum.tile.x,
         sum.tile.y, sum.share, sum.channel, sum.allowed);
  if (result.metrics) line(text, "    {}", to_text(*result.metrics));
}

void add(std::string& text, const DenoisedResult& result) {
  if (!result.other.empty())
    line(text, "  gate A {} {} = {}, denoised: {} of {} pixels differ in their bits",
         result.equals_other() ? "passed" : "FAILED", result.other, result.value, result.different,
         result.pixels);
  line(text,
       "  gate B {} {} = reference, denoised: {} of {} pixels differ by more than the tolerance, the largest "
       "by "
       "{:.3g} tolerances; {} undecided",
       result.agrees_with_reference() ? "passed" : "FAILED", result.value, result.wrong, result.pixels,
       result.largest, result.undecided);
  if (result.agrees_with_reference()) return;
  line(text, "    worst pixel {},{}", result.worst.x, result.worst.y);
  line(text, "      {:9} {:.9g}", result.value, fmt::join(result.worst_value, " "));
  line(text, "      reference {:.9g}", fmt::join(result.worst_reference, " "));
}

std::string numbered(const std::map<std::string, uint64_t>& counts) {
  std::string text;
  for (const auto& [what, count] : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  return text;
}

void add(std::string& text, const Report& report, const RasterResult& result) {
  const int64_t compared = result.pixels - result.hidden;
  const std::string share =
      compared > 0 ? fmt::format(" ({:.3f} %)", 100 * double(result.equal) / double(compared)) : "";
  std::string causes;
  for (int i = 0; i < raster_cause_count; ++i)
    if (const int64_t count = result.explained[size_t(i)]; count > 0)
      causes += fmt::format("{}{} {}", causes.empty() ? " (" : ", ", name(RasterCause(i)), count);
  line(text, "  gate R {} {} = the rasteriser: {} equal{}, {} explained{}, {} unexplained{}",
       result.passes() ? "passed" : "FAILED", result.value, result.equal, share, result.explained_pixels(),
       causes.empty() ? "" : causes + ")", result.unexplained,
       result.hidden > 0 ? fmt::format(", {} behind shapes that are not drawn", result.hidden) : "");
  if (result.passes()) return;
  line(text, "    pixel {},{}: {}", result.pixel.x, result.pixel.y, result.difference);
  line(text, "      {:9} {}", result.value, describe(result.traced, report));
  line(text, "      drawn     {}",
       result.drawn < 0 ? "nothing"
                        : fmt::format("primitive {}{}, t {:.9g}", result.drawn,
                                      in_words(report.primitives, result.drawn), result.drawn_t));
}

// Adds a line on the rasteriser's picture, which is the same for all executors.
void add_drawing(std::string& text, const RasterResult& result) {
  line(text, "  rasteriser: {}, {} triangles{}", result.device, result.triangles,
       result.not_drawn.empty() ? "" : "; not drawn: " + numbered(result.not_drawn));
}

void add(std::string& text, const Report& report, const GoldenResult& result) {
  if (result.incomparable.empty()) {
    add_tally(text, report, "golden", result.value, golden_type, result.colors);
    if (result.metrics) line(text, "    {}", to_text(*result.metrics));
  }
  if (!result.changed.empty())
    line(text, "    changed since the golden picture was made: {}", fmt::join(result.changed, ", "));
  if (result.updated) line(text, "  updated {}", result.file);
}

// True if gate A found every bit of this executor equal to the first one's, so that there is nothing new to
// report.
bool same_as_first(const Report& report, const ReferenceResult& result) {
  return std::any_of(report.exact.begin(), report.exact.end(), [&](const ExactResult& exact) {
    return exact.value == report.against_reference[0].value && exact.other == result.value &&
           exact.comparison.passes(0);
  });
}

}  // namespace

std::string to_text(const Metrics& m) {
  return fmt::format(
      "RMSE {:.3g}, PSNR {:.1f} dB, p99 {:.3g}, p99.9 {:.3g}, max {:.3g} at {},{}, SSIM {:.6f}, FLIP {:.3g}",
      m.rmse, m.psnr, m.p99, m.p999, m.max, m.max_at.x, m.max_at.y, m.ssim, m.flip.mean);
}

std::string to_lines(const Metrics& m, const std::string& indent) {
  std::string text;
  line(text, "{}RMSE {:.3g}, PSNR {:.1f} dB, relative MSE {:.3g}, SSIM {:.6f}", indent, m.rmse, m.psnr,
       m.relative_mse, m.ssim);
  line(text, "{}differences: p95 {:.3g}, p99 {:.3g}, p99.9 {:.3g}, max {:.3g} at {},{}: {} against {}",
       indent, m.p95, m.p99, m.p999, m.max, m.max_at.x, m.max_at.y, numbers(m.max_a), numbers(m.max_b));
  line(text, "{}FLIP: mean {:.3g}, p95 {:.3g}, p99 {:.3g}", indent, m.flip.mean, m.flip.p95, m.flip.p99);
  if (const std::optional<HdrFlip>& hdr = m.hdr_flip)
    line(text, "{}HDR-FLIP: mean {:.3g}, p95 {:.3g}, p99 {:.3g}, {} exposures from {:.4g} to {:.4g} stops",
         indent, hdr->flip.mean, hdr->flip.p95, hdr->flip.p99, hdr->exposures.count, hdr->exposures.start,
         hdr->exposures.stop);
  line(text, "{}values on screen that differ by more than {} of 255: {} pixels", indent,
       fmt::join(display_steps, ", "), fmt::join(m.display_over, ", "));
  return text;
}

std::string to_text(const Report& report) {
  // The verdict and its reasons.
  const std::vector<std::string> failures = report.failures();
  std::string text;
  if (!report.not_verified.empty()) {
    line(text, "{} {}", failures.empty() ? "SKIPPED" : "FAILED", log_line(report.scene));
    line(text, "  not verified: {}", report.not_verified);
    return log_lines(text);
  }
  line(text, "{} {} ({})", failures.empty() ? "PASSED" : "FAILED", log_line(report.scene),
       report.is_kernel()
           ? report.dispatch
           : fmt::format("{}×{} of {}×{} pixels, {} sample{} a pixel", report.area.width, report.area.height,
                         report.width, report.height, report.samples, report.samples == 1 ? "" : "s"));
  if (failures.empty() && !report.changed_shaders.empty()) line(text, "  {}", report.note_of_shaders());
  for (const std::string& failure : failures) line(text, "  {}", failure);
  if (const std::string diagnosis = report.diagnosis(); !diagnosis.empty())
    line(text, "  diagnosis: {}", diagnosis);

  // The participants, and every gate in detail.
  for (const Participant& p : report.participants) {
    line(text, "  {} ({}{:.3g} s)", p.description,
         report.is_kernel() ? "" : fmt::format("{} rays in ", p.rays), p.seconds);
  }
  for (const Participant& p : report.participants) {
    if (!p.findings) continue;
    line(text, "  gate S {} {}, faults in its kernels: {}", p.findings->empty() ? "passed" : "FAILED", p.name,
         p.findings->size());
    for (const std::string& finding : *p.findings) line(text, "    {}", finding);
  }
  for (const ExactResult& result : report.exact) {
    if (result.comparison.incomparable.empty()) add(text, report, result);
  }
  if (const auto& photons = report.photons)
    line(text,
         "  gate D {} twin = reference, photons: of {}, {} diverge ({} may) and {} are displaced ({} may), "
         "{} unexplained; they are left out",
         photons->passes() ? "passed" : "FAILED", photons->sent, photons->diverged, photons->may_diverge(),
         photons->displaced, photons->may_be_displaced(), photons->unexplained);
  for (const ReferenceResult& result : report.against_reference) {
    if (!result.comparison.incomparable.empty()) continue;
    if (same_as_first(report, result)) {
      line(text, "  gates {} {} {} = reference: the same as {}, bit by bit",
           result.comparison.by_samples() ? "C and D" : "B and C",
           result.comparison.passes() ? "passed" : "FAILED", result.value, report.against_reference[0].value);
    } else {
      add(text, report, result);
    }
  }
  for (const BufferResult& result : report.buffers) {
    line(text, "  {}", to_text(result));
    if (!result.first.empty()) line(text, "    {}", result.first);
  }
  for (const DenoisedResult& result : report.denoised) add(text, result);
  if (!report.raster.empty()) add_drawing(text, report.raster[0]);
  for (const RasterResult& result : report.raster) add(text, report, result);
  if (report.golden) add(text, report, *report.golden);

  // The next command to run.
  if (const std::string command = report.command_to_look(); !command.empty())
    line(text, "  look closer: {}\n  its rays: {}", command, report.command_to_probe());
  if (!report.kept.empty())
    line(text, "  {} are kept in {}", report.is_kernel() ? "the buffers" : "pictures and the command line",
         report.kept);
  return log_lines(text);
}

}  // namespace eyeray::engine::compare
