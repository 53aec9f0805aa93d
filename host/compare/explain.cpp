#include "host/compare/explain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace eyeray::engine::compare {

namespace {

// At a crease, normals differ by more than this.
constexpr double least_crease = 0.01;

// The mean number of surfaces that a sample hits.
double hits_per_sample(const Neighbour& neighbour) {
  double hits = 0;
  for (const Neighbour::Sample& sample : neighbour.samples) hits += sample.counts.x;
  return hits / double(neighbour.samples.size());
}

// The least and the greatest of each component.
template <int n>
struct Bounds {
  using Value = glm::vec<n, double>;
  Value low{std::numeric_limits<double>::infinity()};
  Value high{-std::numeric_limits<double>::infinity()};

  void include(const Value& value) {
    low = glm::min(low, value);
    high = glm::max(high, value);
  }
  // True if `value` lies within the bounds, widened by `beyond` times their width, and by `margin` or by
  // `tolerance` · max(1, |bound|); false where it is NaN.
  bool hold(const Value& value, double margin, double beyond) const {
    return hold(value, beyond, [&](double) { return margin; });
  }
  bool hold_relatively(const Value& value, double tolerance, double beyond = 0) const {
    return hold(value, beyond, [&](double bound) { return tolerance * std::max(1.0, std::abs(bound)); });
  }

 private:
  template <typename Margin>
  bool hold(const Value& value, double beyond, const Margin& margin) const {
    for (int c = 0; c < n; ++c) {
      const double wider = beyond * (high[c] - low[c]);
      if (!(value[c] >= low[c] - wider - margin(low[c]) && value[c] <= high[c] + wider + margin(high[c])))
        return false;
    }
    return true;
  }
};

// Bounds of the mean of the samples' `member`. Each sample may fall on either side of its own edges,
// independently of the others. So the bounds of the mean are the means of the bounds.
template <int n>
Bounds<n> bounds(std::span<const Neighbour> neighbours, glm::vec<n, double> Neighbour::Sample::* member,
                 bool rounded) {
  const size_t samples = neighbours.front().samples.size();
  Bounds<n> mean{.low = {}, .high = {}};
  for (size_t i = 0; i < samples; ++i) {
    Bounds<n> sample;
    for (const Neighbour& neighbour : neighbours) {
      sample.include(neighbour.samples[i].*member);
      if (!rounded) continue;
      const size_t of_each = neighbour.rounded.size() / samples;
      for (size_t k = i * of_each; k < (i + 1) * of_each; ++k) sample.include(neighbour.rounded[k].*member);
    }
    mean.low += sample.low / double(samples);
    mean.high += sample.high / double(samples);
  }
  return mean;
}

bool bounds_hold(std::span<const Neighbour> neighbours, const Vec3& color, const Tolerances& tolerances,
                 bool rounded) {
  return bounds(neighbours, &Neighbour::Sample::color, rounded).hold_relatively(color, tolerances.color);
}

bool bounds_hold(std::span<const Neighbour> neighbours, const Counts& counts, bool rounded) {
  return bounds(neighbours, &Neighbour::Sample::counts, rounded).hold_relatively(counts, counts_tolerance);
}

bool bounds_hold(std::span<const Neighbour> neighbours, const FirstHit& value, const Tolerances& tolerances) {
  // Collect the bounds of the neighbours that hit the same primitive and material.
  Bounds<1> t, cosine;
  Bounds<2> uv;
  Bounds<3> position, normal, normal_geometric;
  double tolerance = 0;
  bool found = false;
  bool silhouette = false;
  for (const Neighbour& neighbour : neighbours) {
    const FirstHit& hit = neighbour.first_hit;
    if (hit.primitive != value.primitive || hit.material != value.material) {
      silhouette = true;
      continue;
    }
    t.include(glm::dvec1(hit.t));
    position.include(hit.position);
    normal.include(hit.normal);
    normal_geometric.include(hit.normal_geometric);
    cosine.include(glm::dvec1(hit.cosine));
    uv.include(hit.uv);
    tolerance = std::max(tolerance, t_tolerance(hit, tolerances));
    found = true;
  }
  if (!found) return false;

  if (value.primitive < 0) return std::isinf(value.t) && value.t > 0;
  // Towards a rim, all these values change like a square root. So they may lie beyond the neighbours' range
  // by its width.
  const double beyond = silhouette ? 1 : 0;
  return t.hold(glm::dvec1(value.t), tolerance, beyond) && position.hold(value.position, tolerance, beyond) &&
         normal.hold(value.normal, tolerances.normal, beyond) &&
         normal_geometric.hold(value.normal_geometric, tolerances.normal, beyond) &&
         cosine.hold(glm::dvec1(value.cosine), tolerances.normal, beyond) &&
         uv.hold_relatively(value.uv, tolerances.uv, beyond);
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
    case Cause::crease:
      return "crease";
    case Cause::grazing:
      return "grazing";
    case Cause::rounding:
      return "rounding";
    case Cause::undecidable:
      return "undecidable";
    case Cause::diverged:
      return "diverged";
  }
  return "unknown";
}

