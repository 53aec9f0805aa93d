// Formulas that come with eyeray; each is handled as a user-defined one is.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "host/formula/formula.hpp"

namespace eyeray::engine::shapes {

struct ReadyFormula {
  std::string_view name;
  std::string_view text;
  std::vector<formula::FormulaParameter> parameters;  // and their defaults
  // The largest slope of the formula, with these parameters in the order above; null if none is known.
  double (*lipschitz)(std::span<const formula::FormulaParameter> parameters);
};

// In the order of ready_names.
std::span<const ReadyFormula> ready_formulas();

inline constexpr std::string_view ready_names[] = {"metaballs",    "gyroid",     "rounded-box",
                                                   "smooth-union", "mandelbulb", "height-field"};

}  // namespace eyeray::engine::shapes
