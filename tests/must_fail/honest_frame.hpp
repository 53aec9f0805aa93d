// Frames of the analytic picture as an honest executor gives them, to be damaged.
#pragma once

#include <functional>

#include "host/compare/against_reference.hpp"
#include "tests/support/analytic_picture.hpp"

namespace eyeray::engine::test {

// The picture as float32 would render it: off by less than the offsets that explain.
inline const Vec2 honest_shift(5e-5, 5e-5);
inline const compare::Pixel on_ball{50, 30};

inline compare::Frame honest_frame() {
  return picture_frame(honest_shift);
}
inline FirstHit& hit_at(compare::Frame& frame, compare::Pixel p) {
  return frame.first_hits[size_t(p.y * picture_width + p.x)];
}

inline compare::ReferenceComparison compared(const compare::Frame& value,
                                             const compare::Frame& reference = picture_frame()) {
  return compare::compare_with_reference(value, reference, picture_reference);
}

inline void for_each_pixel(compare::Frame& frame,
                           const std::function<void(float* color, FirstHit& hit)>& change) {
  for (int y = 0; y < picture_height; ++y) {
    for (int x = 0; x < picture_width; ++x) change(frame.color.pixel(x, y), hit_at(frame, {x, y}));
  }
}

}  // namespace eyeray::engine::test
