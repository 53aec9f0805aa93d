// Where a fault is to be looked for, from which executors part and at which value.
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

// Which side it is on. Empty where there is nothing to tell it by.
std::string side(const Report& report) {
  if (report.exact.empty()) return "";
  const ExactResult& pair = report.exact.front();
  const bool same = pair.comparison.passes(pair.ulp);
  const bool value_agrees = agrees_with_reference(report, pair.value),
             other_agrees = agrees_with_reference(report, pair.other);
  if (same)
    return fmt::format(
        "{} and {} agree with each other and not with the reference: look into the shaders, the "
        "records that are packed for them, or the reference",
        pair.value, pair.other);
  if (other_agrees && value_agrees)
    return fmt::format(
        "{0} and {1} agree with the reference, and not bit by bit with each other: look into {0}'s "
        "data by a bit, or what its compiler or driver does to float arithmetic",
        pair.value, pair.other);
  if (other_agrees || value_agrees)
    return fmt::format(
        "{} agrees with the reference: look into {}'s data, compiler or driver, or a shader of your own",
        other_agrees ? pair.other : pair.value, other_agrees ? pair.value : pair.other);
  return fmt::format(
      "neither {} nor {} agrees with the reference, nor they with each other: look into the "
      "shaders first",
      pair.value, pair.other);
}

// What is wrong first along the life of a ray.
std::string place(const ReferenceResult& result) {
  const ReferenceComparison& c = result.comparison;
  const std::span<const TallyType> types = c.types();
  const auto failing =
      std::ranges::find_if(types, [&](const TallyType& type) { return !(c.*type.tally).passes(); });
  if (failing == types.end()) return "";
  const Tally& tally = c.*failing->tally;
  switch (tally.worst.seam) {
    case Seam::primitive:
      return "eye rays hit something else: camera, traversal or intersection";
    case Seam::t:
      return "eye rays hit the right primitive at the wrong distance: its intersection";
    case Seam::position:
    case Seam::normal:
    case Seam::geometric_normal:
    case Seam::uv:
      return fmt::format("eye rays hit the right place, and its {} is wrong: the shape's surface",
                         name(tally.worst.seam));
    case Seam::material:
      return "eye rays hit the right place, with the wrong material: what is packed";
    case Seam::none:
    case Seam::color:
    case Seam::counts:
    case Seam::trail:
      break;
  }
  if (!c.first_hits.passes()) return "first hits differ";
  if (tally.worst.seam == Seam::trail) return "first hits agree, and paths part where the reference's do not";
  if (c.by_samples())
    return "paths decide the same, and bring other light: materials, densities, weights, lights or textures";
  if (!c.counts.passes()) {
    const bool further = tally.worst.reference_counts.x > 1 || tally.worst.value_counts.x > 1;
    return further ? "first hits agree, and reflected, refracted or shadow rays go or hit elsewhere"
                   : "first hits agree, and other rays are traced, or counted, from there";
  }
  return tally.worst.reference_counts.x > 1 ? "all rays hit the same, and the colours differ, where light is "
                                              "reflected or refracted: materials, "
                                              "lights or textures"
                                            : "all rays hit the same, and the colours differ, in direct "
                                              "light: materials, lights, shadows or "
                                              "textures";
}

}  // namespace

std::string Report::diagnosis() const {
  if (passes() || !not_verified.empty()) return "";
  for (const ExactResult& result : exact)
    if (!result.comparison.incomparable.empty()) return "";
  if (own_gates_pass())
    return "the scene's own gates pass: what it should look like has changed, in the scene or in how all "
           "executors see it; --update keeps the new picture";
  std::string text = side(*this);
  for (const ReferenceResult& result : against_reference) {
    const std::string found = place(result);
    if (found.empty()) continue;
    return text.empty() ? found : found + "; " + text;
  }
  return text;
}

}  // namespace eyeray::engine::compare
