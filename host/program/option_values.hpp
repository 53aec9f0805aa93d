// The values that options take, as CLI11's validators. Each reports a wrong value in plain words.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace eyeray::engine::program {

// A number from `low` to `high`, and no NaN.
CLI::Validator within(double low, double high);
CLI::Validator whole_within(int64_t low, int64_t high);
CLI::Validator one_of(const std::vector<std::string>& names);

}  // namespace eyeray::engine::program
