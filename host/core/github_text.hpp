#pragma once

#include <string>
#include <string_view>

namespace eyeray::engine {

// Encodes any bytes so that a command of GitHub's workflows can hold them ("::error file=…::…"). In a
// property, "," and ":" are encoded too.
std::string github_text(std::string_view text, bool property);

// `text` as one line for a terminal or a log: printable, and no command to GitHub's workflows, which are
// `::NAME` at the start of a line and `##[NAME]` anywhere. One sign of these becomes a question mark, so that
// columns stay.
std::string log_line(std::string_view text);

// `text` with each of its lines so; its line ends stay.
std::string log_lines(std::string_view text);

}  // namespace eyeray::engine
