#include "host/compute/summary.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace eyeray::engine::compute {
namespace {

constexpr size_t shown = 8;

}  // namespace

Summary summarise(const Type& block, std::span<const std::byte> bytes) {
  Summary summary{.type = describe(unwrapped(block))};
  double sum = 0;
  uint64_t finite = 0;
  for_each_number(block, 0, [&](const Number& number, uint64_t offset) {
    ++summary.numbers;
    const double value = read_number(number, bytes.data() + offset);
    if (summary.first.size() < shown) summary.first.push_back(show_number(number, bytes.data() + offset));
    if (std::isnan(value)) ++summary.nan;
    if (!std::isfinite(value)) return;
    ++finite;
    sum += value;
    summary.min = std::min(summary.min.value_or(value), value);
    summary.max = std::max(summary.max.value_or(value), value);
  });
  if (finite > 0) summary.mean = sum / double(finite);
  return summary;
}

std::string to_text(const Summary& summary) {
  std::string text = summary.type + ": ";
  if (summary.mean)
    text += fmt::format("min {:.9g}, max {:.9g}, mean {:.6g}", *summary.min, *summary.max, *summary.mean);
  if (summary.nan > 0) text += fmt::format("{}{} NaN", summary.mean ? ", " : "", summary.nan);
  text += fmt::format("; {}{}", fmt::join(summary.first, ", "), summary.numbers > shown ? ", …" : "");
  return text;
}

}  // namespace eyeray::engine::compute
