// The comment after a value that gives it a control: `VALUE # @slider 0 1`.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace eyeray::engine::executors {

struct Control {
  std::string_view kind;      // "slider", "color" or "checkbox"
  std::string_view value;     // the text before the comment
  std::vector<double> range;  // the numbers that follow the kind
};

// The control in a line, where `comment` begins comments; nothing if there is none.
std::optional<Control> control_in(std::string_view line, std::string_view comment);

}  // namespace eyeray::engine::executors
