// The gates of denoising (docs/gates.md).
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "host/compare/frame.hpp"

namespace eyeray::engine::compare {

// One executor's denoised picture, compared with that of the first executor (gate A), and with that of the
// reference, which removes the noise of the same picture (gate B).
struct DenoisedResult {
  // A channel may differ from the reference's by this part of the pixel's greatest channel, and by this part
  // of the picture's mean.
  static constexpr double tolerance = 1e-3, tolerance_of_mean = 1e-5;

  std::string value;  // the executor
  std::string other;  // the first executor; empty for itself
  int64_t pixels = 0;
  int64_t different = 0;  // pixels whose bits differ from the other executor's
  int64_t undecided = 0;  // pixels that were not compared with the reference: rounding may decide them
  int64_t wrong = 0;      // pixels that differ from the reference by more than the tolerance
  double largest = 0;     // the largest difference from the reference, in tolerances
  Pixel worst;            // where it is
  std::array<double, 4> worst_value{}, worst_reference{};  // its colours, and alpha

  bool equals_other() const { return different == 0; }
  int64_t may_be_undecided() const { return pixels / 20; }
  bool agrees_with_reference() const { return pixels > 0 && wrong == 0 && undecided <= may_be_undecided(); }
  bool passes() const { return equals_other() && agrees_with_reference(); }
};

}  // namespace eyeray::engine::compare
