#include "host/core/escaped_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine {
namespace {

bool stands_in_any_shell(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("_-+=./:,@%").find(c) != std::string_view::npos;
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string escaped;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    for (const char c : printable(text.substr(0, end))) {
      switch (c) {
        case '&':
          escaped += "&amp;";
          break;
        case '<':
          escaped += "&lt;";
          break;
        case '>':
          escaped += "&gt;";
          break;
        case '"':
          escaped += "&quot;";
          break;
        default:
          escaped += c;
      }
    }
    if (end == text.size()) break;
    escaped += '\n';
    text.remove_prefix(end + 1);
  }
  return escaped;
}

std::string toml_string(std::string_view text) {
  std::string toml = "\"";
  for (const char each : text) {
    const auto code = static_cast<unsigned char>(each);
    if (each == '"' || each == '\\')
      toml += fmt::format("\\{}", each);
    else if (code < 0x20 || code == 0x7f)
      toml += fmt::format("\\u{:04X}", code);
    else
      toml += each;
  }
  return toml + "\"";
}

std::string shell_word(std::string_view word) {
  const bool plain = !word.empty() && word[0] != '=';  // zsh takes =WORD for a path
  if (plain && std::ranges::all_of(word, stands_in_any_shell)) return std::string(word);
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string harmless_json(std::string json) {
  // These characters occur only inside strings, where they can be escaped.
  for (size_t at = 0; (at = json.find("##[", at)) != std::string::npos;) json.replace(at + 1, 1, "\\u0023");
  std::string harmless;
  harmless.reserve(json.size());
  for (size_t i = 0; i < json.size(); ++i) {
    const auto byte = [&](size_t at) { return static_cast<unsigned char>(json[at]); };
    if (byte(i) == 0x7f) {
      harmless += "\\u007f";
    } else if (byte(i) == 0xc2 && i + 1 < json.size() && byte(i + 1) < 0xa0) {
      harmless += fmt::format("\\u{:04x}", byte(++i));
    } else if ((byte(i) & 0xe0) == 0xc0 && i + 1 < json.size() && printable(json.substr(i, 2)) == "?") {
      harmless += fmt::format("\\u{:04x}", (byte(i) & 0x1f) << 6 | (byte(i + 1) & 0x3f));
      ++i;
    } else if ((byte(i) & 0xf0) == 0xe0 && i + 2 < json.size() && printable(json.substr(i, 3)) == "?") {
      harmless +=
          fmt::format("\\u{:04x}", (byte(i) & 0x0f) << 12 | (byte(i + 1) & 0x3f) << 6 | (byte(i + 2) & 0x3f));
      i += 2;
    } else {
      harmless += json[i];
    }
  }
  return harmless;
}

}  // namespace eyeray::engine
