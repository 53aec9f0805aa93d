// The environment of the scene: a picture of all directions, and the probability with which a path chooses
// each direction.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/core/vec.hpp"
#include "host/image/image.hpp"

namespace eyeray::engine {

// A cell lies between the centres of four texels. There are height + 1 rows of cells, from the upper pole to
// the lower, and width columns, the last of which closes the circle. Within a cell the density per solid
// angle is constant, and proportional to the light at the cell's corners: it is nowhere 0 where there is
// light.
struct EnvironmentCells {
  std::vector<uint32_t> row_ends;     // as whole_shares() sets them
  std::vector<uint32_t> column_ends;  // column ends of each row's cells, row after row

  // True if there is any light.
  bool lit() const { return row_ends.back() > 0; }
};

class EnvironmentMap {
 public:
  // `image`: equirectangular, of three channels, the sky in its top rows; finite and nowhere negative.
  // `turn`: the image's rotation about y, as a share of a whole turn, counter-clockwise from above.
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

  double share = 0.5;  // the probability that paths choose it, if there are lights too

 private:
  image::Image image_;
  double turn_;
  EnvironmentCells cells_;
};

// The number of choice_numbers that choose the environment; 0 if there is none or it is black. `lights`: true
// if there are lights to choose as well.
uint32_t environment_numbers(const EnvironmentMap* environment, bool lights);

}  // namespace eyeray::engine
