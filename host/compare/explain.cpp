#include "host/compare/explain.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::compare {

namespace {

constexpr int rings = 4;
constexpr double radius_step = 0.001;  // pixels
// Rings between the innermost and those grow by this.
constexpr double radius_growth = 3;
// A rounding error grows from surface to surface: the neighbourhood of a path grows with the surfaces it
// strikes, to this at most.
constexpr double most_reach = 8;

// Whether low ≤ value ≤ high, each bound widened; false when any of them is NaN.
bool within(double value, double low, double high, double below, double above) {
  return value >= low - below && value <= high + above;
}

bool bounds_hold(std::span<const Probe> probes, const Vec3& value, const Tolerances& tolerances,
                 bool rounded) {
  // Each sample may fall on either side of its own edges, whatever the others do: the bounds of the mean are
  // the means of the bounds.
  const size_t samples = std::max(probes.front().sample_colors.size(), size_t{1});
  const auto color = [&](const Probe& probe, size_t sample) {
    return probe.sample_colors.empty() ? probe.color : probe.sample_colors[sample];
  };
  Vec3 low(0.0), high(0.0);
  for (size_t i = 0; i < samples; ++i) {
    Vec3 least = color(probes.front(), i), greatest = least;
    for (const Probe& probe : probes) {
      least = glm::min(least, color(probe, i));
      greatest = glm::max(greatest, color(probe, i));
      if (!rounded) continue;
      const size_t of_each = probe.rounded_colors.size() / samples;
      for (size_t k = i * of_each; k < (i + 1) * of_each; ++k) {
        least = glm::min(least, probe.rounded_colors[k]);
        greatest = glm::max(greatest, probe.rounded_colors[k]);
      }
    }
    low += least / double(samples);
    high += greatest / double(samples);
  }
  for (int c = 0; c < 3; ++c) {
    const double below = tolerances.color * std::max(1.0, std::abs(low[c]));
    const double above = tolerances.color * std::max(1.0, std::abs(high[c]));
    if (!within(value[c], low[c], high[c], below, above)) return false;
  }
  return true;
}

bool bounds_hold(std::span<const Probe> probes, const FirstHit& value, const Tolerances& tolerances) {
  // Gather what is known of the primitive that was hit.
  double t_low = 0, t_high = 0, tolerance = 0;
  Vec3 normal_low(0.0), normal_high(0.0);
  bool found = false;
  bool silhouette = false;
  for (const Probe& probe : probes) {
    const FirstHit& hit = probe.first_hit;
    if (hit.primitive != value.primitive || hit.material != value.material) {
      silhouette = true;
      continue;
    }
    t_low = found ? std::min(t_low, hit.t) : hit.t;
    t_high = found ? std::max(t_high, hit.t) : hit.t;
    tolerance = std::max(tolerance, t_tolerance(hit, tolerances));
    normal_low = found ? glm::min(normal_low, hit.normal) : hit.normal;
    normal_high = found ? glm::max(normal_high, hit.normal) : hit.normal;
    found = true;
  }
  if (!found) return false;

  if (value.primitive < 0) return std::isinf(value.t) && value.t > 0;
  // Towards a rim both run like a square root: it may lie as far beyond the last probe as the probes are
  // apart.
  const double beyond = silhouette ? 1 : 0;
  const double t_margin = beyond * (t_high - t_low) + tolerance;
  if (!within(value.t, t_low, t_high, t_margin, t_margin)) return false;
  for (int c = 0; c < 3; ++c) {
    const double margin = beyond * (normal_high[c] - normal_low[c]) + tolerances.normal;
    if (!within(value.normal[c], normal_low[c], normal_high[c], margin, margin)) return false;
  }
  return true;
}

}  // namespace

const char* name(Cause cause) {
  switch (cause) {
    case Cause::silhouette:
      return "silhouette";
    case Cause::texture_edge:
      return "texture edge";
    case Cause::refraction_branch:
      return "refraction branch";
    case Cause::shadow_edge:
      return "shadow edge";
    case Cause::grazing:
      return "grazing";
    case Cause::rounding:
      return "rounding";
    case Cause::undecidable:
      return "undecidable";
  }
  return "unknown";
}

Neighbourhood::Neighbourhood(const Reference& reference, Pixel pixel, int angles, bool between) {
  for (const bool coincident : {false, true})
    probes_.push_back(reference(pixel.x, pixel.y, Vec2(0.0), coincident));
  innermost_ = probes_.size();
  const double reach = std::min(most_reach, 1 + probes_.front().hits_per_sample / 8);

  // What varies more quickly than from ring to ring, the rings within show: a caustic's rim may be a
  // hundred-thousandth of a pixel wide.
  if (const double rounding = std::min(probes_.front().rounding, radius_step); rounding > 0) {
    add_ring(reference, pixel, rounding, angles, 0.25);
    innermost_ = probes_.size();
    if (between)
      for (double radius = radius_growth * rounding; radius < radius_step; radius *= radius_growth)
        add_ring(reference, pixel, radius * reach, angles / 2, 0.25);
  }
  // Each ring is turned a little, so that no direction is looked at twice.
  for (int ring = 1; ring <= rings; ++ring)
    add_ring(reference, pixel, ring * radius_step * reach, angles, (ring - 1.0) / rings);
}

void Neighbourhood::add_ring(const Reference& reference, Pixel pixel, double radius, int angles,
                             double turn) {
  for (int step = 0; step < angles; ++step) {
    const double angle = 2 * M_PI * (step + turn) / angles;
    probes_.push_back(reference(pixel.x, pixel.y, radius * Vec2(std::cos(angle), std::sin(angle)), false));
  }
}

bool Neighbourhood::explains(const Vec3& value, const Tolerances& tolerances) const {
  return bounds_hold(probes_, value, tolerances, false);
}

bool Neighbourhood::explains_as_rounding(const Vec3& value, const Tolerances& tolerances) const {
  return !probes_.front().rounded_colors.empty() && bounds_hold(probes_, value, tolerances, true);
}

bool Neighbourhood::explains(const FirstHit& value, const Tolerances& tolerances) const {
  return bounds_hold(probes_, value, tolerances);
}

Cause Neighbourhood::cause(const Vec3& value, const Tolerances& tolerances) const {
  return bounds_hold(innermost(), value, tolerances, false) ? Cause::undecidable : cause_of_color();
}

Cause Neighbourhood::cause(const FirstHit& value, const Tolerances& tolerances) const {
  return bounds_hold(innermost(), value, tolerances) ? Cause::undecidable : cause_of_first_hit();
}

Cause Neighbourhood::cause_of_color() const {
  const auto varies = [&](auto member) {
    return std::any_of(probes_.begin(), probes_.end(),
                       [&](const Probe& probe) { return probe.*member != probes_.front().*member; });
  };
  if (varies(&Probe::first_surfaces)) return Cause::silhouette;
  if (varies(&Probe::hits)) return Cause::refraction_branch;
  if (varies(&Probe::first_colors)) return Cause::texture_edge;
  const bool direct =
      std::all_of(probes_.begin(), probes_.end(), [](const Probe& probe) { return probe.direct; });
  return direct ? Cause::shadow_edge : Cause::refraction_branch;
}

Cause Neighbourhood::cause_of_first_hit() const {
  const int32_t primitive = probes_.front().first_hit.primitive;
  const bool same = std::all_of(probes_.begin(), probes_.end(),
                                [&](const Probe& probe) { return probe.first_hit.primitive == primitive; });
  return same ? Cause::grazing : Cause::silhouette;
}

}  // namespace eyeray::compare