Neighbourhood::Neighbourhood(const Reference& reference, Pixel pixel, int angles, bool between) {
  const auto look = [&](const Vec2& shift, rounding::Coincidence coincidence) {
    neighbours_.push_back(reference(pixel.x, pixel.y, shift, coincidence));
  };
  for (const rounding::Coincidence coincidence :
       {rounding::Coincidence::none, rounding::Coincidence::coincident})
    look(Vec2(0.0), coincidence);
  const rounding::Positions positions = rounding::positions_around(
      neighbours_.front().rounding, hits_per_sample(neighbours_.front()), angles, between);
  for (size_t i = 0; i < positions.innermost; ++i) look(positions.all[i], rounding::Coincidence::turned);
  innermost_ = neighbours_.size() + positions.innermost;
  for (const Vec2& position : positions.all) look(position, rounding::Coincidence::none);
}

bool Neighbourhood::explains(const Vec3& value, const Tolerances& tolerances) const {
  return bounds_hold(neighbours_, value, tolerances, false);
}

bool Neighbourhood::explains(const Counts& value) const {
  return bounds_hold(neighbours_, value, false);
}

bool Neighbourhood::explains_as_rounding(const Vec3& value, const Tolerances& tolerances) const {
  return !neighbours_.front().rounded.empty() && bounds_hold(neighbours_, value, tolerances, true);
}

bool Neighbourhood::explains_as_rounding(const Counts& value) const {
  return !neighbours_.front().rounded.empty() && bounds_hold(neighbours_, value, true);
}

bool Neighbourhood::explains(const FirstHit& value, const Tolerances& tolerances) const {
  return bounds_hold(neighbours_, value, tolerances);
}

Cause Neighbourhood::cause(const Vec3& value, const Tolerances& tolerances) const {
  return bounds_hold(innermost(), value, tolerances, false) ? Cause::undecidable : cause_of_samples();
}

Cause Neighbourhood::cause(const Counts& value) const {
  return bounds_hold(innermost(), value, false) ? Cause::undecidable : cause_of_samples();
}

Cause Neighbourhood::cause(const FirstHit& value, const Tolerances& tolerances) const {
  return bounds_hold(innermost(), value, tolerances) ? Cause::undecidable : cause_of_first_hit(tolerances);
}

Cause Neighbourhood::cause_of_samples() const {
  const auto varies = [&](const auto& of) {
    return std::any_of(neighbours_.begin(), neighbours_.end(), [&](const Neighbour& neighbour) {
      return std::invoke(of, neighbour) != std::invoke(of, neighbours_.front());
    });
  };
  if (varies(&Neighbour::first_surfaces)) return Cause::silhouette;
  if (varies(hits_per_sample)) return Cause::refraction_branch;
  if (varies(&Neighbour::first_colors)) return Cause::texture_edge;
  const bool direct = std::all_of(neighbours_.begin(), neighbours_.end(),
                                  [](const Neighbour& neighbour) { return neighbour.direct; });
  return direct ? Cause::shadow_edge : Cause::refraction_branch;
}

Cause Neighbourhood::cause_of_first_hit(const Tolerances& tolerances) const {
  const FirstHit& centre = neighbours_.front().first_hit;
  Bounds<1> t;
  Bounds<3> normal;
  for (const Neighbour& neighbour : neighbours_) {
    if (neighbour.first_hit.primitive != centre.primitive) return Cause::silhouette;
    t.include(glm::dvec1(neighbour.first_hit.t));
    normal.include(neighbour.first_hit.normal);
  }
  if (t.high.x - t.low.x > t_tolerance(centre, tolerances)) return Cause::grazing;
  return glm::distance(normal.low, normal.high) > least_crease ? Cause::crease : Cause::texture_edge;
}

}  // namespace eyeray::engine::compare
