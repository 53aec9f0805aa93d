#include "host/executors/control.hpp"

#include "host/core/text_scanner.hpp"

namespace eyeray::engine::executors {

std::optional<Control> control_in(std::string_view line, std::string_view comment) {
  for (TextScanner scanner(line); const auto before = scanner.before(comment);) {
    TextScanner words = scanner;
    words.skip_spaces();
    if (!words.skip("@")) continue;
    const std::string_view kind = words.one_of({"slider", "color", "checkbox"});
    if (kind.empty()) continue;
    const auto value = line.substr(0, line.size() - scanner.rest().size() - comment.size());
    return Control{kind, value.substr(0, value.find_last_not_of(" \t\r") + 1), numbers_in(words.rest())};
  }
  return std::nullopt;
}

}  // namespace eyeray::engine::executors
