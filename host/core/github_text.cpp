#include "host/core/github_text.hpp"

#include <fmt/format.h>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine {

std::string github_text(std::string_view text, bool property) {
  std::string escaped;
  for (const char c : printable(text)) {
    if (c == '%' || (property && (c == ':' || c == ',')))
      escaped += fmt::format("%{:02X}", c);
    else
      escaped += c;
  }
  return escaped;
}

std::string log_line(std::string_view text) {
  std::string line = printable(text);
  const size_t first = line.find_first_not_of(" \t");
  if (first != std::string::npos && line.compare(first, 2, "::") == 0) line[first] = '?';
  for (size_t at = 0; (at = line.find("##[", at)) != std::string::npos;) line[at + 1] = '?';
  return line;
}

std::string log_lines(std::string_view text) {
  std::string lines;
  while (!text.empty()) {
    const size_t end = text.find('\n');
    lines += log_line(text.substr(0, end));
    if (end == std::string_view::npos) break;
    lines += '\n';
    text.remove_prefix(end + 1);
  }
  return lines;
}

}  // namespace eyeray::engine
