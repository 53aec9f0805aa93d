// The definition of "agrees with the reference" for one pixel. Every test is written so that a NaN fails it.
#pragma once

#include "host/compare/seam.hpp"

namespace eyeray::engine::compare {

struct Tolerances {
  double color = 1e-4;           // tolerance of each channel, × max(1, |reference|)
  double t = 1e-5;               // relative; see t_tolerance
  double normal = 1e-4;          // tolerance of each component
  double uv = 1e-4;              // tolerance of each component, × max(1, |reference|)
  double max_explained = 0.005;  // the share of pixels that may differ for a reason (and four in any case)

  // A tolerance so wide that the gate could not fail is a defect of the caller: CHECK.
  void check() const;
};

// The largest allowed difference of t from the reference's hit: the relative tolerance, but at least two
// units in the last place, in float32, of the coordinates that t is computed from. Close to a large surface
// those units are coarser.
double t_tolerance(const FirstHit& reference, const Tolerances& tolerances);

// |value − reference| of the worst channel, in tolerances: at most 1 if the colours match, infinite if either
// contains a NaN.
double color_excess(const Vec3& value, const Vec3& reference, double tolerance);

// The excess of a first hit: infinite if ids differ. The tolerance of t holds for the hit's position, too.
double hit_excess(const FirstHit& value, const FirstHit& reference, const Tolerances& tolerances);

// The tolerance of counts, which are equal except for the rounding of their means to float32.
inline constexpr double counts_tolerance = 0x1p-23;
double counts_excess(const Counts& value, const Counts& reference);

// The first value along the life of a ray, in the order of Seam, that is out of tolerance. A first hit that
// is explained is passed over: a later value is wrong for another reason.
Seam first_seam(const WorstPixel& pixel, const Tolerances& tolerances, bool hit_is_explained);

}  // namespace eyeray::engine::compare
