#include "host/compare/tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/error.hpp"

namespace eyeray::engine::compare {

namespace {

// error / tolerance; infinite if the error is NaN.
double ratio(double error, double tolerance) {
  if (error == 0) return 0;
  return error <= std::numeric_limits<double>::max() ? error / tolerance
                                                     : std::numeric_limits<double>::infinity();
}

// Two misses agree: both t are infinite, and their difference is NaN.
double t_excess(double value, const FirstHit& reference, const Tolerances& tolerances) {
  if (value == reference.t) return 0;
  return ratio(std::abs(value - reference.t), t_tolerance(reference, tolerances));
}

double position_excess(const Vec3& value, const FirstHit& reference, const Tolerances& tolerances) {
  if (value == reference.position) return 0;
  return ratio(glm::distance(value, reference.position), t_tolerance(reference, tolerances));
}

double normal_excess(const Vec3& value, const Vec3& reference, double tolerance) {
  double worst = 0;
  for (int c = 0; c < 3; ++c) worst = std::max(worst, ratio(std::abs(value[c] - reference[c]), tolerance));
  return worst;
}

// The excess of the geometric normal, and of its cosine with the ray.
double geometric_excess(const FirstHit& value, const FirstHit& reference, double tolerance) {
  return std::max(normal_excess(value.normal_geometric, reference.normal_geometric, tolerance),
                  ratio(std::abs(value.cosine - reference.cosine), tolerance));
}

// The excess of vectors whose components may be large: above 1, the tolerance is relative.
template <int n>
double relative_excess(const glm::vec<n, double>& value, const glm::vec<n, double>& reference,
                       double tolerance) {
  double worst = 0;
  for (int c = 0; c < n; ++c) {
    const double allowed = tolerance * std::max(1.0, std::abs(reference[c]));
    worst = std::max(worst, ratio(std::abs(value[c] - reference[c]), allowed));
  }
  return worst;
}

}  // namespace

void Tolerances::check() const {
  for (const auto& [tolerance, cap] :
       {std::pair{color, 1e-3}, {t, 1e-3}, {normal, 1e-3}, {uv, 1e-3}, {max_explained, 0.05}}) {
    CHECK_LE(0.0, tolerance);
    CHECK_LE(tolerance, cap);
  }
}

double t_tolerance(const FirstHit& reference, const Tolerances& tolerances) {
  return std::max(tolerances.t * std::abs(reference.t), 0x1p-22 * reference.t_scale);
}

double color_excess(const Vec3& value, const Vec3& reference, double tolerance) {
  return relative_excess(value, reference, tolerance);
}

double counts_excess(const Counts& value, const Counts& reference) {
  return relative_excess(value, reference, counts_tolerance);
}

double hit_excess(const FirstHit& value, const FirstHit& reference, const Tolerances& tolerances) {
  if (value.primitive != reference.primitive || value.material != reference.material) {
    return std::numeric_limits<double>::infinity();
  }
  return std::max({t_excess(value.t, reference, tolerances),
                   position_excess(value.position, reference, tolerances),
                   normal_excess(value.normal, reference.normal, tolerances.normal),
                   geometric_excess(value, reference, tolerances.normal),
                   relative_excess(value.uv, reference.uv, tolerances.uv)});
}

Seam first_seam(const WorstPixel& pixel, const Tolerances& tolerances, bool hit_is_explained) {
  const FirstHit &value = pixel.value_hit, &reference = pixel.reference_hit;
  if (!hit_is_explained) {
    if (value.primitive != reference.primitive) return Seam::primitive;
    if (t_excess(value.t, reference, tolerances) > 1) return Seam::t;
    if (position_excess(value.position, reference, tolerances) > 1) return Seam::position;
    if (normal_excess(value.normal, reference.normal, tolerances.normal) > 1) return Seam::normal;
    if (geometric_excess(value, reference, tolerances.normal) > 1) return Seam::geometric_normal;
    if (relative_excess(value.uv, reference.uv, tolerances.uv) > 1) return Seam::uv;
    if (value.material != reference.material) return Seam::material;
  }
  if (color_excess(pixel.value, pixel.reference, tolerances.color) > 1) return Seam::color;
  return counts_excess(pixel.value_counts, pixel.reference_counts) > 1 ? Seam::counts : Seam::none;
}

const char* name(Seam seam) {
  switch (seam) {
    case Seam::none:
      return "none";
    case Seam::primitive:
      return "primitive";
    case Seam::t:
      return "t";
    case Seam::position:
      return "position";
    case Seam::normal:
      return "normal";
    case Seam::geometric_normal:
      return "geometric normal";
    case Seam::uv:
      return "uv";
    case Seam::material:
      return "material";
    case Seam::color:
      return "color";
    case Seam::counts:
      return "counts";
    case Seam::trail:
      return "a decision of its path";
  }
  return "none";
}

}  // namespace eyeray::engine::compare
