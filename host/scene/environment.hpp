// The environment of the scene: a picture of all directions, and the probability with which a path chooses
// each direction.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/core/vec.hpp"
#include "host/image/image.hpp"

namespace eyeray::engine {

// Between the centres of four texels lies a cell: height + 1 rows of them from the upper pole to the lower,
// width columns the last of which closes the circle. In a cell the density of directions is the same by
// solid angle, in proportion to the light at its corners, so that it is nowhere 0 where there is light.
struct EnvironmentCells {
  std::vector<uint32_t> row_ends;     // as whole_shares() has them
  std::vector<uint32_t> column_ends;  // of each row's cells, row after row

  // True if there is any light.
  bool lit() const { return row_ends.back() > 0; }
};

class EnvironmentMap {
 public:
  // `image`: equirectangular, of three channels, the sky in its top rows; finite and nowhere negative.
  // `turn`: by how much of a whole turn it is turned about y, counter-clockwise from above.
  EnvironmentMap(image::Image image, double turn);

  int width() const { return image_.width(); }
  int height() const { return image_.height(); }
  // Row 0 is the top.
  Vec3 texel(int column, int row) const {
    const float* samples = image_.pixel(column, row);
    return {samples[0], samples[1], samples[2]};
  }
  double turn() const { return turn_; }
  const EnvironmentCells& cells() const { return cells_; }

  double share = 0.5;  // of the paths' choices, where there are lights too

 private:
  image::Image image_;
  double turn_;
  EnvironmentCells cells_;
};

// The number of choice_numbers that choose the environment, beside lights or alone; 0 for none or a black
// one.
uint32_t environment_numbers(const EnvironmentMap* environment, bool lights);

}  // namespace eyeray::engine
