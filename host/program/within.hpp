// The ranges of numeric options.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

namespace eyeray::program {

// As CLI::Range, which lets NaN through.
inline CLI::Validator within(double low, double high) {
  const std::string range = fmt::format("{} to {}", low, high);
  return CLI::Validator(
      [=](const std::string& text) {
        double value = 0;
        const bool ok = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
        return ok ? std::string() : fmt::format("'{}' is not a number from {}", text, range);
      },
      range);
}

}  // namespace eyeray::program
