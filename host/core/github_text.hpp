#pragma once

#include <string>
#include <string_view>

namespace eyeray::engine {

// Encodes any bytes so that a command of GitHub's workflows can hold them ("::error file=…::…"). In a
// property, "," and ":" are encoded too.
std::string github_text(std::string_view text, bool property);

// `text` as one line for a terminal or a log: printable, and without commands to GitHub's workflows: `::NAME`
// at the start of a line or `##[NAME]` anywhere. One character of a command becomes a question mark, so that
// columns stay.
std::string log_line(std::string_view text);

// `text` with each line as log_line() returns it; line ends stay.
std::string log_lines(std::string_view text);

}  // namespace eyeray::engine
