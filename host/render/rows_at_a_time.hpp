// The rows of a picture that are handled together.
#pragma once

#include <algorithm>

namespace eyeray::engine::render {

// The number of pixels traced at a time: tens of megabytes of results.
constexpr int most_traced = 1 << 20;

// The rows of `width` pixels that have about this many pixels together; at least 1.
constexpr int rows_of(int pixels, int width) {
  return std::max(1, pixels / width);
}

// The number of rows to request at a time: they take about a fifth of a second, so that progress shows and
// Ctrl-C works.
class RowsAtATime {
 public:
  explicit RowsAtATime(int width) : rows_(rows_of(most_traced, width)), most_(2 * rows_) {}
  int rows() const { return rows_; }
  void took(double seconds) {
    if (seconds > 0.4) rows_ = std::max(1, rows_ / 2);
    if (seconds < 0.1) rows_ = std::min(most_, rows_ * 2);
  }

 private:
  int rows_;
  int most_;
};

}  // namespace eyeray::engine::render
