// Pictures of data, for people: the .png of an AOV.
#pragma once

#include <limits>
#include <vector>

#include "host/core/vec.hpp"
#include "host/image/image.hpp"

namespace eyeray::engine::image {

enum class FalseColor {
  scalar,     // 1 channel: viridis from the least to the greatest finite value
  depth,      // 1 channel: viridis, near is bright; logarithmic, since depths span decades
  ids,        // 1 channel: a different colour for every number ≥ 0
  color,      // 3 channels: the data itself
  direction,  // 3 channels: (n + 1) / 2
  position,   // 2 or 3 channels: each from its least to its greatest finite value
};

// A 3-channel picture whose .png shows the colours named above. Pixels without a value (misses: not finite,
// an id below 0, a direction of length 0) are grey.
Image false_color(const Image& data, FalseColor kind);

// Paints a picture from a few rows at a time: pass all rows to see(), then all rows to paint().
class FalseColorPainter {
 public:
  // `channels`: a number that `kind` allows.
  FalseColorPainter(FalseColor kind, int channels);

  void see(const Image& data);
  Image paint(const Image& data) const;

 private:
  // The least and greatest finite value of one channel.
  struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    double position(double value) const;  // 0 at the least, 1 at the greatest
  };
  double nearness(double depth) const;
  Vec3 color(const float* value) const;

  FalseColor kind_;
  std::vector<Range> ranges_;  // one a channel
};

}  // namespace eyeray::engine::image
