#include "host/core/host_arithmetic.hpp"

#include <cmath>
#include <span>
#include <vector>

#include "host/core/content_hash.hpp"

namespace eyeray::engine {
namespace {

using OfOne = double (*)(double);
using OfTwo = double (*)(double, double);

}  // namespace

std::string host_arithmetic() {
  constexpr OfOne of_one[] = {std::sin,  std::cos,   std::tan, std::asin,  std::acos, std::atan, std::exp,
                              std::exp2, std::log1p, std::log, std::expm1, std::sinh, std::tanh, std::cbrt};
  constexpr OfTwo of_two[] = {std::pow, std::atan2, std::hypot};
  constexpr int arguments = 200;

  // Call through volatile pointers, so that the compiler cannot compute the results itself.
  std::vector<double> values;
  for (int i = 0; i < arguments; ++i) {
    // In (0, 1), spread evenly, with varied last bits: multiples of the golden ratio.
    const double x = std::fmod(0.6180339887498949 * (i + 1), 1.0);
    for (const OfOne volatile function : of_one) {
      values.push_back(function(x));
      values.push_back(function(40 * x - 20 * (x > 0.5)));
    }
    for (const OfTwo volatile function : of_two) values.push_back(function(3 * x + 0.1, 7 * x - 2));
  }
  // All NaNs count as equal, whatever their bits are.
  for (double& value : values)
    if (std::isnan(value)) value = 0;
  return ContentHash().add(std::as_bytes(std::span(values))).hex();
}

}  // namespace eyeray::engine
