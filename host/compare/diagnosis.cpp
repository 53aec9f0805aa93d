// Derives the origin of a fault from the executors that diverge and the value at which they diverge.
#include <fmt/format.h>

#include <algorithm>

#include "host/compare/report.hpp"

namespace eyeray::engine::compare {

namespace {

bool agrees_with_reference(const Report& report, const std::string& executor) {
  return std::ranges::any_of(report.against_reference, [&](const ReferenceResult& result) {
    return result.value == executor && result.comparison.passes();
  });
}

// The executors or data that are at fault, in words. Empty if nothing indicates them.
std::string side(const Report& report) {
  if (report.exact.empty()) return "";
  const ExactResult& pair = report.exact.front();
  const bool same = pair.comparison.passes(pair.ulp);
  const bool value_agrees = agrees_with_reference(report, pair.value),
             other_agrees = agrees_with_reference(report, pair.other);
  if (same)
    return fmt::format(
        "{} and {} agree with each other, but not with the reference: check the shaders, the records that "
        "are packed for them, or the reference",
        pair.value, pair.other);
  if (other_agrees && value_agrees)
    return fmt::format(
        "{0} and {1} agree with the reference, but not bit by bit with each other: check {0}'s data for a "
        "wrong bit, or how its compiler or driver changes float arithmetic",
        pair.value, pair.other);
  if (other_agrees || value_agrees)
    return fmt::format(
        "{} agrees with the reference: check {}'s data, compiler or driver, or your own shaders",
        other_agrees ? pair.other : pair.value, other_agrees ? pair.value : pair.other);
  return fmt::format(
      "{} and {} agree neither with the reference nor with each other: check the shaders first", pair.value,
      pair.other);
}

// The first wrong value along the life of a ray, in words.
std::string first_wrong_value(const ReferenceResult& result) {
  const ReferenceComparison& c = result.comparison;
  const std::span<const TallyType> types = c.types();
  const auto failing =
      std::ranges::find_if(types, [&](const TallyType& type) { return !(c.*type.tally).passes(); });
  if (failing == types.end()) return "";
  const Tally& tally = c.*failing->tally;
  switch (tally.worst.seam) {
    case Seam::primitive:
      return "camera rays hit another primitive: check the camera, traversal or intersection";
    case Seam::t:
      return "camera rays hit the right primitive at the wrong distance: check its intersection";
    case Seam::position:
    case Seam::normal:
    case Seam::geometric_normal:
    case Seam::uv:
      return fmt::format("camera rays hit the right point, but its {} is wrong: check the shape's surface",
                         name(tally.worst.seam));
    case Seam::material:
      return "camera rays hit the right point, but with the wrong material: check the packed records";
    case Seam::none:
    case Seam::color:
    case Seam::counts:
    case Seam::trail:
      break;
  }
  if (!c.first_hits.passes()) return "first hits differ";
  if (tally.worst.seam == Seam::trail)
    return "first hits agree, but paths diverge where the reference's do not";
  if (c.by_samples())
    return "paths take the same decisions, but carry other light: check materials, densities, weights, "
           "lights or textures";
  if (!c.counts.passes()) {
    const bool further = tally.worst.reference_counts.x > 1 || tally.worst.value_counts.x > 1;
    return further ? "first hits agree, but reflected, refracted or shadow rays have other directions or hits"
                   : "first hits agree, but other rays are traced, or counted, from there";
  }
  return tally.worst.reference_counts.x > 1 ? "all rays have the same hits, but colours differ where light "
                                              "is reflected or refracted: check materials, lights or textures"
                                            : "all rays have the same hits, but colours differ in direct "
                                              "light: check materials, lights, shadows or textures";
}

}  // namespace

std::string Report::diagnosis() const {
  if (passes() || !not_verified.empty() || is_kernel()) return "";
  for (const ExactResult& result : exact)
    if (!result.comparison.incomparable.empty()) return "";
  if (own_gates_pass())
    return "the scene's own gates pass, so its expected look has changed, by the scene or by a change in all "
           "executors; --update keeps the new picture";
  Report noisy = *this;
  noisy.denoised.clear();
  if (noisy.passes())
    return "only denoised pictures fail: check shaders/denoise, its kernel, or the denoisers on the host";
  std::string text = side(*this);
  for (const ReferenceResult& result : against_reference) {
    const std::string found = first_wrong_value(result);
    if (found.empty()) continue;
    return text.empty() ? found : found + "; " + text;
  }
  return text;
}

}  // namespace eyeray::engine::compare
