// The source of formulas in files that a scene names. The loader decides which files may be read, and how.
#pragma once

#include <optional>
#include <string>

#include "host/core/diagnostic.hpp"
#include "host/formula/formula.hpp"

namespace eyeray::engine::reading {

class FormulaSource {
 public:
  virtual ~FormulaSource() = default;

  // The text of the file `name`, which the scene names at `position`. Nothing, with an error in the log, if
  // the file may not or cannot be read.
  virtual std::optional<formula::FormulaText> load(const std::string& name,
                                                   const SourcePosition& position) = 0;
};

}  // namespace eyeray::engine::reading
