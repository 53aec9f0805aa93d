#include "host/core/github_text.hpp"

#include <fmt/format.h>

#include "host/core/diagnostic.hpp"

namespace eyeray {

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

}  // namespace eyeray
