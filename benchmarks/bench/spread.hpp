#pragma once

#include <vector>

namespace eyeray::engine::bench {

// Median and extremes of something measured several times.
struct Spread {
  double median = 0;
  double min = 0;
  double max = 0;
};

// All zero for no values.
Spread spread(std::vector<double> values);

}  // namespace eyeray::engine::bench
