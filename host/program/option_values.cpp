#include "host/program/option_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace eyeray::engine::program {
namespace {

template <typename Number>
CLI::Validator in_range(const char* kind, Number low, Number high) {
  const std::string range = fmt::format("{} from {} to {}", kind, low, high);
  return CLI::Validator(
      [=](const std::string& text) {
        Number value{};
        const bool good = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
        return good ? std::string() : fmt::format("must be {}, not '{}'", range, text);
      },
      range);
}

}  // namespace

CLI::Validator within(double low, double high) {
  return in_range("a number", low, high);
}

CLI::Validator whole_within(int64_t low, int64_t high) {
  return in_range("a whole number", low, high);
}

CLI::Validator one_of(const std::vector<std::string>& names) {
  const std::string list = fmt::format("{}", fmt::join(names, ", "));
  return CLI::Validator(
      [=](const std::string& text) {
        const bool good = std::ranges::find(names, text) != names.end();
        return good ? std::string() : fmt::format("must be one of {}, not '{}'", list, text);
      },
      list);
}

}  // namespace eyeray::engine::program
